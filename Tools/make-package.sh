#!/usr/bin/env bash
# Makes a Debian package for any x86-64 machine: the programs and the library for x86-64-v2, and the Python module for
# v2, v3 and v4, of which the best is taken at start (all give the same bits). It compiles the kernel three times.
#   Tools/make-package.sh [FOLDER]      default: build/package; the package is in it
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
read_argument "$@"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${1:-build/package}
for level in v2 v3 v4; do
    cmake -S . -B "$folder/$level" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPENDULAR_INSTRUCTION_SET="x86-64-$level" \
        -DPENDULAR_BUILD_TESTS=OFF -DPENDULAR_PYTHON=ON -DPENDULAR_PYTHON_KERNEL_FOLDER="x86-64-$level"
    target=PendularPython
    if [[ $level == v2 ]]; then target=all; fi
    cmake --build "$folder/$level" --target "$target"
done
cd "$folder"
cpack --config v2/CPackConfig.cmake -D CPACK_INSTALL_CMAKE_PROJECTS="$PWD/v2;Pendular;ALL;/;$PWD/v3;Pendular;python;/;$PWD/v4;Pendular;python;/"
