#pragma once

#include "Kernel/Laws/Friction/Shared/ReducedProfile.h"

namespace pendular {

/// Mindlin's tangential stiffness for the increments of the force: a contact that closes keeps the force it
/// has, one that opens loses it in proportion to the contact radius. Source: Thornton, Cummins and Cleary
/// (2013), Powder Technology 233, 30; LAMMPS has it as mindlin_rescale, with springFactor = 1. Here it is
/// 5/6: see ProfileBounds::factorOfWork.
struct MindlinIncremental : ReducedProfile<MindlinIncremental, 1, ProfileBounds<1>{{0, 1}}> {
    static constexpr std::string_view name = "MindlinIncremental";
    static constexpr std::string_view summary =
        "increments of the tangential force after Mindlin, rescaled where the contact opens";
    static constexpr std::string_view domain =
        "overlap small against the radius; loses nothing below the limit";
};

}  // namespace pendular
