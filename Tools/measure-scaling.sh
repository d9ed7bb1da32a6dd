#!/usr/bin/env bash
# Runs the scenes of the benchmark against each other, in turn, and prints the rows of Tools/benchmark-scenes with what
# each is for in front: threads, wet against dry, frictionless against rough, sizes 1:20 against one size, growth.
#   Tools/measure-scaling.sh [--runs 3] [--build build/release] [--bed FILE] [--largest 4000000] > scaling.csv
# --bed FILE  rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
runs=3 build="$tools/../build/release" bed=() largest=4000000
command_line="Tools/measure-scaling.sh $*"
while (($# > 0)); do
    case $1 in
        --help | -h) sed -n '2,5p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'; exit 0 ;;
        --runs) runs=$2 ;;
        --build) build=$2 ;;
        --bed) bed=(--positions "$2") ;;
        --largest) largest=$2 ;;
        *) echo "measure-scaling.sh: there is no option $1; see --help" >&2; exit 2 ;;
    esac
    shift 2
done
export OMP_NUM_THREADS=1
ours=$build/Tools/benchmark-scenes

row() {  # purpose, options...
    local purpose=$1
    shift
    "$ours" "$@" | sed "s/^/$purpose,/"
}
"$tools/describe-machine.sh"
echo "# command: $command_line"
"$ours" --scene gas --particles 10 --steps 1 --warm 0 --header | head -1 | sed 's/^/purpose,/'
for ((run = 1; run <= runs; ++run)); do
    for threads in 1 2; do row threads --scene bed "${bed[@]}" --particles 250000 --steps 300 --warm 50 --threads "$threads"; done
    row wet --scene bed "${bed[@]}" --steps 1000 --warm 500
    row wet --scene wet-bed "${bed[@]}" --steps 1000 --warm 500
    row frictionless --scene bed "${bed[@]}" --steps 1000 --warm 500
    row frictionless --scene bed "${bed[@]}" --species LinearViscoelasticSpecies --steps 1000 --warm 500
    row sizes --scene bed --particles 25000 --steps 1000 --warm 500
    row sizes --scene polydisperse --particles 40000 --steps 1000 --warm 500
    for ((n = 10000; n <= largest; n = n < 1000000 ? 10 * n : 4 * n)); do
        row growth --scene bed --particles "$n" --steps $((40000000 / n > 20 ? 40000000 / n : 20)) --warm 10
    done
done
