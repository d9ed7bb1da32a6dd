#!/usr/bin/env bash
# Runs the same scenes in Pendular and in those of LIGGGHTS, LAMMPS and YADE that are installed, in turn, on one core or some
# each, and writes the medians as a table (CSV) and a chart (PNG).
#   Tools/Studies/Peers/compare-peers.sh [--scenes "flowing-drum flowing-hopper flowing-mixer wet-flowing-drum wet-flowing-hopper wet-flowing-mixer
#                          bed wet-bed mixture sheared-mixture clumps"] [--sizes "1000 30000 300000"] [--particles "25000 250000"] [--runs 3] [--cores 1]
#                          [--output FOLDER] [--states FOLDER] [--skins "2e-4 4e-4 8e-4"] [--prefix "chrt -f 10 taskset -c 1"] [--bed FILE] [--drum FILE --drum-walls FILE]
# --scenes     in flow, of the numbers of --sizes, 5 MPa and steps of 0.2 of Rayleigh's time: flowing-drum, flowing-hopper and
#              flowing-mixer (a screw of triangles); with wet- in front: with bridges that form and rupture (Soulie's force, as
#              LIGGGHTS' easo/capillary/viscous has it). Their starts are made once and kept in --states; 1000 are the scene's own
#              number (960 to 1500), 300 000 ten copies of 30 000 along the period. LIGGGHTS has the best of --skins, LAMMPS only the dry drum and hopper.
#              At rest: bed: dry, of the numbers of --particles; wet-bed: the first of these, with liquid bridges (Bagheri's law and the
#              exact one), beside LIGGGHTS' easo/capillary/viscous; mixture: 20 000 grains, radii 1 to 10, two sizes of equal
#              volume, beside LIGGGHTS with cells of one size: with cells by size ("multi") version 3.8.0 finds no neighbours;
#              sheared-mixture: the same, whose grains start with 100 1/s times their height as speed along x; LIGGGHTS with
#              a skin of 1 mm, the best of 0.2, 0.5, 1 and 2 mm; clumps: beds of 10 000 spheres in clumps of 2 (a rod), 4 (a square)
#              and 8 (a cube) that touch, which LIGGGHTS inserts as multispheres and lets settle first (minutes)
# --prefix     in front of each program, for example to pin it to a core
# --cores N    threads of Pendular and YADE; processes of LIGGGHTS and LAMMPS by mpirun, which share the beds along x, and from
#              8 on (an even number) along x and y: all layers of a bed weigh alike
# --bed FILE   rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself
# --drum FILE  their drum, with its walls as rows of nine numbers; LIGGGHTS only. Without it there is no drum.
# --build DIR  a build folder; build/release if not given
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tools=$study/../..
scenes="flowing-drum flowing-hopper flowing-mixer wet-flowing-drum wet-flowing-hopper wet-flowing-mixer" sizes="1000 30000 300000" skins="2e-4 4e-4 8e-4"
prefix="" states="" particles="25000 250000" runs=3 cores=1 output=peers bed="" drum="" drum_walls="" build="$tools/../build/release"
command_line="Tools/Studies/Peers/compare-peers.sh $*"
source "$tools/read-options.sh"
read_options scenes sizes particles runs cores output states skins prefix bed drum drum-walls build -- "$@"
read -ra bed_sizes <<<"$particles"
for number in "${bed_sizes[@]:-}"; do require_number particles "$number"; done
read -ra flow_sizes <<<"$sizes"
for number in "${flow_sizes[@]:-}"; do require_number sizes "$number"; done
read -ra flow_skins <<<"$skins"
for skin in "${flow_skins[@]:-}"; do
    [[ $skin =~ ^[0-9]*\.?[0-9]+([eE]-?[0-9]+)?$ && $skin =~ ^[0.]*[1-9] ]] || refuse "--skins has '$skin'; it must be lengths in m above 0, for example \"2e-4 4e-4\""
done
read -ra pinned <<<"$prefix"
require_number runs "$runs"
require_number cores "$cores"
read -ra scene_names <<<"$scenes"
for scene in "${scene_names[@]:-}"; do
    case $scene in
    flowing-drum | flowing-hopper | flowing-mixer | wet-flowing-drum | wet-flowing-hopper | wet-flowing-mixer) ;;
    bed | wet-bed | mixture | sheared-mixture | clumps) ;;
    *) refuse "--scenes: '$scene' is none of flowing-drum, flowing-hopper, flowing-mixer, these with wet- in front, bed, wet-bed, mixture, sheared-mixture, clumps" ;;
    esac
done
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
states=${states:-$output/states}

# How a peer starts on all cores, and the grid by which it shares a bed.
launch=()
if ((cores > 1)); then
    require_program "$(command -v mpirun || echo mpirun)"
    launch=(mpirun -np "$cores")
    if ((EUID == 0)) && mpirun --version | grep -q "Open MPI"; then launch+=(--allow-run-as-root); fi
fi
grid_y=$((cores >= 8 && cores % 2 == 0 ? 2 : 1))
grid=(-var gridx $((cores / grid_y)) -var gridy "$grid_y")

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
    if (cd "$work" && ${pinned[@]+"${pinned[@]}"} ${launch[@]+"${launch[@]}"} "$@" >"$log" 2>&1); then
        parse_log "$scene" "$code" "$log"
    else
        say "$code failed: $(tail -1 "$log")"
    fi
}
parse_ours() {  # scene, name, row
    echo "$3" | awk -F, -v scene="$1" -v name="$2" '{ printf "%s,%s,%d,%d,%s,%s\n", scene, name, $3, $7, $8, $12 }' >>"$raw"
}
say() { echo "$(date +%H:%M:%S) $*" >&2; }

lammps_data() {  # rows of radius x y z, box (xlo xhi ylo yhi zlo), types
    read -r xlo xhi ylo yhi zlo <<<"$2"
    awk -v types="$3" -v xlo="$xlo" -v xhi="$xhi" -v ylo="$ylo" -v yhi="$yhi" -v zlo="$zlo" '
        { gsub(/,/, " ") }
        $1 + 0 > 0 { r[++n] = $1; x[n] = $2; y[n] = $3; z[n] = $4; if ($4 + $1 > top) top = $4 + $1 }
        END {
            printf "grains\n\n%d atoms\n%d atom types\n\n%s %s xlo xhi\n%s %s ylo yhi\n%s %s zlo zhi\n\nAtoms\n\n", n, types, xlo, xhi, ylo, yhi, zlo, (top > zlo + 0.3 ? top + 0.05 : zlo + 0.35)
            for (i = 1; i <= n; i++) {
                large = types > 1 && r[i] > 0.0015
                printf "%d %d %.12g %d %.12g %.12g %.12g\n", i, large ? 2 : 1, 2 * r[i], large ? 2000 : 2500, x[i], y[i], z[i]
            }
        }' "$1"
}

# Writes the grains of our scene to bed.rows and bed.data, sets `box`, and `vars` for the scripts of the peers.
prepare_bed() {  # options of benchmark-scenes for the scene...
    "$ours" "$@" --grains >"$work/bed.rows"
    box=$(sed -n '1s/.*: //p' "$work/bed.rows")
    lammps_data "$work/bed.rows" "$box" 1 >"$work/bed.data"
    read -r xlo xhi ylo yhi zlo <<<"$box"
    vars=("${grid[@]}" -var data "$work/bed.data" -var xlo "$xlo" -var xhi "$xhi" -var ylo "$ylo" -var yhi "$yhi" -var zlo "$zlo" -var warm "$warm" -var steps "$steps" -var shear "${shear:-0}" -var skin "${skin:-2e-4}")
}
run_ours() {  # name of the row, scene, options of benchmark-scenes...
    local name=$1 scene=$2 row
    shift 2
    row=$(${pinned[@]+"${pinned[@]}"} "$ours" "$@" --threads "$cores" --steps "$steps" --warm "$warm") || exit 1
    parse_ours "$scene" "$name" "$row"
}
run_liggghts() {  # scene, model
    if command -v liggghts >/dev/null; then
        run_peer "$1" liggghts liggghts -in "$study/bed.liggghts" "${vars[@]}" -var model "$2"
    fi
}

# A flow: of each code the numbers of grains that it starts with count, as some leave.
run_flow() {  # scene, grains
    local scene=$1 steps warm wet=0 codes=(pendular) skin best start folder=$work/flow atoms before
    before=$(wc -l <"$raw")
    steps=$(awk -v n="$2" 'BEGIN { s = int(12e6 / n); print (s > 4000 ? 4000 : s < 200 ? 200 : s) }')
    warm=$((steps / 2 > 1000 ? 1000 : steps / 2 < 100 ? 100 : steps / 2))
    local options=(--scene "$scene" --states "$states")
    (($2 == 1000)) || options+=(--particles "$2")
    rm -rf "$folder"
    say "$scene of $2: the start"
    "$ours" "${options[@]}" --threads "$(nproc)" --peer-files "$folder"
    atoms=$(awk '/ atoms$/ { print $1; exit }' "$folder/start")
    [[ $scene != wet-* ]] || wet=1
    if command -v liggghts >/dev/null; then codes+=(liggghts); fi
    if command -v lmp >/dev/null && [[ $scene == flowing-drum || $scene == flowing-hopper ]]; then codes+=(lammps); fi
    flow_peer() {  # code, skin, warm, steps; into raw
        local program=liggghts
        [[ $1 != lammps ]] || program=lmp
        run_peer "$scene" "$1" "$program" -in "$study/flow.$1" -var folder "$folder" -var wet "$wet" -var skin "$2" -var warm "$3" -var steps "$4"
    }
    local -A skin_of=()
    for code in "${codes[@]:1}"; do
        best=1e9 skin_of[$code]=${skins%% *}
        for skin in $skins; do
            if [[ $skins == "$skin" ]]; then break; fi
            start=$(wc -l <"$raw")
            flow_peer "$code" "$skin" $((warm / 2)) $((steps / 4))
            if awk -F, -v n="$start" -v best="$best" 'NR > n && $5 < best { found = 1 } END { exit !found }' "$raw"; then
                best=$(tail -1 "$raw" | cut -d, -f5) skin_of[$code]=$skin
            fi
            head -n "$start" "$raw" >"$work/kept" && mv "$work/kept" "$raw"
        done
        say "$code: a skin of ${skin_of[$code]} m"
    done
    for ((run = 1; run <= runs; ++run)); do
        say "$scene of $2, run $run of $runs"
        run_ours pendular "$scene" "${options[@]}"
        for code in "${codes[@]:1}"; do flow_peer "$code" "${skin_of[$code]}" "$warm" "$steps"; done
    done
    awk -F, -v OFS=, -v scene="$scene" -v n="$atoms" -v before="$before" 'NR > before { $3 = n } 1' "$raw" >"$work/kept"
    mv "$work/kept" "$raw"
}

run_bed() {  # particles
    local copies=$((($1 + 12500) / 25000)) box vars
    ((copies > 0)) || copies=1
    local steps=$((2000 / copies > 40 ? 2000 / copies : 40)) warm=$((500 / copies > 20 ? 500 / copies : 20))
    local options=(--scene bed --particles "$1" ${bed:+--positions "$bed"})
    prepare_bed "${options[@]}"
    for ((run = 1; run <= runs; ++run)); do
        say "bed of $1, run $run of $runs"
        run_ours pendular bed "${options[@]}"
        run_liggghts bed "hertz tangential history"
        if command -v lmp >/dev/null; then
            run_peer bed lammps lmp -in "$study/bed.lammps" "${vars[@]}"
        fi
        if command -v yade >/dev/null && ((copies == 1)); then
            awk -F, 'NF == 4 && $1 + 0 > 0 { print $1, $2, $3, $4 }' "$work/bed.rows" >"$work/yade.rows"
            GRAINS=$work/yade.rows BOX=$box WARM=$((warm / 5)) STEPS=$((steps / 4)) yade -n -x "-j$cores" "$study/bed_yade.py" 2>/dev/null |
                awk -v s=$((steps / 4)) -v n=25000 '/^result/ { printf "bed,yade,%d,%d,%s,\n", n, s, $2 }' >>"$raw"
        fi
    done
}

run_wet_bed() {  # particles
    local steps=2000 warm=500 box vars
    local options=(--scene wet-bed --particles "$1" ${bed:+--positions "$bed"})
    prepare_bed "${options[@]}"
    for ((run = 1; run <= runs; ++run)); do
        say "wet bed of $1, run $run of $runs"
        run_ours pendular wet-bed "${options[@]}"
        run_ours pendular-exact wet-bed "${options[@]}" --species HertzianViscoelasticMindlinLiquidBridgeYoungLaplaceSpecies
        run_liggghts wet-bed "hertz tangential history cohesion easo/capillary/viscous"
    done
}

run_mixture() {  # name, shear (1/s), skin of LIGGGHTS (m)
    local steps=2000 warm=500 shear=$2 skin=$3 box vars
    local options=(--scene polydisperse --particles 20000 --ratio 10 --shear "$shear")
    prepare_bed "${options[@]}"
    for ((run = 1; run <= runs; ++run)); do
        say "$1, run $run of $runs"
        run_ours pendular "$1" "${options[@]}"
        run_liggghts "$1" "hertz tangential history"
    done
}

# The bed settles in each run again, which gives the same one: our spheres are those of its bed.dump.
run_clumps() {  # spheres of a clump
    local steps=2000 warm=500 settle=21000 shape=$work/shape.txt
    if ! command -v liggghts >/dev/null; then
        say "clumps need LIGGGHTS, which is not installed"
        return
    fi
    awk -v n="$1" 'BEGIN { r = 1e-3; for (k = 0; k < n; k++) print (k % 2 ? r : -r), (int(k / 2) % 2 ? r : -r), (int(k / 4) ? r : -r), r }' >"$shape"
    for ((run = 1; run <= runs; ++run)); do
        say "clumps of $1, run $run of $runs"
        run_peer "clumps-of-$1" liggghts liggghts -in "$study/clumps.liggghts" -var spheres "$1" -var clumps $((10000 / $1)) \
            -var shape "$shape" -var settle $settle -var warm $warm -var steps $steps
        awk 'NF == 5 && $2 + 0 > 0 { print $2, $3, $4, $5 }' "$work/bed.dump" >"$work/clumps.rows"
        run_ours pendular "clumps-of-$1" --scene clumps --positions "$work/clumps.rows" --clumps "$1"
    done
}

run_drum() {
    local steps=1000 warm=500
    lammps_data "$drum" "-0.15 0.15 -0.1 0.1 -0.15" 2 | sed 's/^2 atom types/3 atom types/' >"$work/drum.data"
    awk 'BEGIN { print "solid drum" } NF == 9 && $1 + 0 == $1 {
        printf "facet normal 0 0 0\n outer loop\n  vertex %s %s %s\n  vertex %s %s %s\n  vertex %s %s %s\n endloop\nendfacet\n", $1, $2, $3, $4, $5, $6, $7, $8, $9 }
        END { print "endsolid drum" }' "$drum_walls" >"$work/drum.stl"
    for ((run = 1; run <= runs; ++run)); do
        say "drum, run $run of $runs"
        run_ours pendular drum --scene drum --positions "$drum" --walls "$drum_walls"
        if command -v liggghts >/dev/null; then
            run_peer drum liggghts liggghts -in "$study/drum.liggghts" -var data drum.data -var mesh drum.stl \
                -var warm $warm -var steps $steps
        fi
    done
}

for scene in "${scene_names[@]}"; do
    case $scene in
    *flowing-*) for n in "${flow_sizes[@]}"; do run_flow "$scene" "$n"; done ;;
    bed) for n in "${bed_sizes[@]}"; do run_bed "$n"; done ;;
    wet-bed) run_wet_bed "${bed_sizes[0]}" ;;
    mixture) run_mixture mixture 0 2e-4 ;;
    sheared-mixture) run_mixture sheared-mixture 100 1e-3 ;;
    clumps) for n in 2 4 8; do run_clumps "$n"; done ;;
    esac
done
if [[ -n $drum ]]; then run_drum; fi

{
    "$tools/describe-machine.sh" "$command_line; one core each, or those of --cores; medians of $runs runs in turn"
    echo "scene,code,particles,threads,steps,median_seconds,million_particle_steps_per_second,lowest,highest,kinetic_energy_J,ours_over_this"
    sort -t, -k1,1 -k3,3n -k2,2 "$raw" | awk -F, -v cores="$cores" '
        function flush(   i, j, v) {
            if (count == 0) return
            for (i = 1; i <= count; i++) for (j = i + 1; j <= count; j++) if (rate[j] < rate[i]) { v = rate[i]; rate[i] = rate[j]; rate[j] = v }
            m = int((count + 1) / 2)
            key[++rows] = scene "," n; name[rows] = code; median[rows] = rate[m]
            if (code == "pendular") own[scene "," n] = rate[m]
            line[rows] = sprintf("%s,%s,%d,%d,%d,%.4f,%.3f,%.3f,%.3f,%s", scene, code, n, cores, s, n * s / rate[m] * 1e-6, rate[m], rate[1], rate[count], ke)
            count = 0
        }
        { if ($1 != scene || $2 != code || $3 != n) { flush(); scene = $1; code = $2; n = $3 }
          s = $4; ke = $6; rate[++count] = $3 * $4 / $5 * 1e-6 }
        END { flush(); for (r = 1; r <= rows; r++) printf "%s,%.2f\n", line[r], own[key[r]] / median[r] }'
} >"$output/peers.csv"
cat "$output/peers.csv"
if command -v gnuplot >/dev/null; then
    gnuplot -c "$study/peers.gp" "$output/peers.csv" "$output/peers.png"
    say "wrote $output/peers.csv and $output/peers.png"
fi
