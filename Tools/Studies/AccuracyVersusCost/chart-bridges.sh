#!/usr/bin/env bash
# Measures accuracy against cost of the liquid bridge laws, and draws the charts: Tools/Studies/Results/bridges*.csv and .png,
# Kernel/Features/LiquidBridges/failure-maps.png. Some ten minutes with the scenes. It measures times: use an idle machine.
#   Tools/Studies/AccuracyVersusCost/chart-bridges.sh [--build build/release] [--scenes no]
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tools=$study/../.. results=$study/../Results
build="$tools/../build/release" scenes=yes
source "$tools/read-options.sh"
read_options build scenes -- "$@"
[[ $scenes == yes || $scenes == no ]] || refuse "--scenes is '$scenes'; it must be yes or no"
require_program "$build/Tools/Studies/accuracy-versus-cost"
[[ $scenes == no ]] || require_program "$build/Tools/Studies/bridge-scenes"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

result() {  # name of the result, program, options...
    local name=$1 program=$2
    shift 2
    "$build/Tools/Studies/$program" "$@" --output "$work/$name.csv"
    {
        "$tools/describe-machine.sh" "Tools/Studies/$program $*; one thread"
        cat "$work/$name.csv"
    } > "$results/$name.csv"
}
result bridges accuracy-versus-cost --bridges --runs 3000
gnuplot -c "$study/bridges.gp" "$results/bridges.csv" "$results/bridges"
"$build/Tools/Studies/accuracy-versus-cost" --failure-maps --output "$work/failure-maps.csv"
gnuplot -c "$study/failure-maps.gp" "$work/failure-maps.csv" "$tools/../Kernel/Features/LiquidBridges/failure-maps.png"
if [[ $scenes == yes ]]; then
    result bridges-in-scenes bridge-scenes
    result bridges-in-scenes-partial-wetting bridge-scenes --dimensionless-volume 0.001 --contact-angle-deg 50
fi
