#pragma once

#include "Kernel/Laws/Adhesion/Shared/AdhesionRamp.h"

namespace pendular {

/// A ramp of attraction that begins at the first touch and ends at its range: each touch that parts again
/// costs F_max^2 / (2 k).
struct IrreversibleAdhesive : AdhesionRamp<IrreversibleAdhesive> {
    static constexpr std::string_view name = "IrreversibleAdhesive";
    static constexpr std::string_view summary =
        "attraction from the first touch on, falling linearly with the separation";
    static constexpr std::string_view domain =
        "a model of bonds that form at contact (dry or wet); forces are of one size for all radii";
    static constexpr bool formsAtContact = true;
};

}  // namespace pendular
