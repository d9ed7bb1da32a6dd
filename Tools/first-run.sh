#!/usr/bin/env bash
# From a clone to the first simulation: installs the packages that are missing, configures, builds and runs one driver,
# and says where its frames are. On Debian 12 or 13 it takes some three minutes of one processor.
#   Tools/first-run.sh [--driver WetTower] [--jobs N]
# --driver NAME   a driver in the folder Drivers; those that need all of the kernel take some minutes longer
# --jobs N        files that are compiled at the same time, at most; default: one for each processor. Where installed memory
#                 (or the limit of a container) is less than 1.8 GB for each, CMake allows fewer and says so
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
driver=WetTower jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-}
read_options driver jobs -- "$@"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[[ $driver =~ ^[A-Za-z0-9]+$ ]] && compgen -G "Drivers/$driver/*.cpp" >/dev/null && [[ $driver != Shared ]] ||
    refuse "there is no driver '$driver'; the folders in Drivers are their names"
build=build/release
log=$build/first-run.log

[[ -n $jobs ]] || jobs=$(getconf _NPROCESSORS_ONLN)
require_number jobs "$jobs"

if command -v pendular >/dev/null; then
    echo "The package pendular is installed on this machine: 'pendular $driver' runs the driver without compiling it."
elif package=$(compgen -G "build/package/pendular_*.deb" | head -n 1) && [[ -n $package ]]; then
    echo "There is a package, which needs no compiling: 'apt install ./$package', then 'pendular $driver'."
fi

echo "== 1 of 4: packages"
Tools/install-dependencies.sh

# Configures and builds, and keeps what they print. Where they fail, the end of it is shown.
mkdir -p "$build"
: >"$log"
failed() {  # what, what to do
    tail -n 30 "$log" >&2
    echo "first-run.sh: $1 failed (all of it: $log). $2" >&2
    exit 1
}
tests=()
if [[ ! -f $build/CMakeCache.txt ]]; then tests=(-D PENDULAR_BUILD_TESTS=OFF); fi
echo "== 2 of 4: configuring $build"
cmake --preset release "${tests[@]}" >>"$log" 2>&1 ||
    failed "configuring" "If the folder is of another clone, version or preset, remove it (rm -r $build) and run this again."
sed -n 's/^-- \(This machine has .* MB of memory\)/   \1/p' "$log"

# What ninja says last, "[7/22] ...", every few seconds: some files take half a minute each.
say_progress() {
    local line begin=$SECONDS every=20 end='\n'
    if [[ -t 1 ]]; then every=1 end='\r'; fi
    while sleep "$every" >/dev/null 2>&1; do  # it outlives its parent, and must not keep a pipe open
        line=$(tail -n 1 "$log" | sed -n 's/^\[\([0-9]*\)\/\([0-9]*\)\].*/\1 of \2 steps done/p')
        printf "   %-24s %4d s   $end" "${line:-starting}" $((SECONDS - begin))
    done
}
echo "== 3 of 4: building $driver with up to $jobs compilers at a time; some files take half a minute"
say_progress &
progress=$!
trap 'kill "$progress" 2>/dev/null || true' EXIT
begin=$SECONDS
NINJA_STATUS="[%f/%t] " cmake --build --preset release --target "$driver" --parallel "$jobs" >>"$log" 2>&1 ||
    failed "the build" "'Killed' or 'cannot allocate memory' means too little memory: close other programs, or add --jobs 1."
kill "$progress" 2>/dev/null || true
echo "   built in $((SECONDS - begin)) s                          "

echo "== 4 of 4: running build/release/Drivers/$driver/$driver"
options=()
help=$("$build/Drivers/$driver/$driver" --help)
if [[ $help == *--paraview-interval-s* ]]; then options=(--paraview-interval-s 0.04); fi
"$build/Drivers/$driver/$driver" "${options[@]}" --output "$driver-output"
if [[ -f $driver-output/run.pvd ]]; then
    echo "The frames of the run are $PWD/$driver-output/run.pvd: open it with ParaView (www.paraview.org), or with Python and VTK."
else
    echo "The results of the run are in $PWD/$driver-output; this driver writes no frames for ParaView."
fi
echo "To change the simulation, edit Drivers/$driver/$driver.cpp and run this again."
