#pragma once

#include "Kernel/Laws/Friction/Shared/MindlinSpring.h"
#include "Kernel/Laws/Friction/Shared/RollingTorsionFriction.h"
#include "Kernel/Laws/Friction/Shared/StickSlipFriction.h"

namespace pendular {

/// Mindlin's tangential spring, and springs against rolling and torsion: see MindlinSpring and
/// RollingTorsionFriction. As in MercuryDPM's species of this name (MindlinRollingTorsionInteraction.cc), the
/// lever is R* for rolling (Thornton et al. 2023, equation 4.9) and 2 R* for torsion, and the springs have
/// Mindlin's stiffness 8 G* a, unless they are given one. Its torsion spring, which is added to itself in
/// each step there, is that of Luding here.
struct MindlinRollingTorsion
    : RollingTorsionFriction<MindlinRollingTorsion, StickSlipFriction<MindlinRollingTorsion, MindlinSpring>> {
    static constexpr std::string_view name = "MindlinRollingTorsion";
    static constexpr std::string_view summary =
        "tangential spring after Mindlin, with springs against rolling (lever R*) and torsion (lever 2 R*)";
    static constexpr std::string_view domain =
        "overlap small against the radius; no partial slip below the limit; a contact that is pressed deeper "
        "while a spring of Mindlin's stiffness is stretched gains energy, as with Mindlin";
    static constexpr RotationLever leverOfRolling = RotationLever::EffectiveRadius,
                                   leverOfTorsion = RotationLever::EffectiveDiameter;
};

}  // namespace pendular
