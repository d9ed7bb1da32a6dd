#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace pendular::fuzz {

class Making;
struct Recipe;
struct WrongValue;

/// What of a scene does not stay as it was because of a feature, so that it is not asked for.
enum Loses : unsigned {
    nothing = 0,
    momentum = 1,         // forces from outside, or grains that come, go and are changed
    angularMomentum = 2,  // the same, and images
    places = 4            // grains may lie outside of the box
};

/// The share of a feature that scenes have by name only: the scenes of all seeds are as if there was none.
inline constexpr double byName = -1;

/// Something that a scene may have. One entry of the table in Features.cpp: a feature is added there, and
/// nowhere else.
struct Feature {
    std::string name;
    /// The share of scenes that have it (before what excludes it is left out).
    double share;
    /// Adds it, with random numbers of its own: making.draw.
    std::function<void(Making& making)> add;
    unsigned loses = nothing;
    /// Words by which others name it, besides by its own name.
    std::vector<std::string_view> kinds = {};
    /// Names or kinds of features with which Pendular refuses it, rightly or not yet.
    std::vector<std::string_view> excludes = {};
    /// At least one of these must be there.
    std::vector<std::string_view> needs = {};

    /// Whether it has this name, or is of this kind.
    [[nodiscard]] bool is(std::string_view word) const;
};

/// All of them, in the order in which they are added to a scene.
const std::vector<Feature>& allFeatures();
/// Throws InputError, with the names that there are.
const Feature& featureNamed(std::string_view name);
/// Whether one of the two excludes the other.
bool exclude(const Feature& a, const Feature& b);

// The parts of the table, in the order of the table.
std::vector<Feature> materialFeatures();
std::vector<Feature> methodFeatures();
std::vector<Feature> spaceFeatures();
std::vector<Feature> bodyFeatures();
std::vector<Feature> wallFeatures();
std::vector<Feature> meshFeatures();
std::vector<Feature> drivenWallFeatures();
std::vector<Feature> liquidFeatures();
std::vector<Feature> flowFeatures();
std::vector<Feature> changeOfGrainFeatures();
std::vector<Feature> changeOfSceneFeatures();
std::vector<Feature> outputFeatures();

/// Features that together break a property today. The list is to be empty.
struct KnownFault {
    /// Names or kinds that a recipe must have all of; "no grains" stands for a scene without single ones,
    /// "wrong FEATURE" for a wrong value of that feature, and "wrong huge" for one of 1e9 and more. The last
    /// one is left out.
    std::vector<std::string_view> together;
    std::string_view reason;
};
const std::vector<KnownFault>& knownFaults();
bool isHuge(const WrongValue& wrong);
/// The fault that a recipe would meet; null: none.
const KnownFault* knownFaultOf(const Recipe& recipe);

}  // namespace pendular::fuzz
