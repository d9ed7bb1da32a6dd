# For scripts, which source this file: `stage NAME COMMAND...` runs a command and keeps how long it took. At the end of the
# script, also where a stage has failed and `set -e` ends it, the times of all stages are printed.

stageTable=$(mktemp) stageClock=$(mktemp) stageRuns="" stageBegin=0 processorBegin=0
print_stages() {
    local status=$?
    if ((status > 0)) && [[ -n $stageRuns ]]; then end_stage "$stageRuns: failed, exit code $status"; fi
    if [[ -n $stageRuns ]]; then end_stage "$stageRuns: interrupted"; fi  # by a signal
    if [[ -s $stageTable ]]; then
        echo "== Where the time went (seconds, and those of all processors)"
        cat "$stageTable"
    fi
    rm -f "$stageTable" "$stageClock"
}
trap print_stages EXIT

# In processor: the seconds of all commands that have ended. Not printed: a subshell would have its own times only.
read_processor() {
    times >"$stageClock"
    processor=$(awk 'NR == 2 { gsub("[ms]", " "); printf "%.0f", 60 * $1 + $2 + 60 * $3 + $4 }' "$stageClock")
}
end_stage() {  # what the table says of it
    read_processor
    printf '%6d %6d  %s\n' $((SECONDS - stageBegin)) $((processor - processorBegin)) "$1" >>"$stageTable"
    stageRuns=""
}
# Not in front of || or &&, where `set -e` would not end a function at its first command that fails.
stage() {  # name, command...
    echo "== $1"
    read_processor
    stageRuns=$1 stageBegin=$SECONDS processorBegin=$processor
    "${@:2}"
    end_stage "$1"
}
