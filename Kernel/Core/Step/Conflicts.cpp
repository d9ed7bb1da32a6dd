#include "Kernel/Core/Step/Conflicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

constexpr std::string_view imagesPassWalls = "images of the grains move past walls, which stay",
                           leaveWallsOut =
                               "leave the walls out, or leave the images at rest and move walls instead "
                               "(setMotion(), setPiston())",
                           singleGrains = "its bound of the step counts with grains that move by themselves",
                           leaveAdaptiveOut = "leave setAdaptiveTimeStep() out",
                           stepsOfOneLength = "they need steps of one length";

constexpr auto tableOfConflicts = [] {
    using enum Feature;
    return std::array{
        Conflict{Shear, Walls, imagesPassWalls, leaveWallsOut},
        Conflict{Strain, WallsInStrain, imagesPassWalls,
                 "take planes across an axis that is not periodic, or leave the images at rest and move "
                 "walls instead "
                 "(setMotion(), setPiston())"},
        Conflict{Shear, HeldGrains, "a grain that is held would not go with the flow as its images do",
                 "let it go by setHeldAxes({})"},
        Conflict{Strain, HeldGrains, "a grain that is held would not go with the flow as its images do",
                 "let it go by setHeldAxes({})"},
        Conflict{Shear, GravityAlongGradient, "grains would fall through images that move",
                 "let gravity act along another axis, or set it to zero"},
        Conflict{Strain, Gravity, "a scene that falls has no state that is strained homogeneously",
                 "set gravity to zero"},
        Conflict{AdaptiveStep, DrivenWalls, singleGrains, leaveAdaptiveOut},
        Conflict{AdaptiveStep, Membranes, singleGrains, leaveAdaptiveOut},
        Conflict{AdaptiveStep, ViscousBridges, stepsOfOneLength, leaveAdaptiveOut},
        Conflict{AdaptiveStep, EarlierAccelerations, stepsOfOneLength,
                 "leave setAdaptiveTimeStep() out, or take integrators::predictedVelocityVerlet or "
                 "velocityVerlet"},
    };
}();

constexpr std::array tableOfRanks{Conflict{Feature::Ranks, Feature::OwnPart,
                                           "ranks can share only parts that say so (actsOnRanks())",
                                           "run the scene on one rank"}};

bool isOf(const Conflict& conflict, Feature a, Feature b) {
    return (conflict.a == a && conflict.b == b) || (conflict.a == b && conflict.b == a);
}

bool isIn(const Conflict& conflict, const Features& scene) {
    return scene.has(conflict.a) && scene.has(conflict.b);
}

}  // namespace

std::span<const Conflict> conflicts() { return tableOfConflicts; }
std::span<const Conflict> conflictsOfRanks() { return tableOfRanks; }

std::string sentence(const Conflict& conflict, const Features& scene) {
    return fmt::format("Simulation: {} and {} cannot be combined: {}; {}.", scene.shown(conflict.a),
                       scene.shown(conflict.b), conflict.why, conflict.advice);
}

void refuseConflicts(const Features& scene, std::span<const Conflict> table) {
    for (const Conflict& conflict : table)
        if (isIn(conflict, scene)) throw InputError(sentence(conflict, scene));
}

void refuseConflictsOf(const Features& some, const Features& scene) {
    for (const Conflict& conflict : conflicts())
        if ((some.has(conflict.a) || some.has(conflict.b)) && isIn(conflict, scene))
            throw InputError(sentence(conflict, scene));
}

std::string conflictMatrix() {
    std::vector<Feature> shown;  // those with a conflict
    for (std::size_t k = 0; k < static_cast<std::size_t>(Feature::Count); ++k)
        if (const auto feature = static_cast<Feature>(k); std::ranges::any_of(
                tableOfConflicts, [&](const Conflict& c) { return c.a == feature || c.b == feature; }))
            shown.push_back(feature);
    std::string text = "| |";
    for (std::size_t k = 0; k < shown.size(); ++k) text += fmt::format(" {} |", k + 1);
    text += "\n|---|";
    for (std::size_t k = 0; k < shown.size(); ++k) text += "---|";
    text += '\n';
    for (std::size_t row = 0; row < shown.size(); ++row) {
        text += fmt::format("| {} {} |", row + 1, nameOf(shown[row]));
        for (const Feature column : shown) {
            const bool no = std::ranges::any_of(
                tableOfConflicts, [&](const Conflict& c) { return isOf(c, shown[row], column); });
            text += no ? " no |" : " |";
        }
        text += '\n';
    }
    text += "\nWhy, and what to do instead:\n\n";
    for (const Conflict& c : tableOfConflicts)
        text += fmt::format("- {} and {}: {}; {}.\n", nameOf(c.a), nameOf(c.b), c.why, c.advice);
    text += fmt::format("\nWhat {} cannot share yet:\n\n", nameOf(Feature::Ranks));
    for (const Conflict& c : tableOfRanks) text += fmt::format("- {}\n", nameOf(c.b));
    return text;
}

}  // namespace pendular
