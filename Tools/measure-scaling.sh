#!/usr/bin/env bash
# Runs the scenes of the benchmark against each other, in turn, and prints the rows of Tools/benchmark-scenes. Each row
# starts with what it is for: threads, wet against dry, frictionless against rough, sizes 1:20 against one size, growth.
#   Tools/measure-scaling.sh [--runs 3] [--build build/release] [--bed FILE] [--largest 4000000] > scaling.csv
# --bed FILE  rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
runs=3 build="$tools/../build/release" bed="" largest=4000000
command_line="Tools/measure-scaling.sh $*"
source "$tools/read-options.sh"
read_options runs build bed largest -- "$@"
require_number runs "$runs"
require_number largest "$largest"
require_file bed "$bed"
require_program "$build/Tools/benchmark-scenes"
ours=$build/Tools/benchmark-scenes
positions=(${bed:+--positions "$bed"})

row() {  # purpose, options...
    local purpose=$1
    shift
    "$ours" "$@" | sed "s/^/$purpose,/"
}
"$tools/describe-machine.sh" "$command_line"
"$ours" --scene gas --particles 10 --steps 1 --warm 0 --header | head -1 | sed 's/^/purpose,/'
for ((run = 1; run <= runs; ++run)); do
    for threads in 1 2; do row threads --scene bed "${positions[@]}" --particles 250000 --steps 300 --warm 50 --threads "$threads"; done
    row wet --scene bed "${positions[@]}" --steps 1000 --warm 500
    row wet --scene wet-bed "${positions[@]}" --steps 1000 --warm 500
    row frictionless --scene bed "${positions[@]}" --steps 1000 --warm 500
    row frictionless --scene bed "${positions[@]}" --species LinearViscoelasticSpecies --steps 1000 --warm 500
    row sizes --scene bed --particles 25000 --steps 1000 --warm 500
    row sizes --scene polydisperse --particles 40000 --steps 1000 --warm 500
    for ((n = 10000; n <= largest; n = n < 1000000 ? 10 * n : 4 * n)); do
        row growth --scene bed --particles "$n" --steps $((40000000 / n > 20 ? 40000000 / n : 20)) --warm 10
    done
done
