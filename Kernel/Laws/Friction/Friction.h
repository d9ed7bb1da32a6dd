#pragma once

#include "Kernel/Laws/Friction/Shared/LinearSpring.h"
#include "Kernel/Laws/Friction/Shared/RollingTorsionFriction.h"
#include "Kernel/Laws/Friction/Shared/StickSlipFriction.h"

namespace pendular {

/// Linear springs against sliding, rolling and torsion as MercuryDPM's species of this name have them:
/// rolling and torsion have the lever 2 R* (FrictionInteraction.cc), so that its programs' numbers give its
/// torques. SlidingRollingTorsion has the lever R*: a quarter of the stiffness and half the limit.
struct Friction : RollingTorsionFriction<Friction, StickSlipFriction<Friction, LinearSpring>> {
    static constexpr std::string_view name = "Friction";
    static constexpr std::string_view summary =
        "linear springs with dashpots and sliders against sliding, rolling and torsion, lever 2 R* "
        "(MercuryDPM's)";
    static constexpr std::string_view domain =
        "any overlap; the stiffnesses do not grow with it, so best with a linear normal law";
    static constexpr RotationLever leverOfRolling = RotationLever::EffectiveDiameter,
                                   leverOfTorsion = RotationLever::EffectiveDiameter;
};

}  // namespace pendular
