#!/usr/bin/env bash
# Maps where dry contact laws fail: Tools/Studies/Results/contact-maps/*.csv and .png. Some seconds.
#   Tools/Studies/AccuracyVersusCost/chart-contacts.sh [--build build/release]
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tools=$study/../..
build="$tools/../build/release"
source "$tools/read-options.sh"
read_options build -- "$@"
require_program "$build/Tools/Studies/accuracy-versus-cost"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
results="$study/../Results/contact-maps"
mkdir -p "$results"

"$build/Tools/Studies/accuracy-versus-cost" --contact-maps --map-offsets 16 --output "$work"
for table in "$work"/*.csv; do
    {
        "$tools/describe-machine.sh" "Tools/Studies/accuracy-versus-cost --contact-maps --map-offsets 16; one thread"
        cat "$table"
    } > "$results/$(basename "$table")"
done
gnuplot -c "$study/contact-maps.gp" "$results"
