#!/usr/bin/env bash
# Installs what is missing, builds Pendular and runs its tests, except those labelled `long` (for these: ctest
# --preset long). With CI=true, warnings are errors, and the tests run a second time under the address and
# undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

jobs=$(getconf _NPROCESSORS_ONLN)

build_and_test() {  # preset
    echo "== Building (preset $1, folder build/$1)"
    cmake --preset "$1"
    cmake --build --preset "$1" --parallel "$jobs"
    echo "== Testing (preset $1)"
    ctest --preset "$1" --parallel "$jobs"
}

Tools/install-dependencies.sh
if [[ ${CI:-} == true ]]; then
    build_and_test ci
    build_and_test ci-asan-ubsan
else
    build_and_test release
fi
