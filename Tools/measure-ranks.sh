#!/usr/bin/env bash
# Runs scenes of the benchmark on threads and on ranks (MPI), in turn, and prints the rows of Tools/benchmark-scenes. Each
# row starts with what it is for and the number of ranks: the same scene on 1 rank with 1 and 2 threads and on more ranks
# (strong), and as many grains for each rank (weak). Equal scenes have equal hashes. Only on a machine that does nothing
# else.
#   Tools/measure-ranks.sh [--runs 3] [--build build/mpi] [--bed FILE] [--ranks 2] [--particles 25000] > ranks.csv
# --bed FILE  rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
runs=3 build="$tools/../build/mpi" bed="" ranks=2 particles=25000
command_line="Tools/measure-ranks.sh $*"
source "$tools/read-options.sh"
read_options runs build bed ranks particles -- "$@"
for option in runs ranks particles; do require_number "$option" "${!option}"; done
require_file bed "$bed"
require_program "$build/Tools/benchmark-scenes"
[[ -f $build/PendularMpi.so ]] || refuse "the build in $build has no MPI; build it with the preset mpi"
command -v mpirun >/dev/null || refuse "there is no mpirun; Tools/install-dependencies.sh --mpi installs it"
ours=$build/Tools/benchmark-scenes
positions=(${bed:+--positions "$bed"})

row() {  # purpose, ranks, options...
    local purpose=$1 count=$2 start=()
    shift 2
    if ((count > 1)); then start=(mpirun --bind-to core -n "$count"); fi
    ${start[@]+"${start[@]}"} "$ours" "${positions[@]}" --steps 1000 --warm 200 "$@" | sed "s/^/$purpose,$count,/"
}
"$tools/describe-machine.sh" "$command_line"
"$ours" --scene gas --particles 10 --steps 1 --warm 0 --header | head -1 | sed 's/^/purpose,ranks,/'
for ((run = 1; run <= runs; ++run)); do
    for scene in bed wet-bed; do
        row strong 1 --scene "$scene" --particles "$particles"
        row strong 1 --scene "$scene" --particles "$particles" --threads 2
        row strong "$ranks" --scene "$scene" --particles "$particles"
    done
    row weak "$ranks" --scene bed --particles $((particles * ranks))
done
