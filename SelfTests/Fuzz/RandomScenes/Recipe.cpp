#include "SelfTests/Fuzz/RandomScenes/Recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <numeric>

#include "Kernel/Foundation/Base/InputError.h"
#include "SelfTests/Fuzz/RandomScenes/Draws.h"
#include "SelfTests/Fuzz/RandomScenes/Feature.h"

namespace pendular::fuzz {

namespace {

std::vector<std::string_view> partsOf(std::string_view text, char between) {
    std::vector<std::string_view> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(between), text.size());
        if (end > 0) parts.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

template <class Number>
Number numberFrom(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size())
        throw InputError(fmt::format("Recipe: '{}' is no number.", text));
    return number;
}

/// "Planes#3:nan"
WrongValue wrongFrom(std::string_view text) {
    const std::size_t hash = text.find('#'), colon = text.find(':');
    if (hash == text.npos || colon == text.npos || colon < hash)
        throw InputError(fmt::format("Recipe: wrong value '{}'; it must be FEATURE#NUMBER:VALUE.", text));
    return {std::string(text.substr(0, hash)), numberFrom<int>(text.substr(hash + 1, colon - hash - 1)),
            numberFrom<double>(text.substr(colon + 1))};
}

/// The features of one seed.
class Choice {
public:
    explicit Choice(Recipe& of) : recipe(of), draw(of, "recipe"), careless(draw.oneIn(15)) {
        const int types = draw.chance(0.6) ? 1 : draw.whole(2, 3);
        for (const Feature* feature : shuffled())
            if (feature->is("material") && static_cast<int>(recipe.features.size()) < types) take(*feature);
        for (const Feature* feature : shuffled())
            if (!feature->is("material") && draw.chance(feature->share) && goesWithAll(*feature))
                take(*feature);
        if (draw.oneIn(4)) takeWrongValues();
        leaveOutKnownFaults();
        sortAsTable();
    }

private:
    std::vector<const Feature*> shuffled() {
        std::vector<const Feature*> order;
        for (const Feature& feature : allFeatures())
            if (feature.share != byName) order.push_back(&feature);
        for (std::size_t k = order.size(); k > 1; --k)
            std::swap(order[k - 1], order[static_cast<std::size_t>(draw.whole(0, static_cast<int>(k) - 1))]);
        return order;
    }
    void take(const Feature& feature) { recipe.features.push_back(feature.name); }
    [[nodiscard]] bool hasAny(const std::vector<std::string_view>& words) const {
        return std::ranges::any_of(recipe.features, [&](const std::string& name) {
            return std::ranges::any_of(words, [&](std::string_view w) { return featureNamed(name).is(w); });
        });
    }
    /// One of fifteen recipes does not ask: what Pendular refuses must be refused with a sentence.
    [[nodiscard]] bool goesWithAll(const Feature& feature) const {
        if (careless) return true;
        if (!feature.needs.empty() && !hasAny(feature.needs)) return false;
        return std::ranges::none_of(
            recipe.features, [&](const std::string& name) { return exclude(feature, featureNamed(name)); });
    }
    void takeWrongValues() {
        constexpr double inf = std::numeric_limits<double>::infinity(),
                         nan = std::numeric_limits<double>::quiet_NaN();
        constexpr std::array values{nan,  inf,  -inf,  -1.0,   0.0,    1e9,
                                    -1e9, 1e-9, 1e300, -1e300, 1e-300, 5e-324};
        std::vector<std::string> owners = recipe.features;
        owners.push_back("Scene");
        for (int k = draw.whole(1, 3); k > 0; --k) {
            const std::string owner = draw.oneOf(owners);
            const int number = draw.oneIn(3) ? draw.whole(0, 20) : draw.whole(0, 4);
            recipe.wrong.push_back({owner, number, draw.oneOf(values)});
        }
    }
    void leaveOutKnownFaults() {
        while (const KnownFault* const fault = knownFaultOf(recipe)) {
            if (const std::string_view last = fault->together.back(); last.starts_with("wrong ")) {
                std::erase_if(recipe.wrong, [&](const WrongValue& value) {
                    return last == "wrong huge" ? isHuge(value) : last.substr(6) == value.feature;
                });
                continue;
            }
            const auto meant = [&](const std::string& name) {
                return featureNamed(name).is(fault->together.back());
            };
            std::erase_if(recipe.features, meant);
        }
    }
    void sortAsTable() {
        std::vector<std::string> sorted;
        for (const Feature& feature : allFeatures())
            if (recipe.has(feature.name)) sorted.push_back(feature.name);
        recipe.features = std::move(sorted);
    }

    Recipe& recipe;
    Draws draw;
    bool careless;
};

}  // namespace

bool Recipe::has(std::string_view feature) const {
    return std::ranges::find(features, feature) != features.end();
}

std::string Recipe::text() const {
    std::string line = fmt::format("seed={} features={}", seed, fmt::join(features, ","));
    for (std::size_t k = 0; k < wrong.size(); ++k)
        line += fmt::format("{}{}#{}:{}", k == 0 ? " wrong=" : ",", wrong[k].feature, wrong[k].number,
                            wrong[k].value);
    if (steps < Recipe{}.steps) line += fmt::format(" steps={}", steps);
    if (grains < Recipe{}.grains) line += fmt::format(" grains={}", grains);
    return line;
}

Recipe recipeFrom(std::string_view text) {
    Recipe recipe;
    for (const std::string_view part : partsOf(text, ' ')) {
        const std::size_t equals = std::min(part.find('='), part.size());
        const std::string_view name = part.substr(0, equals);
        const std::string_view value = part.substr(std::min(equals + 1, part.size()));
        if (name == "seed") recipe.seed = numberFrom<std::uint64_t>(value);
        else if (name == "steps") recipe.steps = numberFrom<int>(value);
        else if (name == "grains") recipe.grains = numberFrom<int>(value);
        else if (name == "wrong")
            for (const std::string_view one : partsOf(value, ',')) recipe.wrong.push_back(wrongFrom(one));
        else if (name == "features")
            for (const std::string_view one : partsOf(value, ','))
                recipe.features.push_back(featureNamed(one).name);
        else throw InputError(fmt::format("Recipe: there is no '{}' in one.", name));
    }
    return recipe;
}

Recipe recipeOf(std::uint64_t seed) {
    Recipe recipe;
    recipe.seed = seed;
    const Choice choice(recipe);
    return recipe;
}

}  // namespace pendular::fuzz
