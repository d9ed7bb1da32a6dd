#!/usr/bin/env bash
# Maps where dry contact laws fail: Tools/Results/contact-maps/*.csv and .png. Some seconds.
#   Tools/chart-contacts.sh [--build build/release]
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build="$tools/../build/release"
source "$tools/read-options.sh"
read_options build -- "$@"
require_program "$build/Tools/accuracy-versus-cost"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
results="$tools/Results/contact-maps"
mkdir -p "$results"

"$build/Tools/accuracy-versus-cost" --contact-maps --map-offsets 16 --output "$work"
for table in "$work"/*.csv; do
    {
        "$tools/describe-machine.sh" "Tools/accuracy-versus-cost --contact-maps --map-offsets 16; one thread"
        cat "$table"
    } > "$results/$(basename "$table")"
done
gnuplot -c "$tools/contact-maps.gp" "$results"
