#!/usr/bin/env bash
# Makes the mechanical changes of a driver of MercuryDPM: X, Y and Z of vectors, XX of tensors, products and lengths,
# pointers to grains. What is left, the compiler names; Kernel/HOW-DO-I.md has the words ("Port a driver from MercuryDPM").
#   Tools/port-from-mercury.sh [--driver FILE.cpp] > ported.cpp
#   Tools/port-from-mercury.sh [--classify FOLDER] [--build build/release] > programs.tsv
# --driver FILE       prints the driver with these changes
# --classify FOLDER   ports all .cpp files with a main() below the folder and the headers beside them, compiles each
#                     (syntax only), and prints a table: class (unchanged; few: below 10 lines; more; no: from 60 on;
#                     unknown: headers are missing), the lines that do not compile after the mechanical changes, the
#                     program, the missing headers and the first errors. A missing header is replaced by an empty one,
#                     so that the errors behind it are counted; what it declares is an error wherever it is used.
#                     The programs are not run: that a program compiles does not show that it runs here.
# --build FOLDER      a configured build, for the headers that it writes and its compiler ($CXX takes precedence)
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
driver="" classify="" build="$(dirname "$tools")/build/release"
source "$tools/read-options.sh"
read_options driver classify build -- "$@"
require_file driver "$driver"

# A line that begins with a comment stays as it is.
port() {
    local operand='([^(),]+(\([^()]*\)[^(),]*)*)'
    sed -E \
        -e '/^[[:space:]]*(\/\/|\*)/b' \
        -e 's/([]A-Za-z0-9_)])\.(X|Y|Z)\b/\1.\l\2()/g' \
        -e 's/([]A-Za-z0-9_)])\.([XYZ])([XYZ])\b/\1(\x01\2, \x01\3)/g; s/\x01X/0/g; s/\x01Y/1/g; s/\x01Z/2/g' \
        -e "s/Vec3D::dot[[:space:]]*\\($operand,[[:space:]]*$operand\\)/(\\1).dot(\\3)/g" \
        -e "s/Vec3D::cross[[:space:]]*\\($operand,[[:space:]]*$operand\\)/(\\1).cross(\\3)/g" \
        -e "s/Vec3D::getDistance[[:space:]]*\\($operand,[[:space:]]*$operand\\)/((\\1) - (\\3)).norm()/g" \
        -e "s/Vec3D::getDistanceSquared[[:space:]]*\\($operand,[[:space:]]*$operand\\)/((\\1) - (\\3)).squaredNorm()/g" \
        -e "s/Vec3D::getLength[[:space:]]*\\($operand\\)/(\\1).norm()/g" \
        -e "s/Vec3D::getLengthSquared[[:space:]]*\\($operand\\)/(\\1).squaredNorm()/g" \
        -e "s/Vec3D::getUnitVector[[:space:]]*\\($operand\\)/(\\1).normalized()/g" \
        -e 's/([]A-Za-z0-9_)])\.get(X|Y|Z)[[:space:]]*\(\)/\1.\l\2()/g' \
        -e 's/([]A-Za-z0-9_)])\.set(X|Y|Z)[[:space:]]*\(([^()]+(\([^()]*\))?)\)[[:space:]]*;/\1.\l\2() = \3;/g' \
        -e 's/([]A-Za-z0-9_)])\.getComponent[[:space:]]*\(([^()]+)\)/\1[\2]/g' \
        -e 's/\.normalise[[:space:]]*\(\)/.normalize()/g' \
        -e 's/([A-Za-z_.]*)speciesHandler\.addObject\(([A-Za-z_0-9]+)\)/\2 = \1speciesHandler.copyAndAddObject(*\2)/g' \
        -e 's/dynamic_cast<[^()]*\*>\((([A-Za-z_0-9]+(->|\.))*interactionHandler\.getInteraction\((.*)\))\)/\1/' \
        -e 's/((\(\*[A-Za-z_0-9]+\)|[A-Za-z_0-9]+)((->|\.)[A-Za-z_0-9]+(\([^()]*\))?)*)\.isEqualTo\(/mathsFunc::isEqual(\1, /g' \
        -e 's/\baddVelocity\(/accelerate(/g' \
        -e 's/std::vector<BaseParticle[[:space:]]*\*>::(const_)?iterator/auto/g' \
        -e 's/std::vector<BaseParticle[[:space:]]*\*>/std::vector<SphericalParticle*>/g' \
        -e 's/\bnew BaseParticle\b/new SphericalParticle/g' \
        -e 's/(\bcomputeExternalForces)[[:space:]]*\([[:space:]]*BaseParticle[[:space:]]*\*[[:space:]]*/\1(MercuryForcedGrain /g' \
        -e 's/\.getLengthSquared[[:space:]]*\(\)/.squaredNorm()/g' \
        -e 's/\.getLength[[:space:]]*\(\)/.norm()/g' \
        -e 's/\b(const )?(BaseParticle|BaseInteraction|BaseWall|BaseBoundary)[[:space:]]*\*[[:space:]]*/auto /g' \
        -e 's/\bBaseParticle ([A-Za-z_])/SphericalParticle \1/g' \
        "$1"
}

# The class of a program by the lines that do not compile.
class_of() { if (($1 == 0)); then echo unchanged; elif (($1 < 10)); then echo few; elif (($1 < 60)); then echo more; else echo no; fi; }

# check -E, check -fsyntax-only: the compiler's messages on the ported program, in $work/faults.
check() { "$compiler" "${flags[@]}" "$1" "$work/ported.cpp" >/dev/null 2>"$work/faults" || true; }
# The header at which the compiler has stopped, by g++'s or clang's message.
header_not_found() {
    sed -nE "s/^.*fatal error: '?([^' :]+)'?(: No such file or directory| file not found).*/\\1/p" "$work/faults" | head -1
}

# Provides the headers of the program in $1 that the library does not have: those beside it are ported, too; the others
# are empty, and named in the array missing. They are in a deep folder, for paths that begin with "../".
provide_headers() {
    local header place
    rm -rf "$work/headers" && mkdir -p "$own" && missing=()
    while check -E; header=$(header_not_found); [[ -n $header && ! -e $own/$header ]]; do
        # Folder by folder, as ".." is looked up only behind a folder that is there.
        place=$own/$header
        mkdir -p "$(dirname "$place")" 2>/dev/null || break
        if [[ -f $(dirname "$1")/$header ]]; then port "$(dirname "$1")/$header" >"$place"; else : >"$place" && missing+=("$header"); fi
    done
    [[ -z $header ]] || missing+=("$header")
}

# A row of the table. A line counts once: with a fault of its own, or with one in a header that it leads to. Lines of
# headers beside the program count with it.
row() {
    port "$1" >"$work/ported.cpp"
    provide_headers "$1"
    check -fsyntax-only
    local lines first kind
    lines=$({ grep -E "^$work/[^:]+:[0-9]+:[0-9]+: +((fatal )?error|required from here)" "$work/faults" || true; } |
                cut -d: -f1,2 | sort -u | wc -l)
    first=$({ grep -m 3 -oE 'error: .*' "$work/faults" || true; } | sed 's/^error: //' | tr '\n\t' '; ')
    kind=$(class_of "$lines")
    if ((${#missing[@]} > 0)); then
        kind=unknown
        printf -v first '%s, ' "${missing[@]}"
        first="not known: headers ${first%, } are missing; $lines lines fail with empty ones in their place"
    fi
    printf '%s\t%s\t%s\t%s\n' "$kind" "$lines" "$(basename "$1" .cpp)" "$first"
}

if [[ -n $driver ]]; then
    port "$driver"
elif [[ -n $classify ]]; then
    [[ -d $classify ]] || refuse "--classify is '$classify'; there is no such folder"
    headers=$build/Generated
    [[ -d $headers/MercuryHeaders ]] || refuse "there is no folder $headers/MercuryHeaders; configure a build first, or give its folder with --build"
    compiler=${CXX:-$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")}
    work=$(mktemp -d)
    own=$work/headers/1/2/3/4/5/6
    # No limit of errors is -fmax-errors=0 for g++, -ferror-limit=0 for clang.
    limit=-fmax-errors=0
    if "$compiler" --version | grep -q clang; then limit=-ferror-limit=0; fi
    flags=(-std=c++20 "$limit" -w -I "$(dirname "$tools")" -I "$headers" -I "$headers/MercuryHeaders" -I "$own"
           -isystem /usr/include/eigen3)
    trap 'rm -rf "$work"' EXIT
    printf 'class\tlines_to_change\tprogram\tmissing\n'
    while read -r program; do row "$program"; done < <(grep -rlE --include='*.cpp' '^[[:space:]]*int main' "$classify" | sort)
else
    refuse "there is nothing to do; give --driver or --classify, see --help"
fi
