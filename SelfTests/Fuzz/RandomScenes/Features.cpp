#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Foundation/Base/InputError.h"
#include "SelfTests/Fuzz/RandomScenes/Feature.h"
#include "SelfTests/Fuzz/RandomScenes/Recipe.h"

namespace pendular::fuzz {

bool Feature::is(std::string_view word) const {
    return name == word || std::ranges::find(kinds, word) != kinds.end();
}

const std::vector<Feature>& allFeatures() {
    static const std::vector<Feature> all = [] {
        std::vector<Feature> table;
        for (const auto part : {materialFeatures, methodFeatures, spaceFeatures, bodyFeatures, wallFeatures,
                                meshFeatures, drivenWallFeatures, liquidFeatures, flowFeatures,
                                changeOfGrainFeatures, changeOfSceneFeatures, outputFeatures})
            for (Feature& feature : part()) table.push_back(std::move(feature));
        return table;
    }();
    return all;
}

const Feature& featureNamed(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Feature& feature : allFeatures()) {
        if (feature.name == name) return feature;
        names.push_back(feature.name);
    }
    throw InputError(fmt::format("There is no feature '{}' of random scenes; there are {}.", name,
                                 fmt::join(names, ", ")));
}

bool exclude(const Feature& a, const Feature& b) {
    const auto names = [](const Feature& one, const Feature& other) {
        return std::ranges::any_of(one.excludes, [&](std::string_view word) { return other.is(word); });
    };
    return &a != &b && (names(a, b) || names(b, a));
}

}  // namespace pendular::fuzz
