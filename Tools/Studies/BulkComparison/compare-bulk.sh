#!/usr/bin/env bash
# Runs five small scenes in Pendular and in those of LIGGGHTS and LAMMPS that are installed, over a row of time steps, in turn,
# one thread each, and writes tables (CSV) and charts (PNG): bulk figures, how they deviate from those at the smallest step of
# the same code, the time of the processor for a second of the scene (steps alone: no start-up, no frames), and what the
# same error takes, ours over theirs. All codes begin with the same grains.
#   Tools/Studies/BulkComparison/compare-bulk.sh [--scenes "bed drum hopper silo impact"] [--seeds "1 2 3 4 5 6"] [--ours "0.15 0.3 0.5 0.6 0.7 0.8"] [--peers "0.15 0.3 0.4 0.5 0.6"]
#                         [--schemes "default velocity-verlet"] [--share 0.9] [--skins "2e-4 4e-4 8e-4"] [--output FOLDER] [--build DIR]
# --ours, --peers  steps over Rayleigh's time of the largest grain, the smallest first: the reference
# --share          of the adaptive step; 0: without it
# --skins          of the peers, m: of each scene the one that took them the least time at a share of the run counts
# --build DIR      a build folder; build/release if not given
# --seeds          all scenes of the first come first; 0: no runs, but the tables of the runs in FOLDER/bulk-runs.csv anew
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tools=$study/../..
scenes="bed drum hopper silo impact" seeds="1 2 3 4 5 6" ours="0.15 0.3 0.5 0.6 0.7 0.8" peers="0.15 0.3 0.4 0.5 0.6" share=0.9
schemes="default velocity-verlet" skins="2e-4 4e-4 8e-4" output=bulk build="$tools/../build/release"
command_line="Tools/Studies/BulkComparison/compare-bulk.sh $*"
source "$tools/read-options.sh"
read_options scenes seeds ours peers schemes share skins output build -- "$@"
[[ $seeds == 0 ]] || for seed in $seeds; do require_number seeds "$seed"; done
program="$build/Tools/Studies/bulk-figures"
[[ $seeds == 0 ]] || require_program "$program"
mkdir -p "$output"
output=$(realpath "$output")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=1
raw=$work/raw.csv  # scene,code,share of Rayleigh's time or of the bound,seed, and what bulk-figures prints
: >"$raw"
if [[ $seeds == 0 ]]; then
    require_file output "$output/bulk-runs.csv"
    cp "$output/bulk-runs.csv" "$raw"
    seeds=
fi
say() { echo "$(date +%H:%M:%S) $*" >&2; }

source "$study/peers.sh"
keep() {  # scene, code, step, seed, row
    echo "$1,$2,$3,$4,$5" >>"$raw"
}

for seed in $seeds; do
    for scene in $scenes; do
        say "$scene, seed $seed"
        read -r rayleigh end between _ < <("$program" --scene "$scene" --seed "$seed" --data "$work/start")
        start=("$program" --scene "$scene" --start "$work/start")
        choose_skins "$scene" 5e6
        for step in $ours; do
            for integrator in $schemes; do
                row=$("${start[@]}" --integrator "$integrator" --step "$step")  # a wrong option ends the script
                keep "$scene" "pendular-$integrator" "$step" "$seed" "$row"
            done
        done
        if [[ $share != 0 ]]; then
            row=$("${start[@]}" --integrator adaptive --step "$share")
            keep "$scene" pendular-adaptive "$share" "$seed" "$row"
        fi
        for step in $peers; do
            for code in "${peer_codes[@]}"; do
                run_peer "$scene" "$code" "$(awk -v r="$rayleigh" -v f="$step" 'BEGIN { printf "%.17g", f * r }')" "${skin_of[$scene $code]}" 5e6 1
                keep "$scene" "$code" "$step" "$seed" "$("${start[@]}" --step "$step" --frames "$work/frames" --seconds "$seconds")"
            done
        done
    done
    cp "$raw" "$output/bulk-runs.csv"
done

{
    "$tools/describe-machine.sh" "$command_line; one thread each; user time of the processor (of Pendular with system time), medians of the seeds, in turn"
    awk -F, -f "$study/bulk-table.awk" "$raw"
} >"$output/bulk-peers.csv"
{
    "$tools/describe-machine.sh" "$command_line; of bulk-peers.csv by same-error.awk"
    awk -F, -f "$study/same-error.awk" "$output/bulk-peers.csv"
} >"$output/same-error.csv"
cat "$output/bulk-peers.csv" "$output/same-error.csv"
if command -v gnuplot >/dev/null; then
    gnuplot -c "$study/bulk.gp" "$output/bulk-peers.csv" "$output/bulk-peers.png"
    gnuplot -c "$study/same-error.gp" "$output/same-error.csv" "$output/same-error.png"
    say "wrote bulk-peers and same-error, .csv and .png, in $output"
fi
