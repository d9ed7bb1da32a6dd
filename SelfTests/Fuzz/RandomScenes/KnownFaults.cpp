#include <algorithm>

#include "SelfTests/Fuzz/RandomScenes/Draws.h"
#include "SelfTests/Fuzz/RandomScenes/Feature.h"
#include "SelfTests/Fuzz/RandomScenes/Recipe.h"

namespace pendular::fuzz {

const std::vector<KnownFault>& knownFaults() {
    static const std::vector<KnownFault> faults{
        {{"no grains", "moving images"},
         "a sheared or strained scene of no grains ends with 'the smallest radius, inf m'"},
        {{"held", "moving images"}, "held grains creep in shear and strain"},
        {{"ledger", "LiquidDensity"}, "the ledger lacks what films that change weigh"},
    };
    return faults;
}

const KnownFault* knownFaultOf(const Recipe& recipe) {
    const auto isThere = [&](std::string_view word) {
        if (word == "no grains") return Draws(recipe, "Grains").whole(0, 40) == 0 || !recipe.has("Grains");
        if (word == "wrong") return !recipe.wrong.empty();
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
