#pragma once

#include "Kernel/Laws/Friction/Shared/LinearSpring.h"
#include "Kernel/Laws/Friction/Shared/RollingTorsionFriction.h"
#include "Kernel/Laws/Friction/Shared/StickSlipFriction.h"

namespace pendular {

/// Linear springs against sliding, rolling and torsion, the latter two with the lever R*: see LinearSpring
/// and RollingTorsionFriction. Friction is the same with the lever of MercuryDPM.
struct SlidingRollingTorsion
    : RollingTorsionFriction<SlidingRollingTorsion, StickSlipFriction<SlidingRollingTorsion, LinearSpring>> {
    static constexpr std::string_view name = "SlidingRollingTorsion";
    static constexpr std::string_view summary =
        "linear springs with dashpots and sliders against sliding, rolling and torsion (Luding), lever R*";
    static constexpr std::string_view domain =
        "any overlap; the stiffnesses do not grow with it, so best with a linear normal law";
    static constexpr RotationLever leverOfRolling = RotationLever::EffectiveRadius,
                                   leverOfTorsion = RotationLever::EffectiveRadius;
};

}  // namespace pendular
