#!/usr/bin/env bash
# Has clang-tidy look for the faults that .clang-tidy lists, in files of the kernel and the headers they include. Ends with
# an exit code other than 0 if it finds one.
#   Tools/check-tidy.sh [--since COMMIT | --all | FILE...]
# --since COMMIT  files that differ from this commit; if it is not given, from origin/main, or from the commit before
#                 this one where nothing differs from origin/main
# --all           all .cpp files: some minutes
# Files of one folder are read as one, which takes a quarter of the time. Where two of them use a name twice, so that they
# do not compile together, they are read apart.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
folder=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$folder/build/tidy

# The files of a group, as one, or where that does not compile its halves.
check() {
    local unit output half=$(($# / 2))
    unit=$(mktemp "$build/group-XXXXXX.cpp")
    printf '#include "%s"\n' "$@" >"$unit"
    if output=$(xargs -a "$build/flags" clang-tidy --quiet --config-file="$folder/.clang-tidy" "$unit" -- 2>&1); then
        rm "$unit"
        return
    fi
    rm "$unit"
    if (($# == 1)) || [[ $output != *clang-diagnostic-error* ]]; then
        echo "$output"
        return 1
    fi
    check "${@:1:half}" && check "${@:half+1}"
}

all_files() { (cd "$folder" && find Kernel -name '*.cpp' | sort); }
exists() { git -C "$folder" rev-parse --quiet --verify "$1^{commit}" >/dev/null 2>&1; }  # commit
changed_since() {  # commit
    exists "$1" || refuse "there is no commit $1; give one with --since, or --all"
    git -C "$folder" diff --name-only --diff-filter=d "$1" -- 'Kernel/*.cpp' 'Kernel/*.h'
}

case ${1:-} in
    -h | --help) print_head; exit 0 ;;
    --group) shift; check "$@"; exit ;;
    --all) (($# == 1)) || refuse "--all has no value; see --help"; files=$(all_files) ;;
    --since) (($# == 2)) || refuse "--since needs a value; see --help"; files=$(changed_since "$2") ;;
    -*) refuse "there is no option $1; see --help" ;;
    "")
        since=HEAD~1
        if exists origin/main && ! git -C "$folder" diff --quiet origin/main; then since=origin/main; fi
        if exists "$since"; then files=$(changed_since "$since"); else files=$(all_files); fi
        ;;
    *) files=$(for file; do realpath --relative-to "$folder" "$file"; done) ;;
esac
if [[ -z $files ]]; then
    echo "check-tidy.sh: no file of the kernel has changed"
    exit 0
fi
for program in clang++ clang-tidy; do
    command -v "$program" >/dev/null || refuse "$program is not installed (Tools/install-dependencies.sh --clang)"
done

# The flags of clang for a file of the kernel, with those for HDF5 and MPI; and what CMake generates.
cmake -G Ninja -S "$folder" -B "$build" -D CMAKE_CXX_COMPILER=clang++ -D CMAKE_BUILD_TYPE=Release -D CMAKE_EXPORT_COMPILE_COMMANDS=ON \
    -D PENDULAR_PRECOMPILED_HEADERS=OFF -D PENDULAR_FILES_AT_A_TIME=0 -D PENDULAR_BUILD_TESTS=OFF >/dev/null
sed -n 's/^ *"command": ".*clang++ \(.*\) -o .*Kernel\/Foundation\/State\/Hdf5File.cpp",$/\1/p' "$build/compile_commands.json" >"$build/flags"
mpi=$(grep '"command".*MpiRanks.cpp' "$build/compile_commands.json" || true)
grep -o -e '-isystem [^ ]*' <<<"$mpi" >>"$build/flags" || true
# The places of the module of MPI, which one file is given; as a shell reads them.
grep '"command".*ProgramRanks.cpp' "$build/compile_commands.json" | grep -o -e '-DPENDULAR_[A-Z_]*MODULE=[^ ]*' |
    sed 's/\\\\/\\/g; s/\\"/"/g' >>"$build/flags" || true
if [[ -z $mpi ]]; then files=$(grep -v MpiRanks.cpp <<<"$files") || exit 0; fi
awk -F/ '{ name = $0; sub("/[^/]*$", "", name); row[name] = row[name] " " $0 } END { for (name in row) print row[name] }' <<<"$files" |
    xargs -P "$(getconf _NPROCESSORS_ONLN)" -L 1 "$folder/Tools/check-tidy.sh" --group
