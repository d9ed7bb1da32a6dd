#!/usr/bin/env bash
# Runs scenes of the benchmark on threads and on ranks (MPI), in turn and back in mirrored order, and prints the rows of
# Tools/benchmark-scenes. Each row starts with what it is for:
#   strong    the same scene on one thread, two threads and two ranks
#   weak      as many grains for each rank as one has alone
#   list      lists of contacts with and without grains that go to another rank, a hundredth of them at each
#   drum      how even the work is where grains flow
#   messages  sends and reductions of MPI in a step, by its profiling interface
# and ends with the load of the machine (1 min) before the run. Equal scenes have equal hashes. Best on a machine that does
# nothing else; on another one, rows of less than a second are right under real-time priority: chrt -f 10 Tools/measure-ranks.sh
#   Tools/measure-ranks.sh [--runs 3] [--build build/mpi] [--bed FILE] [--drum FILE --drum-walls FILE]
#       [--ranks 2] [--particles 25000] [--steps 1000] > ranks.csv
# --bed FILE  rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself; --drum too
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
runs=3 build="$tools/../build/mpi" bed="" drum="" drum_walls="" ranks=2 particles=25000 steps=1000
command_line="Tools/measure-ranks.sh $*"
source "$tools/read-options.sh"
read_options runs build bed drum drum-walls ranks particles steps -- "$@"
for option in runs ranks particles steps; do require_number "$option" "${!option}"; done
for option in bed drum drum_walls; do require_file "${option//_/-}" "${!option}"; done
require_program "$build/Tools/benchmark-scenes"
[[ -f $build/PendularMpi.so ]] || refuse "the build in $build has no MPI; build it with the preset mpi"
command -v mpirun >/dev/null || refuse "there is no mpirun; Tools/install-dependencies.sh --mpi installs it"
build=$(realpath "$build")
positions=(${bed:+--positions "$bed"})
drum_files=(${drum:+--positions "$drum" --walls "$drum_walls"})

run_on() {  # ranks, command...
    local start=()
    if (($1 > 1)); then start=(mpirun --bind-to core -n "$1"); fi
    shift
    ${start[@]+"${start[@]}"} "$@"
}
row() {  # purpose, ranks, options...
    local purpose=$1 count=$2 load
    load=$(cut -d' ' -f1 /proc/loadavg)
    shift 2
    run_on "$count" "$ours" --rank-columns --steps "$steps" --warm 200 "$@" | sed "s/^/$purpose,/; s/$/,$load/"
}
# Of two runs, so that what set-up and end send does not count.
messages() {
    local counter=$build/SelfTests/CountMessages.so
    [[ -f $counter ]] || return 0
    for count in 1 $((1 + steps)); do
        run_on "$ranks" env LD_PRELOAD="$counter" "$ours" --scene bed "${positions[@]}" --particles "$particles" --warm 1 \
            --steps "$count" 2>&1 >/dev/null
    done | awk -v steps="$steps" -v ranks="$ranks" '/ sends, / { ++n; sign = n > ranks ? 1 : -1
            sends += sign * $1; reductions += sign * $3; exchanges += sign * $5 }
        END { printf "# messages: a rank and step has %.3f sends, %.3f reductions, %.3f exchanges of all with all\n",
                     sends / steps / ranks, reductions / steps / ranks, exchanges / steps / ranks }'
}
ours=$build/Tools/benchmark-scenes
"$tools/describe-machine.sh" "$command_line"
messages
"$ours" --scene gas --particles 10 --steps 1 --warm 0 --header --rank-columns | head -1 | sed 's/^/purpose,/; s/$/,load/'
for ((run = 1; run <= runs; ++run)); do
    for scene in bed wet-bed; do
        for what in thread threads ranks ranks threads thread; do
            options=(--scene "$scene" "${positions[@]}" --particles "$particles")
            case $what in
                thread) row strong 1 "${options[@]}" ;;
                threads) row strong 1 "${options[@]}" --threads 2 ;;
                ranks) row strong "$ranks" "${options[@]}" ;;
            esac
        done
    done
    options=(--scene bed "${positions[@]}" --particles)
    for count in 1 "$ranks" "$ranks" 1; do row weak "$count" "${options[@]}" $((count * particles)); done
    for share in 0 0.01 0.01 0; do row list "$ranks" "${options[@]}" "$particles" --shear 100 --wander "$share"; done
done
steps=$((3 * steps)) row drum "$ranks" --scene drum "${drum_files[@]}"
