#pragma once

#include "Kernel/Laws/Friction/Shared/LinearSpring.h"
#include "Kernel/Laws/Friction/Shared/StickSlipFriction.h"

namespace pendular {

/// A linear tangential spring with static and dynamic friction: see LinearSpring and StickSlip. The limit
/// counts the normal force of elasticity and damping only, not an adhesion.
struct SlidingFriction : StickSlipFriction<SlidingFriction, LinearSpring> {
    static constexpr std::string_view name = "SlidingFriction";
    static constexpr std::string_view summary =
        "linear tangential spring with dashpot and slider (Luding), static and dynamic friction";
    static constexpr std::string_view domain =
        "any overlap; the stiffness does not grow with it, so best with a linear normal law";
};

}  // namespace pendular
