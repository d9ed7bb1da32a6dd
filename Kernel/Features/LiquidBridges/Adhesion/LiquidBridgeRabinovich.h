#pragma once

#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

namespace pendular {

/// Rabinovich, Esayanur and Moudgil, Langmuir 21 (2005) 10992-10997, equations 19, 20 and A3:
///     F = 2 pi R gamma (cos(theta) D(S) + sin(alpha) sin(theta + alpha)),
///     D = 1 / (1 + S/(2d)) = 1 - S / sqrt(S^2 + L^2),  alpha^2 = (sqrt(S^2 + L^2) - S) / R,
/// L = sqrt(2 V / (pi R)) (equations as cited in YADE; the paper was not at hand). At S = 0 it is the limit,
/// alpha^2 = L / R. The bridge ends at the distance of Lian et al.
struct LiquidBridgeRabinovich : FittedBridge<LiquidBridgeRabinovich> {
    static constexpr std::string_view name = "LiquidBridgeRabinovich";
    static constexpr std::string_view summary =
        "liquid bridge, Derjaguin's force and the pull of the rim (Rabinovich et al., 2005)";
    static constexpr std::string_view domain =
        "small bridges, V* from 1e-9 to about 0.01, theta below 90 degrees";
    static constexpr Range madeForVolume{1e-9, 0.01};  // V*

    /// The bridge as published, at the dimensionless volume V* = V / R^3.
    [[nodiscard]] PublishedBridge published(double volume) const;
};

}  // namespace pendular
