#!/usr/bin/env bash
# Measures a frame in each format: its size, and the processor time that it takes, beside that of 1000 steps of the same
# run; and VTK's own writer where it is installed (Debian package python3-vtk9). Prints CSV. Both times are the
# shortest of many measurements.
#   Tools/Studies/OutputCosts/measure-output.sh [--bed FILE] [--particles 250000] [--steps 300] [--build build/release] > output.csv
# --bed FILE  rows radius x y z: the bed of Dosta et al. (2024) instead of the one that Pendular makes by itself
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tools=$study/../..
build="$tools/../build/release" bed="" particles=250000 steps=300
command_line="Tools/Studies/OutputCosts/measure-output.sh $*"
source "$tools/read-options.sh"
read_options bed particles steps build -- "$@"
require_file bed "$bed"
require_number particles "$particles"
require_number steps "$steps"
require_program "$build/Tools/Studies/output-costs"
[[ -z $bed ]] || command_line=${command_line/"$bed"/"${bed##*/}"}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$tools/describe-machine.sh" "$command_line; threads: 1"
"$build/Tools/Studies/output-costs" ${bed:+--positions "$bed"} --particles "$particles" --steps "$steps" --output "$folder/frames" |
    tee "$folder/rows"
if /usr/bin/python3 -c 'import vtk' 2>/dev/null; then
    step=$(awk -F, '$7 > 0 {step = 0.1 * $6 / $7} END {print step}' "$folder/rows")  # s, of the most expensive row
    /usr/bin/python3 "$study/write-with-vtk.py" "$folder/frames" "$step"
else
    echo "measure-output.sh: VTK's Python module is not installed (python3-vtk9); its writer is not measured." >&2
fi
