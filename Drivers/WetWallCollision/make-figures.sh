#!/usr/bin/env bash
# Figures 6 to 13 of the force balance model of wet particle-wall collisions: runs the driver for each curve and
# draws the charts. Some 20 s.
#   Drivers/WetWallCollision/make-figures.sh [OUTPUT_FOLDER [BUILD_FOLDER]]    (output/wet-wall, build/release)
# The tables are in OUTPUT_FOLDER/FIGURE/CURVE/collisions.csv.
set -euo pipefail
case ${1:-} in -h | --help) sed -n '2,5s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;; esac
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
output=${1:-$here/../../output/wet-wall}
program=${2:-$here/../../build/release}/Drivers/WetWallCollision/WetWallCollision
[[ -x $program ]] || { echo "There is no program $program: build the target WetWallCollision first." >&2; exit 1; }

# Tables 1, 2, 3 and 5 of the paper. The volume option A (--growing-bridge) is the paper's text taken literally.
large=(--radius-m 0.87e-3)
small=(--radius-m 0.455e-3)
alumina=(--density-kg/m3 1040 --elastic-modulus-Pa 14.5e9 --poisson-ratio 0.25 --restitution 0.76)
water=()
tween=(--surface-tension-N/m 0.0373)
glycerol35=(--liquid-density-kg/m3 1086 --viscosity-Pa-s 3e-3 --surface-tension-N/m 0.06961)
glycerol51=(--liquid-density-kg/m3 1130 --viscosity-Pa-s 6.7e-3 --surface-tension-N/m 0.0682)
layer() { echo --layer-m "$1e-6" --half-filling-angle-deg "$2"; }  # um, degrees
dry=(--layer-m 0)

curve() {  # figure, name, options...
    local folder=$output/$1/$2
    shift 2
    mkdir -p "$folder"
    "$program" --quiet --output "$folder" "$@"
}
both() {  # the same with both options for the volume of the bridge
    curve "$1" "$2-A" --growing-bridge "${@:3}"
    curve "$1" "$2-B" "${@:3}"
}
speeds=(--speeds-m/s $(seq 0.25 0.025 1) $(seq 1.1 0.1 2) $(seq 2.25 0.25 5))

both 6 glass $(layer 400 55) --speeds-m/s 1 --steps 6 8 12.5 18 25 35 50 70 100 140 200 280 400 800

curve 7 a-dry "${dry[@]}" "${speeds[@]}"
for of in "100 35" "200 45" "400 55"; do both 7 "a-${of% *}" $(layer $of) "${speeds[@]}"; done
for of in "100 45" "200 55"; do both 7 "b-${of% *}" "${small[@]}" $(layer $of) "${speeds[@]}"; done
both 7 c-water $(layer 200 45) "${speeds[@]}"
# Table 5 has glass and glycerol at 400 um only (53, 51 degrees), Figure 7c is for 200 um: both, and at 200 um with
# the angles of alumina.
both 7 c-glycerol35 "${glycerol35[@]}" $(layer 200 44) "${speeds[@]}"
both 7 c-glycerol51 "${glycerol51[@]}" $(layer 200 43) "${speeds[@]}"
both 7 c-glycerol35-400 "${glycerol35[@]}" $(layer 400 53) "${speeds[@]}"
both 7 c-glycerol51-400 "${glycerol51[@]}" $(layer 400 51) "${speeds[@]}"
both 7 d-tween "${tween[@]}" $(layer 100 35) "${speeds[@]}"
both 7 d-water $(layer 100 35) "${speeds[@]}"

curve 8 a-dry "${alumina[@]}" "${dry[@]}" "${speeds[@]}"
for of in "100 28" "200 45" "400 53"; do both 8 "a-${of% *}" "${alumina[@]}" $(layer $of) "${speeds[@]}"; done
both 8 b-glycerol35 "${alumina[@]}" "${glycerol35[@]}" $(layer 200 44) "${speeds[@]}"
both 8 b-glycerol51 "${alumina[@]}" "${glycerol51[@]}" $(layer 200 43) "${speeds[@]}"

for speed in 1 1.5 2 2.5 3; do
    both 9 "large-$speed" "${large[@]}" $(layer 400 55) --energy --speeds-m/s "$speed"
    both 9 "small-$speed" "${small[@]}" $(layer 200 55) --energy --speeds-m/s "$speed"
done

# Normal speed 1 m/s at all angles. Friction: Table 3.
angles=(--speeds-m/s 1 --angles-deg $(seq 1 1 89))
oblique() {  # figure, name, spin, options...
    curve "$1" "$2" "${alumina[@]}" "${angles[@]}" --growing-bridge "--spins-rad/s=$3" "${@:4}"
}
tween100=("${tween[@]}" $(layer 100 35) --friction 0.160)
for spin in 200 0 -300; do
    oblique 10 "dry$spin" "$spin" "${dry[@]}" --friction 0.195
    oblique 10 "tween$spin" "$spin" "${tween100[@]}"
done
# Figure 11 has four spins from about -600 to -1800 rad/s; the text gives these of its experiments.
for spin in -623 -961 -1366 -1777; do oblique 11 "tween$spin" "$spin" "${tween100[@]}"; done
oblique 12 tween-960 -960 "${tween100[@]}"
oblique 13 dry -500 "${dry[@]}" --friction 0.195
oblique 13 tween-100 -500 "${tween100[@]}"
oblique 13 tween-150 -500 "${tween[@]}" $(layer 150 42) --friction 0.160
oblique 13 glycerol35-100 -500 "${glycerol35[@]}" $(layer 100 34) --friction 0.140

gnuplot -c "$here/plot.gp" "$output"
echo "Charts: $output/figure-{6..13}.png"
