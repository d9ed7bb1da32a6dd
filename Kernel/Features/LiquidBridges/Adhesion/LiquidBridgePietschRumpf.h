#pragma once

#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

namespace pendular {

/// The boundary method of Pietsch and Rumpf, Chem. Ing. Tech. 39 (1967) 885-893, and Huppmann: the meridian
/// is an arc of a circle, the force is taken at the contact line. Formulas as in Yang, Sega and Harting,
/// Tables I and II, model B. They give no rupture distance: the bridge ends at that of Lian et al., or
/// before, where no toroid holds the volume or its force has fallen to zero (for small bridges at about 0.9
/// of it).
struct LiquidBridgePietschRumpf : FittedBridge<LiquidBridgePietschRumpf> {
    static constexpr std::string_view name = "LiquidBridgePietschRumpf";
    static constexpr std::string_view summary =
        "liquid bridge, toroid, force at the contact line (Pietsch and Rumpf, 1967)";
    static constexpr std::string_view domain =
        "V* from 1e-9 to 1, wherever the toroid attracts; unequal spheres and walls by Derjaguin's R; poor "
        "towards rupture";
    static constexpr Range madeForVolume{1e-9, 1};  // V*

    /// The bridge as published, at the dimensionless volume V* = V / R^3.
    [[nodiscard]] PublishedBridge published(double volume) const;
};

}  // namespace pendular
