#!/usr/bin/env bash
# Measures what fields cost and how they err, over the grid, the cut-off and the time between samples. Prints CSV.
#   Tools/Studies/FieldCosts/measure-fields.sh [--bed FILE] [--samples 5] [--strain 4] [--build build/release] > fields.csv
# --bed FILE  rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build="$tools/../build/release" bed="" samples=5 strain=4
command_line="Tools/Studies/FieldCosts/measure-fields.sh $*"
source "$tools/read-options.sh"
read_options bed samples strain build -- "$@"
require_file bed "$bed"
require_number samples "$samples"
require_program "$build/Tools/Studies/field-costs"
[[ -z $bed ]] || command_line=${command_line/"$bed"/"${bed##*/}"}
"$tools/describe-machine.sh" "$command_line; one thread; least processor times"
"$build/Tools/Studies/field-costs" ${bed:+--positions "$bed"} --samples "$samples" --strain "$strain"
