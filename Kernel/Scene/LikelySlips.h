#pragma once

#include <string>
#include <vector>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

/// What a user may have given in other units, a sentence without its full stop for each: a value that no
/// material has, or that does not fit the grains. All of it can be meant, and is computed as it is; scenes
/// without units, whose grains have radii of some 1, are only asked for ratios of lengths.
/// @param sizes of all grains, also those of inlets
std::vector<std::string> likelySlips(const ContactLaws& laws, const GrainSizes& sizes,
                                     const WallHandler& walls);

}  // namespace pendular
