#include <algorithm>
#include <cmath>

#include "SelfTests/Fuzz/RandomScenes/Draws.h"
#include "SelfTests/Fuzz/RandomScenes/Feature.h"
#include "SelfTests/Fuzz/RandomScenes/Recipe.h"

namespace pendular::fuzz {

bool isHuge(const WrongValue& wrong) { return std::isfinite(wrong.value) && std::abs(wrong.value) >= 1e9; }

const std::vector<KnownFault>& knownFaults() {
    static const std::vector<KnownFault> faults{
        {{"no grains", "moving images"},
         "a sheared or strained scene of no grains ends with 'the smallest radius, inf m'"},
        {{"moving images", "held"}, "held grains creep in shear and strain"},
        // A state is changed between two halves of a step, and what is booked is not.
        {{"ledger", "LiquidDensity"}, "the ledger lacks what films weigh that bridges take or give"},
        {{"ledger", "Radius"}, "the ledger lacks half a step's work of forces on a grain of another mass"},
        {{"ledger", "Hold"}, "the same, of a grain that is held or let go"},
        {{"ledger", "outlet"}, "the same, of the neighbours of a grain that leaves by an outlet"},
        {{"WallForces", "WallThatComes"},
         "the table has no row of a wall that comes until the next output, and after a restart it has one"},
        {{"periodic", "parts"}, "walls of several parts lose contacts at the faces of a period"},
        {{"comes in the run", "Evaporation"},
         "bridges are prepared anew when grains come, and not by a restart"},
        {{"wrong Clumps"}, "spheres that lie far apart: an adaptive integral without end"},
        {{"wrong huge"}, "places and sizes beyond what a scene can resolve: 'overlap = inf m'"},
    };
    return faults;
}

const KnownFault* knownFaultOf(const Recipe& recipe) {
    const auto isThere = [&](std::string_view word) {
        if (word == "no grains") return Draws(recipe, "Grains").whole(0, 40) == 0 || !recipe.has("Grains");
        if (word == "wrong huge") return std::ranges::any_of(recipe.wrong, isHuge);
        if (word.starts_with("wrong "))
            return std::ranges::any_of(
                recipe.wrong, [&](const WrongValue& value) { return word.substr(6) == value.feature; });
        return std::ranges::any_of(recipe.features,
                                   [&](const std::string& name) { return featureNamed(name).is(word); });
    };
    for (const KnownFault& fault : knownFaults())
        if (std::ranges::all_of(fault.together, isThere)) return &fault;
    return nullptr;
}

}  // namespace pendular::fuzz
