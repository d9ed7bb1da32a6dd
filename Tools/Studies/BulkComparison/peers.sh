# For the scripts of this folder, which source it: runs of LIGGGHTS and LAMMPS, as far as they are installed, one thread each. Before
# use: study (this folder), work (a folder for files), between (s between frames) and end (s); the start is $work/start.
peer_codes=()
if command -v liggghts >/dev/null; then peer_codes+=(liggghts); fi
if command -v lmp >/dev/null; then peer_codes+=(lammps); fi

# User time (s) of a run of a peer, and its log in $work/CODE.log.
time_of_peer() {  # scene, code, step (s), skin (m), modulus (Pa), steps between frames, steps
    local boundary floor=0 drum=0 sides=0 held=0 command=lmp
    case $1 in
    drum) boundary="f f p" drum=1 ;;
    hopper) boundary="f p f" sides=1 held=1 ;;
    silo) boundary="p p f" held=1 ;;
    *) boundary="p p f" floor=1 ;;
    esac
    [[ $2 != liggghts ]] || command=liggghts
    rm -f "$work/frames"
    local TIMEFORMAT=%U
    { time (cd "$work" && "$command" -in "$study/bulk.$2" -var data "$work/start" -var boundary "$boundary" \
        -var floor "$floor" -var drum "$drum" -var sides "$sides" -var held "$held" -var modulus "$5" -var step "$3" -var every "$6" -var steps "$7" -var skin "$4" -var frames "$work/frames" \
        >"$work/$2.log" 2>&1) || true; } 2>&1 | tail -1
}
declare -A start_up  # s, of each code and scene: of a run of no step
# What the steps of a run take, without start-up and without what it took to write frames, is in $seconds; frames in $work/frames.
run_peer() {  # scene, code, step (s), skin (m), modulus (Pa), length of the run over its whole
    local every steps took
    read -r every steps < <(awk -v dt="$3" -v between="$between" -v end="$end" -v part="$6" \
        'BEGIN { e = int(between / dt + 0.5); print (e < 1 ? 1 : e), int(part * end / dt + 0.5) }')
    if [[ -z ${start_up[$1 $2]:-} ]]; then
        start_up[$1 $2]=$(for _ in 1 2 3; do time_of_peer "$1" "$2" "$3" "$4" "$5" "$every" 0; done | sort -g | sed -n 2p)
    fi
    took=$(time_of_peer "$1" "$2" "$3" "$4" "$5" "$every" "$steps")
    # The share of the steps that writing frames took.
    seconds=$(awk -v took="$took" -v start="${start_up[$1 $2]}" '
        /^Output *\|/ { s = $NF / 100 } /^Outpt time \(%\) = / { gsub(/[()]/, " "); s = $NF / 100 }
        END { print (took > start ? took - start : 0) * (1 - s) }' "$work/$2.log")
}

declare -A skin_of  # m, of each scene and code
choose_skins() {  # scene, modulus (Pa): once for each scene, of --skins the one that takes a peer the least time
    local code skin best
    for code in "${peer_codes[@]}"; do
        if [[ -n ${skin_of[$1 $code]:-} ]]; then continue; fi
        if [[ $skins != *" "* ]]; then skin_of[$1 $code]=$skins; continue; fi
        best=1e9
        for skin in $skins; do
            run_peer "$1" "$code" "$(awk -v r="$rayleigh" 'BEGIN { print 0.3 * r }')" "$skin" "$2" 0.2
            if awk -v a="$seconds" -v b="$best" 'BEGIN { exit !(a < b) }'; then best=$seconds skin_of[$1 $code]=$skin; fi
        done
        say "$1: $code with a skin of ${skin_of[$1 $code]} m"
    done
}
