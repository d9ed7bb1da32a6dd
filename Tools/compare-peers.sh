#!/usr/bin/env bash
# Runs the same scenes in Pendular and in those of LIGGGHTS, LAMMPS and YADE that are installed, in turn, one thread each,
# and writes the medians as a table (CSV) and a chart (PNG).
#   Tools/compare-peers.sh [--particles "25000 250000"] [--runs 3] [--output FOLDER]
#                          [--bed FILE] [--drum FILE --drum-walls FILE]
# --bed FILE   rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself
# --drum FILE  their drum, with its walls as rows of nine numbers; LIGGGHTS only. Without it there is no drum.
# --build DIR  a build folder; build/release if not given
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
particles="25000 250000" runs=3 output=peers bed="" drum="" drum_walls="" build="$tools/../build/release"
command_line="Tools/compare-peers.sh $*"
source "$tools/read-options.sh"
read_options particles runs output bed drum drum-walls build -- "$@"
read -ra sizes <<<"$particles"
for number in "${sizes[@]:-}"; do require_number particles "$number"; done
require_number runs "$runs"
require_file bed "$bed"
require_file drum "$drum"
require_file drum-walls "$drum_walls"
[[ -z $drum || -n $drum_walls ]] || refuse "--drum needs --drum-walls too; see --help"
require_program "$build/Tools/benchmark-scenes"
for file in bed drum drum_walls; do
    path=${!file:+$(realpath "${!file}")}
    printf -v "$file" %s "$path"
done
ours=$(realpath "$build/Tools/benchmark-scenes")
mkdir -p "$output"
output=$(realpath "$output")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1

# Rows of the run at hand: scene,code,particles,steps,seconds,kinetic_energy_J
raw=$work/raw.csv
: >"$raw"

# The last loop and the last kinetic energy of a log of LIGGGHTS or LAMMPS.
parse_log() {  # scene, code, log
    awk -v scene="$1" -v code="$2" '
        /^Loop time/ { t = $4; for (i = 1; i <= NF; i++) { if ($i == "for") s = $(i + 1); if ($i == "with") n = $(i + 1) } ke = last }
        $1 ~ /^[0-9]+$/ && NF == 3 { last = $3 }
        END { printf "%s,%s,%d,%d,%s,%s\n", scene, code, n, s, t, ke }' "$3" >>"$raw"
}
run_peer() {  # scene, code, command...
    local scene=$1 code=$2 log=$work/$2.log
    shift 2
    if (cd "$work" && "$@" >"$log" 2>&1); then
        parse_log "$scene" "$code" "$log"
    else
        say "$code failed: $(tail -1 "$log")"
    fi
}
parse_ours() {  # scene, row
    echo "$2" | awk -F, -v scene="$1" '{ printf "%s,pendular,%d,%d,%s,%s\n", scene, $3, $7, $8, $12 }' >>"$raw"
}
say() { echo "$(date +%H:%M:%S) $*" >&2; }

lammps_data() {  # grain file, copies, length, box (xlo xhi ylo yhi zlo), types
    read -r xlo xhi ylo yhi zlo <<<"$4"
    awk -v copies="$2" -v length_x="$3" -v types="$5" -v xlo="$xlo" -v xhi="$xhi" -v ylo="$ylo" -v yhi="$yhi" -v zlo="$zlo" '
        $1 + 0 > 0 { r[++n] = $1; x[n] = $2; y[n] = $3; z[n] = $4 }
        END {
            printf "grains\n\n%d atoms\n%d atom types\n\n%s %s xlo xhi\n%s %s ylo yhi\n%s %s zlo zhi\n\nAtoms\n\n", n * copies, types, xlo, xhi, ylo, yhi, zlo, zlo + 0.35
            for (k = 0; k < copies; k++)
                for (i = 1; i <= n; i++) {
                    large = types > 1 && r[i] > 0.0015
                    printf "%d %d %.12g %d %.12g %.12g %.12g\n", ++m, large ? 2 : 1, 2 * r[i], large ? 2000 : 2500, x[i] + length_x * k, y[i], z[i]
                }
        }' "$1"
}

run_bed() {  # particles
    local copies=$((($1 + 12500) / 25000))
    ((copies > 0)) || copies=1
    local steps=$((2000 / copies > 40 ? 2000 / copies : 40)) warm=$((500 / copies > 20 ? 500 / copies : 20))
    local grains=$bed box length=0.1 options=(--scene bed --particles "$1" --steps "$steps" --warm "$warm")
    if [[ -n $bed ]]; then
        options+=(--positions "$bed")
        box=$(awk -v c="$copies" 'BEGIN { printf "-0.05 %.9g -0.03 0.03 -0.090243", -0.05 + 0.1 * c }')
    else
        "$ours" --scene bed --particles 25000 --steps 1 --warm 0 >/dev/null # makes the state
        grains=$build/benchmark-states/bed-25000.txt
        box=$(awk -v c="$copies" 'BEGIN { printf "0 %.9g 0 0.06 0", 0.1 * c }')
    fi
    lammps_data "$grains" "$copies" "$length" "$box" 1 >"$work/bed.data"
    awk 'NF == 7 { print $3 / 2, $5, $6, $7 }' "$work/bed.data" >"$work/bed.rows"
    read -r xlo xhi ylo yhi zlo <<<"$box"
    local vars=(-var data "$work/bed.data" -var xlo "$xlo" -var xhi "$xhi" -var ylo "$ylo" -var yhi "$yhi" -var zlo "$zlo" -var warm "$warm" -var steps "$steps")
    for ((run = 1; run <= runs; ++run)); do
        say "bed of $1, run $run of $runs"
        local row
        row=$("$ours" "${options[@]}") || exit 1
        parse_ours bed "$row"
        if command -v liggghts >/dev/null; then
            run_peer bed liggghts liggghts -in "$tools/Peers/bed.liggghts" "${vars[@]}"
        fi
        if command -v lmp >/dev/null; then
            run_peer bed lammps lmp -in "$tools/Peers/bed.lammps" "${vars[@]}"
        fi
        if command -v yade >/dev/null && ((copies == 1)); then
            GRAINS=$work/bed.rows BOX=$box WARM=$((warm / 5)) STEPS=$((steps / 4)) yade -n -x -j1 "$tools/Peers/bed_yade.py" 2>/dev/null |
                awk -v s=$((steps / 4)) -v n=25000 '/^result/ { printf "bed,yade,%d,%d,%s,\n", n, s, $2 }' >>"$raw"
        fi
    done
}

run_drum() {
    local steps=1000 warm=500
    lammps_data "$drum" 1 0 "-0.15 0.15 -0.1 0.1 -0.15" 2 | sed 's/^2 atom types/3 atom types/' >"$work/drum.data"
    awk 'BEGIN { print "solid drum" } NF == 9 && $1 + 0 == $1 {
        printf "facet normal 0 0 0\n outer loop\n  vertex %s %s %s\n  vertex %s %s %s\n  vertex %s %s %s\n endloop\nendfacet\n", $1, $2, $3, $4, $5, $6, $7, $8, $9 }
        END { print "endsolid drum" }' "$drum_walls" >"$work/drum.stl"
    for ((run = 1; run <= runs; ++run)); do
        say "drum, run $run of $runs"
        local row
        row=$("$ours" --scene drum --positions "$drum" --walls "$drum_walls" --steps $steps --warm $warm) || exit 1
        parse_ours drum "$row"
        if command -v liggghts >/dev/null; then
            run_peer drum liggghts liggghts -in "$tools/Peers/drum.liggghts" -var data drum.data -var mesh drum.stl \
                -var warm $warm -var steps $steps
        fi
    done
}

for n in "${sizes[@]}"; do run_bed "$n"; done
if [[ -n $drum ]]; then run_drum; fi

{
    "$tools/describe-machine.sh" "$command_line; one thread each; medians of $runs runs in turn"
    echo "scene,code,particles,threads,steps,median_seconds,million_particle_steps_per_second,lowest,highest,kinetic_energy_J,ours_over_this"
    sort -t, -k1,1 -k3,3n -k2,2 "$raw" | awk -F, '
        function flush(   i, j, v) {
            if (count == 0) return
            for (i = 1; i <= count; i++) for (j = i + 1; j <= count; j++) if (rate[j] < rate[i]) { v = rate[i]; rate[i] = rate[j]; rate[j] = v }
            m = int((count + 1) / 2)
            key[++rows] = scene "," n; name[rows] = code; median[rows] = rate[m]
            if (code == "pendular") own[scene "," n] = rate[m]
            line[rows] = sprintf("%s,%s,%d,1,%d,%.4f,%.3f,%.3f,%.3f,%s", scene, code, n, s, n * s / rate[m] * 1e-6, rate[m], rate[1], rate[count], ke)
            count = 0
        }
        { if ($1 != scene || $2 != code || $3 != n) { flush(); scene = $1; code = $2; n = $3 }
          s = $4; ke = $6; rate[++count] = $3 * $4 / $5 * 1e-6 }
        END { flush(); for (r = 1; r <= rows; r++) printf "%s,%.2f\n", line[r], own[key[r]] / median[r] }'
} >"$output/peers.csv"
cat "$output/peers.csv"
if command -v gnuplot >/dev/null; then
    gnuplot -c "$tools/Peers/peers.gp" "$output/peers.csv" "$output/peers.png"
    say "wrote $output/peers.csv and $output/peers.png"
fi
