#!/usr/bin/env bash
# Computes the tables of this study: bridges of Tables VI and VII of Yang, Sega and Harting at 48 degrees, their convergence
# (Table III), unequal spheres (Figure 5), bridges that may slip off the axis (Figure 6), and bridges that are drawn out.
#   Tools/Studies/LatticeBoltzmann/compute-figures.sh PROGRAM FOLDER [RADIUS] [ANGLE]
# PROGRAM: lattice-boltzmann as it was built; RADIUS: nodes, a multiple of 7; 14; ANGLE: degrees that a drop has on a sphere of that radius at
# a Delta rho of 0.1 (PROGRAM --angles), 48. Some minutes of a core at a radius of 14, eight times as long at 28.
# A table that is in FOLDER is not computed again.
set -euo pipefail
(($# >= 2)) || { echo "usage: $0 PROGRAM FOLDER [RADIUS] [ANGLE]" >&2; exit 2; }
program=$1 folder=$2 radius=${3:-14} angle=${4:-48}
mkdir -p "$folder"
here=$(dirname "${BASH_SOURCE[0]}")

# name, then a line of options for each row
table() {
    local name=$1 file=$folder/$1.csv part
    shift
    [[ ! -e $file ]] || return 0
    "$here/../../describe-machine.sh" "lattice-boltzmann ${1%% --gap*} ..., R = $radius" >"$file.new"
    for part; do
        # shellcheck disable=SC2086 — the options are words
        "$program" $part --threads 1 >"$file.part"
        if grep -q '^radius' "$file.new"; then sed -i '/^radius/d' "$file.part"; fi
        cat "$file.part" >>"$file.new"
    done
    rm "$file.part"
    mv "$file.new" "$file"
}

bridge="--bridge --wetting 0.1 --angle-deg $angle --most-steps 12000"
rows=()
for case in "0.286 0.09" "0.572 0.12" "0.858 0.15" "0.286 0.4" "0.572 0.5" "0.858 0.59" "1.144 0.65"; do
    rows+=("$bridge --radius $radius --gap ${case% *} --volume ${case#* }")
done
table bridges "${rows[@]}"

rows=()
for nodes in 16 32; do rows+=("$bridge --radius $nodes --gap 0.625 --volume 0.133"); done
table convergence "${rows[@]}"

rows=()
small=$(awk "BEGIN { print 0.875 * $radius }")
for case in "0.194 0.085" "0.486 0.108" "0.85 0.130"; do
    rows+=("--pair --radius $small --radius2 1.285714 --gap ${case% *} --volume ${case#* } --wetting 0.1 --wetting2 0.1 --angle-deg $angle --angle2-deg $angle --most-steps 10000")
done
table unequal "${rows[@]}"

rows=()
for case in "0.572 0.5" "1.144 0.65"; do
    for wetting in 0 -0.1; do
        rows+=("--bridge --radius $radius --gap ${case% *} --volume ${case#* } --wetting $wetting --start 0.3 --angle-deg 90 --most-steps 20000")
    done
done
table off-axis "${rows[@]}"

rows=()
for case in "0.1 0.02" "0.1 0.005" "0.08 0.05" "0.08 0.005" "0.05 0.05" "0.05 0.02" "0.05 0.005"; do
    rows+=("--part --radius $radius --gap 0.5 --volume 0.1 --farthest 2.2 --wetting 0.1 --wetting2 ${case% *} --speed ${case#* } --most-steps 3000")
done
table parting "${rows[@]}"
