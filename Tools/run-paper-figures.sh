#!/usr/bin/env bash
# Installs what is missing, builds Pendular, runs two-particle collisions with three models of the bridge, and
# draws Figures 3a, 3b, 4a and 4b of Bagheri, Roy and Poeschel, "Discrete Element Simulations of particles
# interacting via capillary forces using MercuryDPM"; then the curves of Figures 3, 4, 5, 6 and 9 of Yang, Sega and
# Harting, "Capillary-bridge forces between solid particles", with the exact ones; then the eight tests of Chung and
# Ooi, "Benchmark tests for verifying discrete element modelling codes at particle impact level", beside theory;
# then Figures 6 to 13 of the force balance model of wet particle-wall collisions.
#   Tools/run-paper-figures.sh [OUTPUT_FOLDER]     (default: output/paper-figures)
# What the programs print is in OUTPUT_FOLDER/log.txt; if one fails, its part is shown.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
read_argument "$@"
(($# <= 1)) || refuse "there is one argument, the output folder, and not $#; see --help"
mkdir -p "${1:-$(dirname "${BASH_SOURCE[0]}")/../output/paper-figures}"
output=$(cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../output/paper-figures}" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/.."

log=$output/log.txt
: >"$log"
say() { echo "== $*"; }
quietly() {  # command...
    local begin
    begin=$(wc -c <"$log")
    "$@" >>"$log" 2>&1 && return
    tail -c "+$((begin + 1))" "$log" >&2
    refuse "'$*' failed; its output is above and in $log"
}

Tools/install-dependencies.sh --check >/dev/null 2>&1 || Tools/install-dependencies.sh
say "Building (preset release, folder build/release; some minutes the first time)"
quietly cmake --preset release
quietly cmake --build --preset release --parallel "$(getconf _NPROCESSORS_ONLN)" --target TwoParticleCollision bridge-figures impact-figures WetWallCollision
say "built after $SECONDS s; the figures take some 45 s"

models='LiquidBridgeWillett LiquidBridgeClassicalWillett LiquidBridgeBagheri'

# Table 1 of the paper. Speed and restitution are ours, and the curves do not depend on them; at 0.1 m/s the
# grains would not part.
collide() {  # radius of the second sphere (m), bridge volume (m^3), model, output folder
    quietly build/release/Drivers/TwoParticleCollision/TwoParticleCollision \
        --radius1-m 0.0005 --radius2-m "$1" --volume-m3 "$2" --adhesion "$3" --output "$4" \
        --surface-tension-N/m 0.079 --contact-angle-deg 0 --speed-m/s 0.5 \
        --elastic-modulus-Pa 5e6 --poisson-ratio 0.35 --density-kg/m3 2000 --restitution 0.86
}

draw_figure() {  # name, radius of the second sphere (mm), bridge volume (nl)
    say "Figure $1: spheres of 0.5 mm and $2 mm, bridge of $3 nl"
    local model
    for model in $models; do
        mkdir -p "$output/figure-$1/$model"
        collide "$2e-3" "$3e-12" "$model" "$output/figure-$1/$model"
    done
    quietly gnuplot -c Tools/plot-figure.gp "$output/figure-$1" "Figure $1: r_1 = 0.5 mm, r_2 = $2 mm, V = $3 nl" \
        "$output/figure-$1"
}

draw_figure 3a 0.8 10
draw_figure 3b 0.8 80
draw_figure 4a 1.0 10
draw_figure 4b 1.0 80

write_tables() {  # program, output folder
    quietly build/release/Tools/Studies/"$1" --output "$2"
    local table
    for table in "$2"/*.csv; do
        rm -f "$table.new"
        { Tools/describe-machine.sh "Tools/Studies/$1, one thread" && cat "$table"; } >"$table.new"
        mv "$table.new" "$table"
    done
}

say "Figures 3, 4, 5, 6 and 9 of Yang, Sega and Harting"
models_output=$output/bridge-models
write_tables bridge-figures "$models_output"
quietly gnuplot -c Tools/Studies/BridgeModels/plot-bridge-figures.gp "$models_output"

say "The eight tests of Chung and Ooi"
impacts_output=$output/chung-ooi
write_tables impact-figures "$impacts_output"
quietly gnuplot -c Tools/Studies/ChungOoi/plot-impact-figures.gp "$impacts_output"

say "Figures 6 to 13 of the force balance model of wet particle-wall collisions"
wet_output=$output/wet-wall
quietly Drivers/WetWallCollision/make-figures.sh "$wet_output" build/release

say "done after $SECONDS s"
echo "Charts:  $output/figure-{3a,3b,4a,4b}.{png,svg} $models_output/figure-{3,4,5,6,9}.png $impacts_output/test-{1..8}.png $wet_output/figure-{6..13}.png"
echo "Data:    $output/figure-{3a,3b,4a,4b}/MODEL/{force_separation,energy}.csv $models_output/figure-{3,4,5,6,9}.csv $impacts_output/test-{1..8}.csv $wet_output/{6..13}/CURVE/collisions.csv"
