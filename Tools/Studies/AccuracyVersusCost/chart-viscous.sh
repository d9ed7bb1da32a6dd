#!/usr/bin/env bash
# Viscous bridges: where each scheme fails and what it costs, the largest steps in beds, and bridges that are prepared
# again late: Tools/Studies/Results/viscous/*.csv and .png. Some minutes.
#   Tools/Studies/AccuracyVersusCost/chart-viscous.sh [--build build/release]
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tools=$study/../..
build="$tools/../build/release"
source "$tools/read-options.sh"
read_options build -- "$@"
require_program "$build/Tools/Studies/accuracy-versus-cost"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
results="$study/../Results/viscous"
mkdir -p "$results"

# MODE TABLE CHART: the table of a mode, drawn by CHART.gp
chart() {
    "$build/Tools/Studies/accuracy-versus-cost" "--$1" --output "$work/$2.csv"
    {
        "$tools/describe-machine.sh" "Tools/Studies/accuracy-versus-cost --$1; one thread; times, if any, are the fastest of 300 in turn"
        cat "$work/$2.csv"
    } > "$results/$2.csv"
    gnuplot -c "$study/$3.gp" "$results/$2.csv" "$results/$2"
}
chart viscous accuracy viscous
chart viscous-stability stability viscous-stability
chart bridge-volumes volumes bridge-volumes
