#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "SelfTests/Fuzz/RandomScenes/Judge.h"

namespace pendular::fuzz {

/// Features of random scenes, by name, of which each two must go together or be refused.
std::span<const std::string_view> composedFeatures();

/// Why two of them are not run together; empty: they are. Settings that replace each other (two integrators)
/// are no pair, and superquadrics have no liquid that moves or resists.
std::string_view whyNoPair(std::string_view a, std::string_view b);
/// The same of more of them: each two are a pair, and a scene of shapes has one type of species.
std::string_view whyNotTogether(std::span<const std::string_view> names);

/// A full scene with these features, with grains, and with what the features need.
Recipe recipeWith(std::span<const std::string_view> names, std::uint64_t seed);

/// Runs the scene with three restarts. Faults are those of judge(), and an end that is none of these: the end
/// of the run; a refusal with the sentence of a row of the table of conflicts, or with one of a feature that
/// is not used as it must be (RefusedElsewhere in Composition.cpp).
Verdict judgeComposition(const Recipe& recipe);

}  // namespace pendular::fuzz
