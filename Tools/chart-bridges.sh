#!/usr/bin/env bash
# Measures accuracy against cost of the liquid bridge laws, and draws the charts: Tools/Results/bridges*.csv and .png,
# Kernel/Species/Adhesion/failure-maps.png. Some ten minutes with the scenes; times want a machine that is idle.
#   Tools/chart-bridges.sh [--build build/release] [--scenes no]
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build="$tools/../build/release" scenes=yes
while (($# > 0)); do
    case $1 in
        --help | -h) sed -n '2,4p' "${BASH_SOURCE[0]}" | sed 's/^# \{0,1\}//'; exit 0 ;;
        --build) build=$2 ;;
        --scenes) scenes=$2 ;;
        *) echo "chart-bridges.sh: there is no option $1; see --help" >&2; exit 2 ;;
    esac
    shift 2
done
export OMP_NUM_THREADS=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

result() {  # name of the result, program, options...
    local name=$1 program=$2
    shift 2
    "$build/Tools/$program" "$@" --output "$work/$name.csv"
    {
        "$tools/describe-machine.sh"
        echo "# command: OMP_NUM_THREADS=1 Tools/$program $*; one thread"
        cat "$work/$name.csv"
    } > "$tools/Results/$name.csv"
}
result bridges accuracy-versus-cost --bridges --runs 3000
gnuplot -c "$tools/bridges.gp" "$tools/Results/bridges.csv" "$tools/Results/bridges"
"$build/Tools/accuracy-versus-cost" --failure-maps --output "$work/failure-maps.csv"
gnuplot -c "$tools/failure-maps.gp" "$work/failure-maps.csv" "$tools/../Kernel/Species/Adhesion/failure-maps.png"
if [[ $scenes == yes ]]; then
    result bridges-in-scenes bridge-scenes
    result bridges-in-scenes-partial-wetting bridge-scenes --dimensionless-volume 0.001 --contact-angle-deg 50
fi
