#pragma once

#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

namespace pendular {

/// Weigert and Ripperger, Part. Part. Syst. Charact. 16 (1999) 238-242: the filling angle beta in closed
/// form,
///     sin^4(beta) = V / (0.12 (2R)^3 (1 + 6 S/(2R)) (1 + 1.1 sin(theta))),  equations 15 to 17,
/// and the toroid's force at the contact line, equations 5, 6, 21 and 22 (as cited in YADE; the paper was not
/// at hand). The bridge ends at the distance of Lian et al., or before, where the neck closes or the force
/// has fallen to zero.
struct LiquidBridgeWeigert : FittedBridge<LiquidBridgeWeigert> {
    static constexpr std::string_view name = "LiquidBridgeWeigert";
    static constexpr std::string_view summary =
        "liquid bridge, toroid with an explicit filling angle (Weigert and Ripperger, 1999)";
    static constexpr std::string_view domain =
        "V* from about 0.01 to 0.3, wherever its filling angle exists and its toroid attracts; smaller "
        "bridges are much too "
        "strong at a distance; unequal "
        "spheres and walls by Derjaguin's R";
    static constexpr Range madeForVolume{0.01, 0.3};  // V*

    /// The bridge as published, at the dimensionless volume V* = V / R^3.
    [[nodiscard]] PublishedBridge published(double volume) const;
};

}  // namespace pendular
