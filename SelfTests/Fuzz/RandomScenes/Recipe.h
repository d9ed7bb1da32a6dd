#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pendular::fuzz {

/// A number that a feature gives to Pendular, and that is wrong.
struct WrongValue {
    std::string feature;
    int number = 0;  // of those that the feature gives, from 0
    double value = 0;

    friend bool operator==(const WrongValue&, const WrongValue&) = default;
};

/// A random scene in one line of text: all that is random follows from the seed, and from the name of the
/// feature that draws it. So a feature is the same in a recipe that lacks another one.
struct Recipe {
    std::uint64_t seed = 0;
    // At most, of what the seed would have.
    int steps = 1000, grains = 1000;
    std::vector<std::string> features;
    std::vector<WrongValue> wrong;

    [[nodiscard]] bool has(std::string_view feature) const;
    /// "seed=17 features=Grains,Planes wrong=Planes#3:nan steps=40 grains=2"
    [[nodiscard]] std::string text() const;

    friend bool operator==(const Recipe&, const Recipe&) = default;
};

/// Throws InputError for a text that is none, and for a feature that there is not.
Recipe recipeFrom(std::string_view text);
/// That of a seed: features that go together and, in one of four, values that are wrong.
Recipe recipeOf(std::uint64_t seed);

}  // namespace pendular::fuzz
