#!/usr/bin/env bash
# Makes a Debian package for any x86-64 machine: programs and Python module for x86-64-v2, v3 and v4, of which the best is
# taken at start (all give the same bits), and, where npm is installed, the page of runs in the browser. It compiles the
# kernel three times.
#   Tools/make-package.sh [FOLDER]      default: build/package; the package is in it
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
read_argument "$@"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${1:-build/package}
cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DPENDULAR_ALL_LEVELS=ON -DPENDULAR_BUILD_TESTS=OFF \
    -DPENDULAR_PYTHON=ON
cmake --build "$folder"
if command -v npm >/dev/null; then
    cmake --build "$folder" --target view-page
else
    echo "make-package.sh: npm is not installed, so that the package has no page of runs in the browser (Tools/install-dependencies.sh --page)." >&2
fi
cd "$folder"
cpack
