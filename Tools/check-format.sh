#!/usr/bin/env bash
# Says which .h and .cpp files do not have the format of .clang-format, and ends with exit code 1 if there are any.
#   Tools/check-format.sh [--fix] [FILE...]
# Without names: all of them; files of other kinds are left as they are. --fix writes the format.
# clang-format 14 it is; other versions break lines in other places.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
mode=(--dry-run -Werror)
case ${1:-} in
    -h | --help) print_head; exit 0 ;;
    --fix) mode=(-i); shift ;;
    -*) refuse "there is no option $1; see --help" ;;
esac
program=$(command -v clang-format-14 || command -v clang-format) ||
    refuse "clang-format is not installed (Tools/install-dependencies.sh --clang)"
[[ $("$program" --version) == *"version 14."* ]] || refuse "$program is not version 14 (Debian package clang-format-14)"
if (($# == 0)); then
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    mapfile -t files < <(find Kernel Drivers SelfTests Tools -name '*.h' -o -name '*.cpp')
    set -- "${files[@]}"
fi
sources=()
for file; do [[ $file != *.h && $file != *.cpp ]] || sources+=("$file"); done
if ((${#sources[@]} > 0)); then "$program" "${mode[@]}" "${sources[@]}"; fi
