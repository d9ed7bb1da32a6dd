#!/usr/bin/env bash
# Tries what must not be done with the Python module under the address sanitizer, with the assertions of the standard library and
# those of pybind11 that the interpreter is held. It compiles the kernel again, with g++.
#   Tools/check-python.sh [FOLDER]      default: build/python-asan
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
read_argument "$@"
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${1:-build/python-asan}
checks="-fsanitize=address -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS -DPYBIND11_DETAILED_ERROR_MESSAGES"
checks+=" -DPYBIND11_ASSERT_GIL_HELD_INCREF_DECREF"
cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" -DCMAKE_CXX_FLAGS="$checks" \
    -DPENDULAR_PYTHON=ON -DPENDULAR_BUILD_TESTS=OFF -DPENDULAR_PYTHON_SHAPED_SPECIES=HertzianViscoelasticMindlinSpecies
export ASAN_OPTIONS=detect_leaks=0:verify_asan_link_order=0  # the interpreter keeps what it has until its end
cmake --build "$folder" --target PendularPython
python=$(sed -n 's/^_\?Python_EXECUTABLE:[A-Z]*=//p' "$folder/CMakeCache.txt" | head -1)
folder=$(realpath "$folder")
cd SelfTests/Python
# -s: what the sanitizer says comes through. The tests of costs and of types need no sanitizer.
LD_PRELOAD="$(g++ -print-file-name=libasan.so) $(g++ -print-file-name=libstdc++.so)" PYTHONPATH=$folder/Python PYTHONDONTWRITEBYTECODE=1 \
    "${python:-/usr/bin/python3}" -m pytest -q -s -p no:cacheprovider refusals_test.py guards_test.py parts_test.py arrays_test.py run_test.py
