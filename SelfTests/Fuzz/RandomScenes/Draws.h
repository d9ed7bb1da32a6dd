#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "SelfTests/Fuzz/RandomScenes/Recipe.h"
#include "SelfTests/Support/Random.h"

namespace pendular::fuzz {

/// FNV-1a of the name, stirred with the seed: a stream of random numbers of its own for each name.
inline std::uint64_t streamOf(std::uint64_t seed, std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325u ^ (seed + 1) * 0x9E3779B97F4A7C15u;
    for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
    return hash;
}

/// The random numbers of one feature. What is handed to Pendular goes through give(), where the recipe may
/// have another value, and which keeps a record.
class Draws {
public:
    Draws(const Recipe& recipe, std::string_view name) : random(streamOf(recipe.seed, name)), feature(name) {
        for (const WrongValue& value : recipe.wrong)
            if (value.feature == feature) wrong.push_back(value);
    }

    double even(double low, double high) { return random.uniform(low, high); }
    /// Every decade alike.
    double decades(double low, double high) { return random.logarithmic(low, high); }
    /// Both included.
    int whole(int low, int high) {
        return low + static_cast<int>(random.uniform(0, static_cast<double>(high - low + 1)));
    }
    bool chance(double share) { return random.uniform(0, 1) < share; }
    bool oneIn(int count) { return whole(1, count) == 1; }
    Vec3D direction() { return random.direction(); }
    Vec3D inCube(double halfEdge) { return random.inCube(halfEdge); }
    template <class List>
    const auto& oneOf(const List& list) {
        return list[static_cast<std::size_t>(whole(0, static_cast<int>(std::size(list)) - 1))];
    }
    /// Turned about an axis along or near one of the scene's now and then, at random else.
    Vec3D normal() {
        Vec3D result = Vec3D::Unit(whole(0, 2));
        if (oneIn(2)) result += inCube(0.3);
        return oneIn(2) ? result : -result;
    }

    double give(std::string_view what, double right) {
        double value = right;
        for (const WrongValue& other : wrong)
            if (other.number == given) value = other.value, isUsed = true;
        hasGivenNoNumber |= !std::isfinite(value * value);  // laws multiply what they are given
        ++given;
        if (kept.size() < mostOfRecord) kept += fmt::format(" {}={:.6g}", what, value);
        return value;
    }
    Vec3D give(std::string_view what, const Vec3D& right) {
        const double x = give(what, right.x()), y = give(what, right.y());
        return {x, y, give(what, right.z())};
    }
    void note(std::string_view text) { kept += fmt::format(" {}", text); }

    /// What was given, for one who reads how a scene failed.
    [[nodiscard]] const std::string& record() const { return kept; }
    /// Whether any of the wrong values has come to its turn.
    [[nodiscard]] bool usedWrong() const { return isUsed; }
    /// Whether a value or its square was not finite: a wrong one, or what followed from one.
    [[nodiscard]] bool gaveNoNumber() const { return hasGivenNoNumber; }

private:
    static constexpr std::size_t mostOfRecord = 500;

    support::Random random;
    std::string feature, kept;
    std::vector<WrongValue> wrong;
    int given = 0;
    bool isUsed = false, hasGivenNoNumber = false;
};

}  // namespace pendular::fuzz
