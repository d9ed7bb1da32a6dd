#!/usr/bin/env bash
# Runs four small scenes in Pendular and in those of LIGGGHTS and LAMMPS that are installed, over a row of time steps, in turn,
# one thread each, and writes a table (CSV) and a chart (PNG): bulk figures, how they deviate from those at the smallest step of
# the same code, and the time of the processor for a second of the scene. All codes begin with the same grains.
#   Tools/Studies/BulkComparison/compare-bulk.sh [--scenes "bed drum hopper impact"] [--seeds 3] [--ours "0.1 0.2 0.4 0.6 0.7 0.8"] [--peers "0.15 0.3 0.4 0.5 0.6"]
#                         [--share 0.9] [--skins "2e-4 4e-4 8e-4"] [--output FOLDER] [--build DIR]
# --ours, --peers  steps over Rayleigh's time of the largest grain, the smallest first: the reference
# --share          of the adaptive step
# --skins          of the peers, m: of each scene the one that took them the least time at a share of the run counts
# --build DIR      a build folder; build/release if not given
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tools=$study/../..
scenes="bed drum hopper impact" seeds=3 ours="0.1 0.2 0.4 0.6 0.7 0.8" peers="0.15 0.3 0.4 0.5 0.6" share=0.9
skins="2e-4 4e-4 8e-4" output=bulk build="$tools/../build/release"
command_line="Tools/Studies/BulkComparison/compare-bulk.sh $*"
source "$tools/read-options.sh"
read_options scenes seeds ours peers share skins output build -- "$@"
require_number seeds "$seeds"
program="$build/Tools/Studies/bulk-figures"
require_program "$program"
mkdir -p "$output"
output=$(realpath "$output")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1
raw=$work/raw.csv  # scene,code,share of Rayleigh's time or of the bound,seed, and what bulk-figures prints
: >"$raw"
say() { echo "$(date +%H:%M:%S) $*" >&2; }

# Of one run; what the run of a peer took, without what it took to write frames, is in $seconds.
keep() {  # scene, code, step, seed, row
    echo "$1,$2,$3,$4,$5" >>"$raw"
}
run_peer() {  # scene, code, steps (s), seed, skin, length of the run over its whole
    local scene=$1 code=$2 log=$work/$2.log boundary floor=0 drum=0 hopper=0 command=lmp
    case $scene in
    drum) boundary="f f p" drum=1 ;;
    hopper) boundary="f p f" hopper=1 ;;
    *) boundary="p p f" floor=1 ;;
    esac
    [[ $code != liggghts ]] || command=liggghts
    local every steps
    read -r every steps < <(awk -v dt="$3" -v between="$between" -v end="$end" -v part="$6" \
        'BEGIN { e = int(between / dt + 0.5); print (e < 1 ? 1 : e), int(part * end / dt + 0.5) }')
    rm -f "$work/frames"
    local TIMEFORMAT=%U
    seconds=$( { time (cd "$work" && "$command" -in "$study/bulk.$code" -var data "$work/start" \
        -var boundary "$boundary" -var floor "$floor" -var drum "$drum" -var hopper "$hopper" -var step "$3" \
        -var every "$every" -var steps "$steps" -var skin "$5" -var frames "$work/frames" >"$log" 2>&1) || true; } 2>&1 | tail -1)
    # The share of the loop that writing frames took.
    local share
    share=$(awk '/^Output *\|/ { s = $NF / 100 } /^Outpt time \(%\) = / { gsub(/[()]/, " "); s = $NF / 100 } END { print s + 0 }' "$log")
    seconds=$(awk -v s="$seconds" -v o="$share" 'BEGIN { print s * (1 - o) }')
}
peer_codes=()
if command -v liggghts >/dev/null; then peer_codes+=(liggghts); fi
if command -v lmp >/dev/null; then peer_codes+=(lammps); fi

# In version 29 Sep 2021 of LAMMPS a turning cylinder throws the grains about, with 20 times the kinetic energy that they have
# in the other codes, at any step; one that stands does not, and a turning region does it as well.
can_run() { [[ $1 != drum || $2 != lammps ]]; }  # scene, code

declare -A skin_of
choose_skins() {  # scene
    local code skin best
    for code in "${peer_codes[@]}"; do
        if ! can_run "$1" "$code"; then continue; fi
        best=1e9
        for skin in $skins; do
            run_peer "$1" "$code" "$(awk -v r="$rayleigh" 'BEGIN { print 0.3 * r }')" 1 "$skin" 0.2
            if awk -v a="$seconds" -v b="$best" 'BEGIN { exit !(a < b) }'; then best=$seconds skin_of[$code]=$skin; fi
        done
        say "$1: $code with a skin of ${skin_of[$code]} m"
    done
}

for scene in $scenes; do
    for ((seed = 1; seed <= seeds; ++seed)); do
        say "$scene, seed $seed of $seeds"
        read -r rayleigh end between _ < <("$program" --scene "$scene" --seed "$seed" --data "$work/start")
        start=("$program" --scene "$scene" --start "$work/start")
        if ((seed == 1)); then choose_skins "$scene"; fi
        for step in $ours; do
            for integrator in default velocity-verlet; do
                row=$("${start[@]}" --integrator "$integrator" --step "$step")  # a wrong option ends the script
                keep "$scene" "pendular-$integrator" "$step" "$seed" "$row"
            done
        done
        row=$("${start[@]}" --integrator adaptive --step "$share")
        keep "$scene" pendular-adaptive "$share" "$seed" "$row"
        for step in $peers; do
            for code in "${peer_codes[@]}"; do
                if ! can_run "$scene" "$code"; then continue; fi
                run_peer "$scene" "$code" "$(awk -v r="$rayleigh" -v f="$step" 'BEGIN { printf "%.17g", f * r }')" "$seed" "${skin_of[$code]}" 1
                keep "$scene" "$code" "$step" "$seed" "$("${start[@]}" --step "$step" --frames "$work/frames" --seconds "$seconds")"
            done
        done
        cp "$raw" "$output/bulk-runs.csv"
    done
done

cp "$raw" "$output/bulk-runs.csv"
{
    "$tools/describe-machine.sh" "$command_line; one thread each; user time of the processor (of Pendular with system time), medians of the seeds, in turn"
    awk -F, -f "$study/bulk-table.awk" "$raw"
} >"$output/bulk-peers.csv"
cat "$output/bulk-peers.csv"
if command -v gnuplot >/dev/null; then
    gnuplot -c "$study/bulk.gp" "$output/bulk-peers.csv" "$output/bulk-peers.png"
    say "wrote $output/bulk-peers.csv and $output/bulk-peers.png"
fi
