#!/usr/bin/env bash
# Installs the Debian packages that Pendular is built with, where they are missing.
#   Tools/install-dependencies.sh           installs
#   Tools/install-dependencies.sh --check   only says what is missing; exit code 1 if something is
#   With --readers also those with which self-tests read the files of a run; without them, these tests are skipped.
#   With --python also those of the Python module and its tests.
#   With --view also those of the server of runs in the browser (Tools/View), with --page those of its page, with
#   --browser a browser without a screen for its tests.
#   With --hosts also other programs that examples and studies take: finite elements, energies of surfaces.
#   With --mpi also those for runs on several processes (PENDULAR_MPI), and their tests.
#   With --reference also Doxygen, for the target `reference`.
#   With --clang also clang, with libFuzzer (presets asan-ubsan, tsan and fuzz), clang-format and clang-tidy.
set -euo pipefail

check=no hosts=no readers=no python=no mpi=no clang=no view=no page=no browser=no reference=no
for option in "$@"; do
    case $option in
        --check) check=yes ;;
        --readers) readers=yes ;;
        --python) python=yes ;;
        --hosts) hosts=yes ;;
        --mpi) mpi=yes ;;
        --clang) clang=yes ;;
        --view) view=yes ;;
        --page) page=yes ;;
        --browser) browser=yes ;;
        --reference) reference=yes ;;
        *)
            echo "usage: Tools/install-dependencies.sh [--check] [--readers] [--python] [--hosts] [--mpi] [--clang] [--view] [--page] [--browser] [--reference]" >&2
            exit 2
            ;;
    esac
done

# package | its program, if it has one | what it is for
packages='git|git|the source code
g++|g++|compiler (C++20)
cmake|cmake|build
ninja-build|ninja|build
libeigen3-dev||vectors and linear algebra
libfmt-dev||text
zlib1g-dev||compressed files for ParaView
libcli11-dev||command lines of drivers and tools
libgtest-dev||self-tests
libhdf5-dev||restart files, HDF5 files of fields
gnuplot-nox|gnuplot|charts
povray|povray|pictures of grains (Tools/snapshot)'
if [[ $readers == yes ]]; then
    packages+='
python3-h5py||h5py, which reads HDF5 files
python3-vtk9||VTK, which reads the files for ParaView'
fi
if [[ $python == yes ]]; then
    packages+='
python3-dev||headers of Python
pybind11-dev||the Python module
python3-numpy||arrays
python3-pytest||tests of the module
python3-h5py||h5py, which reads HDF5 files
python3-pandas||tables, for pendular.table()
python3-matplotlib||pictures, for pendular.draw()
python3-scipy||the calibration among the examples
python3-nbclient||tests of the notebooks
python3-nbformat||tests of the notebooks
python3-ipykernel||notebooks
python3-tqdm||bars of progress
mypy|mypy|types of the module
python3-pip|pip3|wheels of the module
python3-setuptools||wheels of the module
python3-wheel||wheels of the module
python3-venv||test of a wheel'
fi
if [[ $view == yes ]]; then
    packages+='
libmicrohttpd-dev||server of runs in the browser
nlohmann-json3-dev||what it sends, and the options of drivers
python3-pytest||tests of it
nodejs|node|syntax of its page'
fi
if [[ $page == yes ]]; then
    packages+='
npm|npm|the page of runs in the browser'
fi
if [[ $browser == yes ]]; then
    packages+='
chromium|chromium|the browser of tests
chromium-driver|chromedriver|the browser of tests
python3-selenium||drives the browser of tests'
fi
if [[ $hosts == yes ]]; then
    packages+='
python3-getfem||finite elements of the example Libraries/getfem_plate.py
python3-scipy||its sparse matrices
evolver-nox|evolver|Surface Evolver, for the study ThreeGrains'
fi
if [[ $mpi == yes ]]; then
    packages+='
libopenmpi-dev||MPI, for several processes
openmpi-bin|mpirun|starts them'
fi
if [[ $reference == yes ]]; then
    packages+='
doxygen|doxygen|reference of all classes and functions'
fi
if [[ $clang == yes ]]; then
    packages+='
clang|clang++|sanitizers and fuzz targets
libclang-rt-dev||libFuzzer and the sanitizers
clang-format-14|clang-format-14|check of the format
clang-tidy|clang-tidy|check for faults'
fi

is_installed() {  # package, program
    if [[ -n $2 ]] && command -v "$2" >/dev/null; then
        return 0
    fi
    command -v dpkg-query >/dev/null &&
        [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

missing=()
missing_programs=()
while IFS='|' read -r package program _; do
    if ! is_installed "$package" "$program"; then
        missing+=("$package")
        if [[ -n $program ]]; then missing_programs+=("$program"); fi
    fi
done <<<"$packages"

list_packages() {
    while IFS='|' read -r package _ purpose; do
        printf '    %-16s %s\n' "$package" "$purpose"
    done <<<"$packages"
}

if ! command -v apt-get >/dev/null; then
    echo "This system has no apt-get. Pendular needs these packages (names as in Debian):"
    list_packages
    if ((${#missing_programs[@]} > 0)); then
        echo "Not found: ${missing_programs[*]}. Please install them, and run this again." >&2
        exit 1
    fi
    echo "All programs are found; CMake will look for the libraries."
    exit 0
fi

if ((${#missing[@]} == 0)); then
    echo "All packages are installed."
    exit 0
fi
echo "Missing packages: ${missing[*]}"
if [[ $check == yes ]]; then
    exit 1
fi

as_root=()
if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
        echo "To install them, run as root:  apt-get install ${missing[*]}" >&2
        exit 1
    fi
    as_root=(sudo)
fi
echo "Installing them with apt-get ..."
${as_root[@]+"${as_root[@]}"} apt-get update -qq
${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" </dev/null
