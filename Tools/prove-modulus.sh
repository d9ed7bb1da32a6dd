#!/usr/bin/env bash
# Tests whether grains are hard enough: runs a command with a modulus E and with 3 E, with some seeds each, and compares a
# figure. A figure that changes as overlaps do, by E^(-2/3), is 1/(1 - 3^(-2/3)) = 1.93 times as far from that of hard
# grains as from that at 3 E. Where so much is more than the wanted error and than two standard errors, E is refuted (exit
# code 1); where two standard errors are more than the wanted error, more starts are needed to tell (exit code 3).
#   Tools/prove-modulus.sh --command 'COMMAND with {modulus}, {seed} and {output}' --modulus-Pa 5e6 --file TABLE.csv --column NAME
#                          [--error-percent 1] [--starts 3] [--from-share 0] [--output FOLDER]
# --command     {output} is the folder of a run, below FOLDER
# --file        the table in it, with names in the first line that is no comment (#)
# --column      whose mean over the rows is the figure; of a table of names and values (summary), give "NAME in the first column"
# --from-share  rows before this share of the table are left out: 0.5 takes the last half
# Example, with the drum's angle (an hour):
#   Tools/prove-modulus.sh --command 'build/release/Tools/Studies/bulk-figures --scene drum --elastic-modulus-Pa {modulus} --seed {seed} --output {output}/figures.csv' \
#       --modulus-Pa 5e6 --file figures.csv --column angle_of_centre_deg
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
command="" modulus_Pa="" file="" column="" error_percent=1 starts=3 from_share=0 output=prove-modulus
command_line="Tools/prove-modulus.sh $*"
source "$tools/read-options.sh"
read_options command modulus-Pa file column error-percent starts from-share output -- "$@"
require_value() { [[ -n $2 ]] || refuse "--$1 is not given; see --help"; }
require_value command "$command"
require_value modulus-Pa "$modulus_Pa"
require_value file "$file"
require_value column "$column"
require_number starts "$starts"
require_quantity() { awk -v x="$2" 'BEGIN { exit !(x + 0 > 0 && x ~ /^[0-9.eE+-]+$/) }' || refuse "--$1 is '$2'; it must be a number above 0"; }
require_quantity modulus-Pa "$modulus_Pa"
require_quantity error-percent "$error_percent"
awk -v x="$from_share" 'BEGIN { exit !(x ~ /^[0-9.]+$/ && x < 1) }' || refuse "--from-share is '$from_share'; it must be from 0 to below 1"
for place in '{modulus}' '{seed}' '{output}'; do
    [[ $command == *"$place"* ]] || refuse "--command has no $place, so that runs would not differ by it"
done
((starts >= 2)) || refuse "--starts is '$starts'; the scatter needs 2 at least"

# The mean of a column over the rows from a share of the table on.
figure_of() {  # table
    awk -F, -v name="$column" -v from="$from_share" '
        /^#/ || NF == 0 { next }
        !head { head = 1; for (k = 1; k <= NF; k++) { title = $k; gsub(/^[" ]+|[" ]+$/, "", title); if (title == name) column = k } }
        { rows++; first[rows] = $1; line[rows] = column ? $column : $2 }
        END {
            if (!column) { for (k = 1; k <= rows; k++) if (first[k] == name) { printf "%.17g", line[k]; exit 0 }; exit 1 }
            for (k = 2 + int(from * (rows - 1)); k <= rows; k++) { sum += line[k]; count++ }
            if (!count) exit 1
            printf "%.17g", sum / count
        }' "$1"
}
mkdir -p "$output"
table="$output/prove-modulus.csv"
{
    "$tools/describe-machine.sh" "$command_line"
    echo "modulus_Pa,seed,$column"
} >"$table"
for factor in 1 3; do
    modulus=$(awk -v e="$modulus_Pa" -v f="$factor" 'BEGIN { printf "%.6g", e * f }')
    for ((seed = 1; seed <= starts; ++seed)); do
        run="$output/$modulus-Pa-seed-$seed"
        mkdir -p "$run"
        filled=${command//'{modulus}'/$modulus} filled=${filled//'{seed}'/$seed} filled=${filled//'{output}'/$run}
        echo "$(date +%H:%M:%S) $filled" >&2
        bash -c "$filled" >"$run/log.txt" 2>&1 || refuse "the run with $modulus Pa and seed $seed failed: $(tail -1 "$run/log.txt")"
        [[ -f $run/$file ]] || refuse "the run wrote no $run/$file"
        figure=$(figure_of "$run/$file") || refuse "$run/$file has no column and no row '$column'"
        echo "$modulus,$seed,$figure" >>"$table"
    done
done
awk -F, -v wanted="$error_percent" -v name="$column" '
    /^#/ || $1 == "modulus_Pa" { next }
    { if (!($1 in count)) order[++kinds] = $1; count[$1]++; sum[$1] += $3; square[$1] += $3 * $3 }
    END {
        for (k = 1; k <= 2; k++) {
            e = order[k]; n = count[e]; mean[k] = sum[e] / n
            spread = square[e] / n - mean[k] * mean[k]
            error2[k] = (spread > 0 ? spread : 0) / (n - 1)
            printf "%s Pa: %s = %.6g +- %.2g\n", e, name, mean[k], sqrt(error2[k])
        }
        size = mean[2] < 0 ? -mean[2] : mean[2]
        if (size == 0) { print "the figure is 0 with 3 E: no share of it can be told"; exit 3 }
        farther = 1 / (1 - 3 ^ (-2 / 3))
        change = 100 * (mean[1] - mean[2]) / size; twice = farther * 200 * sqrt(error2[1] + error2[2]) / size
        away = farther * (change < 0 ? -change : change)
        printf "E against 3 E: %+.2f %%; against hard grains some %+.2f %% +- %.2f %% (two standard errors); wanted: %s %%\n", change, farther * change, twice, wanted
        if (away > wanted && away > twice) { print "refuted: take a harder modulus"; exit 1 }
        if (twice > wanted) { print "not told: two standard errors are more than the wanted error; take more starts"; exit 3 }
        print "not refuted: E is hard enough for this figure"
    }' "$table"
