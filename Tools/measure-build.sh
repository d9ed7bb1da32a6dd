#!/usr/bin/env bash
# Measures what it takes to build Pendular: in a fresh folder, without a compiler cache, the targets one after the
# other (each row is what a target takes beyond those before it), and last, one driver again after its .cpp was
# touched: the time from an edit to the program. With --all also what an edit of one header of the kernel makes anew,
# tests included. Of several runs, each in a folder of its own, each column has its median.
#   Tools/measure-build.sh [--runs 3] [--threads 1] [--targets "NAME..."] [--edit WetTower] [--build FOLDER] [--all] > build.csv
# --targets NAMES   the default is PendularKernel PendularDrivers WetTower TwoParticleCollision accuracy-versus-cost
#                   bridge-scenes
# --edit DRIVER     the driver that is touched
# --threads N       files that are compiled at the same time
# --build FOLDER    where the build folders are made, and removed again; a temporary one if not given
# --all             also builds everything, with the tests and the studies, before the edits
# --header FILE     the header that is touched then; Kernel/Features/MovingWalls/PlaneMotion.h if not given
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
runs=3 threads=1 edit=WetTower header=Kernel/Features/MovingWalls/PlaneMotion.h build="${TMPDIR:-/tmp}" all=""
targets="PendularKernel PendularDrivers WetTower TwoParticleCollision accuracy-versus-cost bridge-scenes"
command_line="Tools/measure-build.sh $*"
source "$tools/read-options.sh"
arguments=()
for argument; do if [[ $argument == --all ]]; then all=all; else arguments+=("$argument"); fi; done
read_options runs threads targets edit header build -- "${arguments[@]}"
require_number runs "$runs"
require_number threads "$threads"
source_folder=$(dirname "$tools")
edited=$source_folder/Drivers/$edit/$edit.cpp
require_file edit "$edited"
require_file header "$source_folder/$header"
[[ -d $build && -w $build ]] || refuse "--build is '$build'; there is no such folder that can be written"
[[ -x /usr/bin/time ]] || refuse "/usr/bin/time is not installed (Debian package time)"
work=$(mktemp -d "$build/pendular-build-XXXXXX")
trap 'rm -rf "$work"' EXIT
export CCACHE_DISABLE=1
unset CMAKE_CXX_COMPILER_LAUNCHER CMAKE_C_COMPILER_LAUNCHER

say() { echo "$*" >&2; }
# Runs a command; what it prints is shown only where it fails.
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log" >&2; refuse "'$*' failed"; }; }

# Appends "wall processor memory" to the times of a row: s, s, and MB of the largest process.
build_target() {  # row, folder, target
    say "  $1"
    quietly /usr/bin/time -o "$work/time" -f "%e %U %S %M" cmake --build "$2" --parallel "$threads" --target "$3"
    awk '{ print $1, $2 + $3, $4 * 1.024e-3 }' "$work/time" >>"$work/times.${1// /-}"
}
median() {  # row, column
    sort -g -k "$2,$2" "$work/times.${1// /-}" | awk -v c="$2" '{ v[NR] = $c } END { printf "%.4g", (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'
}

for ((run = 1; run <= runs; ++run)); do
    say "run $run of $runs"
    folder=$work/build
    tests=OFF
    [[ -z $all ]] || tests=ON
    quietly cmake --preset release -S "$source_folder" -B "$folder" -D CMAKE_CXX_COMPILER_LAUNCHER= -D PENDULAR_BUILD_TESTS=$tests -D PENDULAR_BUILD_STUDIES=$tests
    for target in $targets $all; do build_target "$target" "$folder" "$target"; done
    quietly cmake --build "$folder" --parallel "$threads" --target "$edit"
    sleep 1  # the time of a file has to be later than that of what was made from it
    touch "$edited"
    build_target "edit $edit" "$folder" "$edit"
    if [[ -n $all ]]; then
        touch "$source_folder/$header"
        build_target "edit $(basename "$header")" "$folder" all
    fi
    rm -rf "$folder"
done

commit=$(git -C "$source_folder" rev-parse --short HEAD 2>/dev/null || echo unknown)
git -C "$source_folder" diff --quiet HEAD 2>/dev/null || commit=$commit+changes
"$tools/describe-machine.sh" "$command_line"
echo "target,wall_s,processor_s,largest_process_MB,runs,threads,commit"
rows=($targets $all "edit $edit")
[[ -z $all ]] || rows+=("edit $(basename "$header")")
for target in "${rows[@]}"; do
    echo "$target,$(median "$target" 1),$(median "$target" 2),$(median "$target" 3),$runs,$threads,$commit"
done
