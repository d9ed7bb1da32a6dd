#!/usr/bin/env bash
# What softer grains do to bulk figures, and what they save: runs the bed, the drum and the hopper of compare-bulk.sh over a row of
# moduli, with the steps that users take, beside LIGGGHTS if it is installed, and the drivers ShearCell (I = 0.1, 500 grains) and
# WetPlaneShear (P* = 1) over a row of stiffnesses, for which LIGGGHTS has no scene: no Lees-Edwards shear, no bridges of this law.
# Writes a table (CSV) and a chart (PNG): figures, how they deviate from the hardest of the same code, time of the processor.
#   Tools/Studies/BulkComparison/soften-bulk.sh [--scenes "bed drum hopper shear wet-shear"] [--moduli "5e5 5e6 5e7 5e8"] [--stiffnesses "1e2 1e3 1e4 1e5"]
#                         [--seeds "1 2 3"] [--error 0.01] [--speed 0.2] [--share 0.9] [--peer 0.2] [--skins 3e-4] [--output FOLDER] [--build DIR]
# --moduli       Pa, of bed, drum and hopper, the softest first
# --stiffnesses  of the shear cells, over pressure x diameter (wet: with the pull of a bridge over the diameter added), the softest first
# --error        of setStepFor(), at --speed (m/s); 0: without it
# --share        of the adaptive step; 0: without it
# --peer         step of LIGGGHTS over Rayleigh's time; 0: without it
# --skins        m, as of compare-bulk.sh
# --seeds        all of the first come first; 0: no runs, but the table of the runs in FOLDER/softness-runs.csv anew
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tools=$study/../..
scenes="bed drum hopper shear wet-shear" moduli="5e5 5e6 5e7 5e8" stiffnesses="1e2 1e3 1e4 1e5" seeds="1 2 3"
error=0.01 speed=0.2 share=0.9 peer=0.2 skins=3e-4 output=softness build="$tools/../build/release"
command_line="Tools/Studies/BulkComparison/soften-bulk.sh $*"
source "$tools/read-options.sh"
read_options scenes moduli stiffnesses seeds error speed share peer skins output build -- "$@"
[[ $seeds == 0 ]] || for seed in $seeds; do require_number seeds "$seed"; done
for scene in $scenes; do
    case $scene in
    bed | drum | hopper) program="$build/Tools/Studies/bulk-figures" ;;
    shear) program="$build/Drivers/ShearCell/ShearCell" ;;
    wet-shear) program="$build/Drivers/WetPlaneShear/WetPlaneShear" ;;
    *) refuse "there is no scene $scene; there are bed, drum, hopper, shear and wet-shear" ;;
    esac
    [[ $seeds == 0 ]] || require_program "$program"
done
figures="$build/Tools/Studies/bulk-figures"
mkdir -p "$output"
output=$(realpath "$output")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1
raw=$output/softness-runs.csv  # scene,code,modulus or stiffness,seed,step_s,survived,time (s), then figures by name
if [[ $seeds == 0 ]]; then
    require_file output "$raw"
    seeds=
else
    : >"$raw"
fi
say() { echo "$(date +%H:%M:%S) $*" >&2; }
source "$study/peers.sh"
keep() { echo "$1,$2,$3,$4,$5" >>"$raw"; }  # scene, code, modulus or stiffness, seed, row

# Grains so soft that they settle with overlaps beyond Hertz's law are refused, with a sentence.
or_refused() { "$@" || echo "nan,0,nan"; }
soften_scene() {  # scene, modulus (Pa), seed
    local row step
    if ! row=$("$figures" --scene "$1" --seed "$3" --modulus-Pa "$2" --data "$work/start"); then
        keep "$1" pendular-adaptive "$2" "$3" "nan,0,nan"
        return
    fi
    read -r rayleigh end between _ <<<"$row"
    local start=("$figures" --scene "$1" --start "$work/start" --modulus-Pa "$2")
    if [[ $share != 0 ]]; then keep "$1" pendular-adaptive "$2" "$3" "$(or_refused "${start[@]}" --integrator adaptive --step "$share")"; fi
    if [[ $error != 0 ]]; then
        keep "$1" pendular-for-error "$2" "$3" "$(or_refused "${start[@]}" --integrator for-error --step "$error" --speed-m-s "$speed")"
    fi
    if [[ $peer == 0 || " ${peer_codes[*]} " != *" liggghts "* ]]; then return; fi
    peer_codes=(liggghts)
    choose_skins "$1" "$2"
    step=$(awk -v r="$rayleigh" -v f="$peer" 'BEGIN { printf "%.17g", f * r }')
    run_peer "$1" liggghts "$step" "${skin_of[$1 liggghts]}" "$2" 1
    keep "$1" liggghts "$2" "$3" "$(or_refused "${start[@]}" --step "$peer" --frames "$work/frames" --seconds "$seconds")"
}

# Means of the named columns over the rows beyond a strain, as name,value,...
means() {  # table, strain, columns
    awk -F, -v from="$2" -v names="$3" '
        !head { head = 1; count = split(names, name, " "); for (k = 1; k <= NF; k++) place[$k] = k; next }
        $place["strain"] > from { rows++; for (c = 1; c <= count; c++) sum[c] += $place[name[c]] }
        END { for (c = 1; c <= count; c++) printf ",%s,%.6g", name[c], sum[c] / rows }' "$1"
}
# A run of a driver, and its user time (s): time of the whole program for a strain of 1.
run_driver() {  # scene, code, stiffness, seed, strain before, strain, columns, table, command
    local TIMEFORMAT=%U scene=$1 code=$2 stiffness=$3 seed=$4 before=$5 strain=$6 columns=$7 table=$8 took
    shift 8
    rm -rf "$work/run"
    took=$({ time "$@" --strain "$strain" --output "$work/run" >"$work/log" 2>&1 || echo failed; } 2>&1)
    if [[ $took == *failed* ]]; then keep "$scene" "$code" "$stiffness" "$seed" "nan,0,nan"; return; fi
    keep "$scene" "$code" "$stiffness" "$seed" \
        "$(step_of_run),1,$(awk -v t="$took" -v s="$strain" 'BEGIN { printf "%.5g", t / s }')$(means "$work/run/$table" "$before" "$columns")"
}
step_of_run() { awk '/[Tt]ime step/ { for (k = 1; k <= NF; k++) if ($k + 0 > 0) { print $k; exit } }' "$work/log"; }

soften_shear() {  # stiffness over pressure x diameter, seed: the solid fraction at the start differs
    local cell=("$build/Drivers/ShearCell/ShearCell" --inertial-number 0.1 --number 500
        --stiffness "$(awk -v k="$1" 'BEGIN { print 100 * k }')" --solid-fraction "$(awk -v s="$2" 'BEGIN { print 0.57 + 0.005 * s }')")
    local columns="solid_fraction friction contacts_of_a_grain granular_temperature_m2/s2"
    run_driver shear pendular-50-steps "$1" "$2" 5 25 "$columns" stress.csv "${cell[@]}"
    if [[ $error != 0 ]]; then
        run_driver shear pendular-for-error "$1" "$2" 5 25 "$columns" stress.csv "${cell[@]}" --collision-error "$error"
    fi
}
soften_wet_shear() {  # stiffness, seed
    run_driver wet-shear pendular-20-steps "$1" "$2" 8 25 "solid_fraction friction" shear.csv \
        "$build/Drivers/WetPlaneShear/WetPlaneShear" --stiffness "$1" --seed "$2"
}

for seed in $seeds; do
    for scene in $scenes; do
        if [[ $scene == *shear ]]; then values=$stiffnesses; else values=$moduli; fi
        for value in $values; do
            say "$scene, seed $seed, $value"
            case $scene in
            shear) soften_shear "$value" "$seed" ;;
            wet-shear) soften_wet_shear "$value" "$seed" ;;
            *) soften_scene "$scene" "$value" "$seed" ;;
            esac
        done
    done
done

{
    "$tools/describe-machine.sh" "$command_line; one thread each; user time of the processor (of bed, drum and hopper in Pendular with system time), medians of the seeds, in turn"
    awk -F, -f "$study/soft-table.awk" "$raw"
} >"$output/softness.csv"
cat "$output/softness.csv"
if command -v gnuplot >/dev/null; then
    gnuplot -c "$study/softness.gp" "$output/softness.csv" "$output/softness.png"
    say "wrote $output/softness.csv and $output/softness.png"
fi
