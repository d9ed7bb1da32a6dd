#pragma once

#include <string_view>

#include "Kernel/Core/Particles/GrainSpecies.h"

namespace pendular {

/// Throws InputError unless a species, by its number and its handler, is one of the scene's.
/// @param whose for the sentence: "wall 3"
void requireOwnSpecies(const GrainSpecies& ofScene, std::string_view whose, int index,
                       const SpeciesOwner* owner);

}  // namespace pendular
