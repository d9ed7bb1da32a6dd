#!/usr/bin/env bash
# What a scene pays for: the same bed with nothing but elasticity and damping, then with friction, bridges, liquid that
# moves, viscous forces, wet walls and a spray, each row in turn; writes medians as a table (CSV) and a chart (PNG).
#   Tools/measure-features.sh [--runs 5] [--steps 1000] [--output FOLDER] [--build build/release] [--bed FILE] [--only REGEX]
# --bed FILE  rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself
# --only REGEX  rows of these names; "friction" should be among them, to which times are compared
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
runs=5 steps=1000 output=features build="$tools/../build/release" bed="" only=""
command_line="Tools/measure-features.sh $*"
source "$tools/read-options.sh"
read_options runs steps output build bed only -- "$@"
require_number runs "$runs"
require_number steps "$steps"
require_file bed "$bed"
require_program "$build/Tools/benchmark-scenes"
mkdir -p "$output"
rows=$(mktemp)
trap 'rm -f "$rows"' EXIT

scenes=(
    "no friction:HertzianViscoelasticSpecies"
    "friction:HertzianViscoelasticMindlinSpecies"
    "rolling and torsion:HertzianViscoelasticMindlinRollingTorsionSpecies"
    "bridge, Willett:HertzianViscoelasticMindlinLiquidBridgeWillettSpecies"
    "bridge, Bagheri:HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies"
    "bridge, exact:HertzianViscoelasticMindlinLiquidBridgeYoungLaplaceSpecies"
    "liquid that moves, Willett:HertzianViscoelasticMindlinLiquidMigrationWillettSpecies"
    "viscous bridge, Willett:HertzianViscoelasticMindlinViscousLiquidBridgeWillettSpecies"
    "viscous, liquid moves, LS:HertzianViscoelasticMindlinViscousLiquidMigrationLSSpecies"
    "wet walls::wet-walls"
    "spray, liquid moves:HertzianViscoelasticMindlinLiquidMigrationWillettSpecies:sprayed-bed"
)
for ((run = 1; run <= runs; ++run)); do
    echo "$(date +%H:%M:%S) run $run of $runs" >&2
    for number in "${!scenes[@]}"; do
        IFS=: read -r what species scene <<<"${scenes[$number]}"
        [[ $what =~ $only ]] || continue
        "$build/Tools/benchmark-scenes" --scene "${scene:-bed}" ${bed:+--positions "$bed"} ${species:+--species "$species"} --steps "$steps" --warm 500 |
            awk -F, -v what="$what" -v order="$number" '{ printf "%d;%s;%s;%d;%s;%s;%s\n", order, what, $2, $3, $7, $8, $10 }' >>"$rows"
    done
done
{
    "$tools/describe-machine.sh" "$command_line; one thread; medians of $runs runs in turn"
    echo "scene;species;particles;ns_per_particle_step;of_friction_alone;bytes_per_particle"
    sort -t';' -k1,1n -k6,6n "$rows" | awk -F';' -v middle=$(((runs + 1) / 2)) '
        $1 != last { last = $1; count = 0 }
        ++count == middle { what[++n] = $2; species[n] = $3; particles[n] = $4; time[n] = 1e9 * $6 / ($4 * $5); bytes[n] = $7
                            if ($2 == "friction") one = time[n] }
        END { for (k = 1; k <= n; k++) printf "%s;%s;%d;%.2f;%.3f;%.0f\n", what[k], species[k], particles[k], time[k], time[k] / one, bytes[k] }'
} >"$output/features.csv"
cat "$output/features.csv"
if command -v gnuplot >/dev/null; then
    gnuplot -c "$tools/features.gp" "$output/features.csv" "$output/features.png"
    echo "wrote $output/features.csv and $output/features.png" >&2
fi
