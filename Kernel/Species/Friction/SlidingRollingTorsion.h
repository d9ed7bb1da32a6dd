#pragma once

#include "Kernel/Species/Friction/Shared/LinearSpring.h"
#include "Kernel/Species/Friction/Shared/RollingTorsionFriction.h"

namespace pendular {

/// Linear springs against sliding, rolling and torsion: see LinearSpring and RollingTorsionFriction.
/// (MercuryDPM's friction species.)
struct SlidingRollingTorsion : RollingTorsionFriction<SlidingRollingTorsion, LinearSpring> {
    static constexpr std::string_view name = "SlidingRollingTorsion";
    static constexpr std::string_view summary =
        "linear springs with dashpots and sliders against sliding, rolling and torsion (Luding)";
    static constexpr std::string_view domain =
        "any overlap; the stiffnesses do not grow with it, so best with a linear normal law";
};

}  // namespace pendular
