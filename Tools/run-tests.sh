#!/usr/bin/env bash
# Installs what is missing, builds Pendular and runs its tests, except those labelled `long` (for these: ctest
# --preset long) and those of the studies (preset studies). With CI=true, format and faults that clang-tidy finds are
# checked first, warnings are errors, random scenes and the tests of folders that these do not cover run a second time
# under the address and undefined-behaviour sanitizers (all tests: preset asan-ubsan), the readers of files read random
# files, 8 s each (libFuzzer), and the tests of threads run under the thread sanitizer. With Doxygen, which CI installs
# where it can, the reference of classes and functions is written.
# At the end it says what each stage took.
#   Tools/run-tests.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
source "$(dirname "${BASH_SOURCE[0]}")/time-stages.sh"
(($# == 0)) || read_options -- "$@"
cd "$(dirname "${BASH_SOURCE[0]}")/.."

jobs=$(getconf _NPROCESSORS_ONLN)
build_and_test() {  # preset
    stage "Configuring (preset $1, folder build/$1)" cmake --preset "$1" -D PENDULAR_BUILD_TESTS=ON \
        -D PENDULAR_QUICK_TEST_BUILD=ON
    stage "Building (preset $1)" cmake --build --preset "$1" --parallel "$jobs"
    stage "Testing (preset $1)" ctest --preset "$1" --parallel "$jobs"
}
write_reference() {  # preset
    if cmake --build --preset "$1" --target help | grep '^reference:' >/dev/null; then
        stage "Reference (preset $1)" cmake --build --preset "$1" --target reference
    else
        echo "== Reference: left out, as there is no Doxygen 1.9.4 or later"
    fi
}

if [[ ${CI:-} == true ]]; then
    if command -v ccache >/dev/null; then  # what another clone has compiled is found again, whatever its folder
        export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
        export CCACHE_SLOPPINESS=pch_defines,time_macros
    fi
    stage "Installing" Tools/install-dependencies.sh --clang --readers --python --mpi --view
    Tools/install-dependencies.sh --reference || echo "== Doxygen cannot be installed"  # nothing else needs it
    export PENDULAR_REQUIRE_DEPENDENCIES=1  # no test may leave out what needs them
    stage "Format" Tools/check-format.sh
    # All files of the kernel take ten minutes: of a change that is so large it is left to Tools/check-tidy.sh by hand.
    if ! git rev-parse --quiet --verify HEAD~1 >/dev/null; then
        echo "== clang-tidy: left out, as there is no commit before this one to compare with"
    elif (($(git diff --name-only HEAD~1 -- Kernel | wc -l) > 40)); then
        echo "== clang-tidy: left out, as more than 40 files of the kernel have changed"
    else
        stage "clang-tidy" Tools/check-tidy.sh --since HEAD~1
    fi
    build_and_test ci
    write_reference ci
    build_and_test ci-asan-ubsan
    build_and_test ci-tsan
else
    Tools/install-dependencies.sh
    build_and_test release
    write_reference release
fi
