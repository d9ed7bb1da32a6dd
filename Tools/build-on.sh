#!/usr/bin/env bash
# Builds and tests the committed state of this repository on a bare Debian 12 (bookworm) or 13 (trixie), as a newcomer
# does. debootstrap makes the bare system in a folder, and all commands run in that folder (chroot). Needs root and
# the permission to mount. It ends at the first stage that fails, and prints the time of each stage.
#   Tools/build-on.sh [bookworm|trixie] [--stages "first python server ranks tests"] [--jobs 2]      default: trixie
# --stages NAMES    which stages, in this order:
#                   first    the commands of README, "A first simulation", as they are
#                   python   the commands and the program of README, "Or in Python", as they are
#                   server   the server of runs in the browser, which is asked for the run of the first stage
#                   ranks    the first simulation on 1 and 2 processes (mpirun), whose restart files must be equal
#                   tests    all tests but those labelled `long`; they may leave out nothing for want of a package
#                   A warning of the compiler is an error.
# --folder FOLDER   the folder of the system; default: build/roots/NAME. It is kept, and the next run goes on there:
#                   packages are not installed and files not compiled again. To begin anew, remove it.
# --shared FOLDER   the reference data, which no test may leave out then
# --ccache FOLDER   a folder of ccache's, also across systems; compiled files are taken from there
# --jobs N          files that are compiled, and tests that run, at the same time; default: one for each processor
# --mirror ADDRESS  where packages come from; default: where this machine has its own from, if it is a Debian
# From this machine it takes how packages are fetched (apt's settings `Acquire`, proxies in the environment, names of
# hosts, further certificates).
set -euo pipefail
given=("$@")
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
suite=trixie stages="first python server ranks tests" folder="" shared="" ccache="" mirror=""
jobs=$(getconf _NPROCESSORS_ONLN)
if [[ ${1:-} == [!-]* ]]; then suite=$1; shift; fi
read_options stages folder shared ccache jobs mirror -- "$@"
[[ $suite == bookworm || $suite == trixie ]] || refuse "'$suite' is no system it knows; it may be bookworm or trixie"
for name in $stages; do
    [[ " first python server ranks tests " == *" $name "* ]] || refuse "--stages has '$name'; it may have first, python, server, ranks and tests"
done
require_number jobs "$jobs"
for name in shared ccache; do
    [[ -z ${!name} || -d ${!name} ]] || refuse "--$name is '${!name}'; there is no such folder"
done
((EUID == 0)) || refuse "only root may make a system in a folder and run programs in it; run it as root, or in a container"
command -v debootstrap >/dev/null || refuse "debootstrap is missing (apt install debootstrap)"
# What is mounted into the system is seen by this script and what it starts alone, and is gone at its end.
if [[ -z ${PENDULAR_OWN_MOUNTS:-} ]]; then
    unshare --mount true 2>/dev/null || refuse "nothing may be mounted here; in a container, give it the capability SYS_ADMIN"
    PENDULAR_OWN_MOUNTS=1 exec unshare --mount --propagation private "$0" "${given[@]}"
fi
source "$(dirname "${BASH_SOURCE[0]}")/time-stages.sh"
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
root=$(realpath -m "${folder:-$repository/build/roots/$suite}")
clone=/root/pendular  # in the system; the tests find the reference data beside it

environment=(PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 MPLBACKEND=Agg
    DEBIAN_FRONTEND=noninteractive CMAKE_BUILD_PARALLEL_LEVEL="$jobs" CTEST_PARALLEL_LEVEL="$jobs"
    PENDULAR_WARNINGS_AS_ERRORS=ON OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
for name in http_proxy https_proxy ftp_proxy no_proxy HTTP_PROXY HTTPS_PROXY FTP_PROXY NO_PROXY; do
    if [[ -n ${!name:-} ]]; then environment+=("$name=${!name}"); fi
done
inside() { chroot "$root" env -i "${environment[@]}" "$@"; }
# A stage of several commands, from its standard input: the first that fails ends it.
commands() { inside bash -euo pipefail -c "cd $clone; $(cat)"; }

make_system() {
    if [[ ! -e $root ]]; then
        if [[ -z $mirror ]] && command -v apt-get >/dev/null; then
            mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' 'Label: Debian' 2>/dev/null | head -n 1)
        fi
        rm -rf --one-file-system "$root.part"
        mkdir -p "$root.part"
        debootstrap --variant=minbase --include=ca-certificates "$suite" "$root.part" ${mirror:+"$mirror"}
        mv "$root.part" "$root"
    fi
    grep -qs "^VERSION_CODENAME=$suite$" "$root/etc/os-release" || refuse "$root is there, and is no $suite; remove it, or name another folder"
    cp /etc/resolv.conf /etc/hosts "$root/etc"
    if command -v apt-config >/dev/null; then
        apt-config dump Acquire | grep -v IndexTargets >"$root/etc/apt/apt.conf.d/90host" || true
    fi
    if compgen -G "/usr/local/share/ca-certificates/*.crt" >/dev/null; then
        cp /usr/local/share/ca-certificates/*.crt "$root/usr/local/share/ca-certificates"
        inside update-ca-certificates >/dev/null
    fi
}
mount_what_it_needs() {
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    inside dpkg --configure -a  # what a run before has left half installed
    if [[ -n $shared ]]; then
        mkdir -p "$root/root/shared"
        mount --bind -o ro "$shared" "$root/root/shared"
        environment+=(PENDULAR_REQUIRE_SHARED=1)
    fi
    if [[ -n $ccache ]]; then
        mkdir -p "$root/root/.cache/ccache"
        mount --bind "$ccache" "$root/root/.cache/ccache"
        environment+=(CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_DIR=/root/.cache/ccache CCACHE_COMPILERCHECK=content
            CCACHE_BASEDIR="$clone" CCACHE_NOHASHDIR=true CCACHE_SLOPPINESS=pch_defines,time_macros)
        [[ -e $root/usr/bin/ccache ]] || inside sh -c "apt-get update -qq && apt-get install -y -qq --no-install-recommends ccache"
    fi
}
# Files that have not changed keep their times, so that they are not compiled again.
copy_tree() {
    local commit
    commit=$(git -C "$repository" rev-parse HEAD)
    if [[ ! -e $root$clone ]]; then git clone --quiet --no-checkout "$repository" "$root$clone"; fi
    git -C "$root$clone" fetch --quiet "$repository" "$commit"
    git -C "$root$clone" checkout --quiet --force --detach "$commit"
    rm -f "$root$clone/build/release/CMakeCache.txt"  # with the options of a run before
    git -C "$repository" log --oneline -n 1
}
# The first block of a language of a section of README.
block_of() {  # heading, language
    awk -v heading="## $1" -v begin="\`\`\`$2" '$0 == heading { there = 1 } there && on && /^```$/ { exit }
        there && on { print } there && $0 == begin { on = 1 }' "$repository/README.md"
}

[[ -n $(block_of "A first simulation" bash) && -n $(block_of "Or in Python" bash) && -n $(block_of "Or in Python" python) ]] ||
    refuse "README.md has no commands under 'A first simulation' or 'Or in Python'"

first() { block_of "A first simulation" bash | commands; }
python() {
    commands <<END
Tools/install-dependencies.sh --python
cmake --preset release
$(block_of "Or in Python" bash)
python3 - <<'PROGRAM'
$(block_of "Or in Python" python)
PROGRAM
END
}
server() {
    commands <<'END'
Tools/install-dependencies.sh --view
cmake --preset release -D PENDULAR_VIEW=ON
cmake --build --preset release --target view WetTower
export PENDULAR_VIEW=$PWD/build/release/Tools/view PENDULAR_DRIVERS=$PWD/build/release/Drivers
mkdir -p build/runs
build/release/Drivers/WetTower/WetTower --output build/runs/WetTower
PYTHONPATH=SelfTests/View python3 - <<'PROGRAM'
import pathlib
from conftest import Server
server = Server(pathlib.Path("build/runs"))
run = server.get("run", id="WetTower/run")
assert run["state"] == "ended" and run["grains"] == 10, run
assert "WetTower" in [driver["driver"] for driver in server.get("drivers")]
server.end()
print("view: the run has", run["state"], "with", run["grains"], "grains")
PROGRAM
END
}
ranks() {
    commands <<'END'
Tools/install-dependencies.sh --mpi
cmake --preset release -D PENDULAR_MPI=ON
cmake --build --preset release --target WetTower
for count in 1 2; do
    mpirun --oversubscribe -n $count build/release/Drivers/WetTower/WetTower --output build/ranks-$count
done
cmp build/ranks-1/run-restart.h5 build/ranks-2/run-restart.h5
END
}
tests() {
    environment+=(PENDULAR_REQUIRE_DEPENDENCIES=1)
    commands <<'END'
Tools/install-dependencies.sh --readers --python --mpi --view
cmake --preset release -D PENDULAR_BUILD_TESTS=ON -D PENDULAR_QUICK_TEST_BUILD=ON
cmake --build --preset release
ctest --preset release
END
}

stage "A bare $suite in $root" make_system
stage "Mounting what it needs" mount_what_it_needs
stage "Copying the committed state" copy_tree
for name in $stages; do stage "$suite: $name" "$name"; done
