#!/usr/bin/env bash
# Prints for each scene of few grains what a step takes, part by part, as rows of CSV: scene, energies, part, ns. The time
# of a step is that of little-scenes; the parts have the shares of it that perf sees in their functions.
#   Tools/Studies/LittleScenes/profile-steps.sh [--build build/release] [--energies none]
# Needs perf; without its counters, those of the processor's time are taken.
set -euo pipefail
tools=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build="$(dirname "$tools")/build/release" energies=none
source "$tools/read-options.sh"
read_options build energies -- "$@"
program=$build/Tools/Studies/little-scenes
require_program "$program"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The part of a step that a function belongs to, by its name: the first that fits.
parts() {
    awk -F'\t' '
        function part(name) {
            if (name ~ /Kernel<|computeBlocks|computeBucket|SpeciesLaws.*::compute|SeveralSpeciesLaws::compute/) return "contact laws"
            if (name ~ /[Ww]all|planeIn|planeAt|Pose|Plane/) return "walls"
            if (name ~ /ExactSum|ExactRows|Account|addContact|addSlider|relativeMotion|MovingBody|sumOf.*Energy|Wear/) return "energies"
            if (name ~ /TimeIntegration|Loops|GrainPart/) return "motion"
            if (name ~ /malloc|free|operator new|operator delete|std::vector|memset|memmove/) return "memory"
            if (name ~ /ContactSystem|ForceTotals|ContactEvents|ContactLiquid|ContactStore/) return "contacts besides laws and walls"
            if (name ~ /Scene::|Run::|StepPart|StepList|StepTimes|hasChanges|contactScheme|StepContext/) return "course of the step"
            return "other"
        }
        { share[part($2)] += $1 }
        END { for (name in share) printf "%s\t%s\n", share[name], name }' "$1" | sort -rn
}

echo "scene,energies,part,ns_per_step"
for scene in two two-on-plane ten-on-plane hundred-on-plane; do
    step=$("$program" --scene "$scene" --energies "$energies" | tail -1 | cut -d, -f6)
    perf record -q -F 5000 -e cpu-clock -o "$work/perf" -- "$program" --scene "$scene" --energies "$energies" --share 4 >/dev/null 2>&1
    perf report -i "$work/perf" --no-children --sort sym --field-separator $'\t' 2>/dev/null |
        sed -n 's/^ *\([0-9.]*\)% *\t\[[.k]\] /\1\t/p' >"$work/shares"
    parts "$work/shares" | while IFS=$'\t' read -r share part; do
        echo "$scene,$energies,$part,$(awk -v s="$share" -v t="$step" 'BEGIN { printf "%.1f", s * t / 100 }')"
    done
done
