#include <algorithm>
#include <cmath>

#include "SelfTests/Fuzz/RandomScenes/Draws.h"
#include "SelfTests/Fuzz/RandomScenes/Feature.h"
#include "SelfTests/Fuzz/RandomScenes/Recipe.h"

namespace pendular::fuzz {

bool isHuge(const WrongValue& wrong) { return std::isfinite(wrong.value) && std::abs(wrong.value) >= 1e9; }

const std::vector<KnownFault>& knownFaults() {
    static const std::vector<KnownFault> faults{};
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
