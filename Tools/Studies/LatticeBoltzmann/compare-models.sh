#!/usr/bin/env bash
# Prints models A to F of Yang, Sega and Harting, beside the rows of a table of bridges: forces over gamma R (unlike radii: their mean).
#   Tools/Studies/LatticeBoltzmann/compare-models.sh BRIDGE-FORCE TABLE.CSV ANGLE
# BRIDGE-FORCE: the program Tools/bridge-force; TABLE.CSV: bridges or unequal of compute-figures.sh; ANGLE: degrees, of its exact bridges
set -euo pipefail
(($# == 3)) || { echo "usage: $0 BRIDGE-FORCE TABLE.CSV ANGLE" >&2; exit 2; }
program=$1 table=$2 angle=$3
# A, B: toroids; C: the full fit of Willett et al.; D: Derjaguin's force; E: the fit of Mikami et al.; F: Chen's toroid
models=(Lian PietschRumpf ClassicalWillett Lambert Mikami Chen)
echo "# $(basename "$table"), models at $angle degrees"
echo "gap,volume,force,exact,A,B,C,D,E,F"
# The columns by name; radii over their mean.
awk -F, '/^#/ { next }
    !found { for (k = 1; k <= NF; ++k) at[$k] = k; found = 1; next }
    { other = at["other_radius"] ? $at["other_radius"] : $at["radius"]; mean = 0.5 * ($at["radius"] + other)
      print $at["gap"], $at["volume"], $at["force"], $at["exact_force"], $at["radius"] / mean, other / mean }' "$table" |
    while read -r gap volume force exact first second; do
        row=$gap,$volume,$force,$exact
        for model in "${models[@]}"; do
            found=$("$program" --model "LiquidBridge$model" --radius1-m "$first" --radius2-m "$second" --contact-angle-deg "$angle" \
                --volume-m3 "$(awk "BEGIN { print $volume * 16 * atan2(1, 1) / 3 }")" --surface-tension-N/m 1 --separation-m "$gap" 2>/dev/null | tail -1) ||
                found=,nan  # a model that does not hold there is refused
            row+=,$(awk "BEGIN { printf \"%.4f\", \"${found#*,}\" }")
        done
        echo "$row"
    done
