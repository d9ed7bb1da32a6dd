#pragma once

#include "Kernel/Species/Friction/Shared/MindlinSpring.h"
#include "Kernel/Species/Friction/Shared/RollingTorsionFriction.h"

namespace pendular {

/// Mindlin's tangential spring, and linear springs against rolling and torsion: see MindlinSpring and
/// RollingTorsionFriction.
struct MindlinRollingTorsion : RollingTorsionFriction<MindlinRollingTorsion, MindlinSpring> {
    static constexpr std::string_view name = "MindlinRollingTorsion";
    static constexpr std::string_view summary =
        "tangential spring after Mindlin, with linear springs against rolling and torsion";
    static constexpr std::string_view domain =
        "overlap small against the radius; no partial slip below the limit; a contact that is pressed deeper "
        "while its sliding spring is stretched gains energy, as with Mindlin";
};

}  // namespace pendular
