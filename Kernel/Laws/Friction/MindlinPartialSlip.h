#pragma once

#include "Kernel/Laws/Friction/Shared/ReducedProfile.h"

namespace pendular {

/// Partial slip by three springs in parallel, which divide the contact radius at 1/2 and 4/5: the outer ones
/// carry less and slip first, and remain where they slipped when the load turns. A short form of the exact
/// PartialSlipContact, see ReducedProfile.
struct MindlinPartialSlip : ReducedProfile<MindlinPartialSlip, 3, ProfileBounds<3>{{0, 0.5, 0.8, 1}}> {
    static constexpr std::string_view name = "MindlinPartialSlip";
    static constexpr std::string_view summary = "partial slip after Mindlin, by three springs in parallel";
    static constexpr std::string_view domain =
        "overlap small against the radius; loses nothing below 0.28 of the limit";
};

}  // namespace pendular
