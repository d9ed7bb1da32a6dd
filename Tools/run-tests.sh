#!/usr/bin/env bash
# Installs what is missing, builds Pendular and runs its tests, except those labelled `long` (for these: ctest
# --preset long). With CI=true, warnings are errors, the tests run a second time under the address and
# undefined-behaviour sanitizers, and the readers of files read random files, 20 s each (libFuzzer).
#   Tools/run-tests.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
(($# == 0)) || read_options -- "$@"
cd "$(dirname "${BASH_SOURCE[0]}")/.."

jobs=$(getconf _NPROCESSORS_ONLN)

build_and_test() {  # preset
    echo "== Building (preset $1, folder build/$1)"
    cmake --preset "$1"
    cmake --build --preset "$1" --parallel "$jobs"
    echo "== Testing (preset $1)"
    ctest --preset "$1" --parallel "$jobs"
}

if [[ ${CI:-} == true ]]; then
    if command -v ccache >/dev/null; then  # what another clone has compiled is found again, whatever its folder
        export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
        export CCACHE_SLOPPINESS=pch_defines,time_macros
    fi
    Tools/install-dependencies.sh --clang --readers
    export PENDULAR_REQUIRE_DEPENDENCIES=1  # no test may leave out what needs them
    build_and_test ci
    build_and_test ci-asan-ubsan
else
    Tools/install-dependencies.sh
    build_and_test release
fi
