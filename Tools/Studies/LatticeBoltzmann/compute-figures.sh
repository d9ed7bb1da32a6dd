#!/usr/bin/env bash
# Computes the tables of this study: bridges of Tables VI and VII of Yang, Sega and Harting at one Delta rho, their convergence
# (Table III), unequal spheres (Figure 5), bridges that may slip off the axis (Figure 6), bridges that are drawn out, and those of three
# spheres that merge.
#   Tools/Studies/LatticeBoltzmann/compute-figures.sh PROGRAM FOLDER [RADIUS [TABLE...]]
# PROGRAM: lattice-boltzmann as it was built; RADIUS: nodes, a multiple of 7; 14; TABLE: angles, bridges, convergence, unequal, off-axis,
# parting, trimers; all. A minute of a core at a radius of 14 but for the last two, some at 28, half an hour at 42. Each row is written as it
# ends; a table that is in FOLDER is not computed again.
set -euo pipefail
(($# >= 2)) || { echo "usage: $0 PROGRAM FOLDER [RADIUS [TABLE...]]" >&2; exit 2; }
program=$1 folder=$2 radius=${3:-14}
wanted=" ${*:4} "
mkdir -p "$folder"
here=$(dirname "${BASH_SOURCE[0]}")

# name, then a line of options for each row
table() {
    local name=$1 file=$folder/$1-$radius.csv part
    shift
    [[ ! -e $file ]] || return 0
    [[ $wanted == "  " || $wanted == *" $name "* ]] || return 0
    "$here/../../describe-machine.sh" "lattice-boltzmann ${1%% --*} ..., R = $radius" >"$file.new"
    for part; do
        # The options are words.
        # shellcheck disable=SC2086
        "$program" $part --threads 1 >"$file.part"
        if grep -q '^radius' "$file.new"; then sed -i '/^radius/d' "$file.part"; fi
        cat "$file.part" >>"$file.new"
    done
    rm "$file.part"
    mv "$file.new" "$file"
}

trimer="--trimer --radius $radius --gap 0.2 --wetting 0.105 --angle-deg 42 --most-steps 5000"
table trimers "$trimer --volumes 0.05,0.08,0.11,0.14,0.17" "$trimer --closed --volumes 0.14,0.17"
[[ $wanted != " trimers " ]] || exit 0

table angles "--angles --wettings 0.1 --radius $radius"
[[ -e $folder/angles-$radius.csv ]] || exit 0
# The angle at which a drop meets the sphere: that of the exact bridges in the tables.
angle=$(awk -F, 'END { print $5 }' "$folder/angles-$radius.csv")

bridge="--bridge --wetting 0.1 --angle-deg $angle --most-steps 8000"
rows=()
for case in "0.572 0.12" "0.572 0.5" "0.286 0.09" "0.286 0.4" "0.858 0.15" "0.858 0.59" "1.144 0.65"; do
    rows+=("$bridge --radius $radius --gap ${case% *} --volume ${case#* }")
done
table bridges "${rows[@]}"

table convergence "$bridge --radius $radius --gap 0.625 --volume 0.133"

rows=()
small=$(awk "BEGIN { print 0.875 * $radius }")
for case in "0.486 0.108" "0.194 0.085" "0.85 0.130"; do
    rows+=("--pair --radius $small --radius2 1.285714 --gap ${case% *} --volume ${case#* } --wetting 0.1 --wetting2 0.1 --angle-deg $angle --angle2-deg $angle --most-steps 8000")
done
table unequal "${rows[@]}"

rows=()
for case in "0.572 0.5" "1.144 0.65"; do
    for wetting in 0 -0.1; do
        rows+=("--bridge --radius $radius --gap ${case% *} --volume ${case#* } --wetting $wetting --start 0.3 --angle-deg $([[ $wetting == 0 ]] && echo 90 || echo 132) --most-steps 20000")
    done
done
table off-axis "${rows[@]}"

rows=()
for case in "0.1 0.02" "0.1 0.005" "0.08 0.05" "0.08 0.005" "0.05 0.05" "0.05 0.02" "0.05 0.005"; do
    rows+=("--part --radius $radius --gap 0.5 --volume 0.1 --farthest 2.2 --wetting 0.1 --wetting2 ${case% *} --angle-deg $angle --angle2-deg $angle --speed ${case#* } --most-steps 3000")
done
table parting "${rows[@]}"
