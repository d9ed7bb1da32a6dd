#!/usr/bin/env bash
# Makes the mechanical changes of a driver of MercuryDPM: X, Y and Z of vectors, XX of tensors, products and lengths,
# pointers to grains. What is left, the compiler names; Kernel/HOW-DO-I.md has the words ("Port a driver from MercuryDPM").
#   Tools/port-from-mercury.sh [--driver FILE.cpp] > ported.cpp
#   Tools/port-from-mercury.sh [--classify FOLDER] [--build build/release] > programs.tsv
# --driver FILE       prints the driver with these changes
# --classify FOLDER   ports all .cpp files with a main() below the folder, has the compiler check each, and prints a
#                     table: class (unchanged; few: below 10 lines; more; no: from 60 on), the lines that do not
#                     compile after the mechanical changes, the program, the first faults. The programs are not run.
# --build FOLDER      a configured build, for the headers that it writes
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

# A row of the table. A line counts once: with a fault of its own, or with one in a header that it leads to.
row() {
    port "$1" >"$work/ported.cpp"
    "${CXX:-g++}" "${flags[@]}" "$work/ported.cpp" 2>"$work/faults" || true
    local lines first
    lines=$({ grep -E "^$work/ported.cpp:[0-9]+:[0-9]+: +((fatal )?error|required from here)" "$work/faults" || true; } |
                cut -d: -f2 | sort -un | wc -l)
    first=$({ grep -m 3 -oE 'error: .*' "$work/faults" || true; } | sed 's/^error: //' | tr '\n\t' '; ')
    printf '%s\t%s\t%s\t%s\n' "$(class_of "$lines")" "$lines" "$(basename "$1" .cpp)" "$first"
}

if [[ -n $driver ]]; then
    port "$driver"
elif [[ -n $classify ]]; then
    [[ -d $classify ]] || refuse "--classify is '$classify'; there is no such folder"
    headers=$build/Generated
    [[ -d $headers/MercuryHeaders ]] || refuse "there is no folder $headers/MercuryHeaders; configure a build first, or give its folder with --build"
    flags=(-std=c++20 -fsyntax-only -fmax-errors=0 -w -I "$(dirname "$tools")" -I "$headers" -I "$headers/MercuryHeaders"
           -isystem /usr/include/eigen3)
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    printf 'class\tlines_to_change\tprogram\tmissing\n'
    while read -r program; do row "$program"; done < <(grep -rlE --include='*.cpp' '^[[:space:]]*int main' "$classify" | sort)
else
    refuse "there is nothing to do; give --driver or --classify, see --help"
fi
