#pragma once

#include <cmath>

#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

namespace pendular {

/// What one contact remembers of a Lambert bridge, and its force, 2 pi R gamma cos(theta) (1 - S / r) with
/// r = sqrt(S^2 + L^2), L = sqrt(2 V / (pi R)); written without the cancellation for S >> L.
template <class T>
struct LiquidBridgeLambertInteraction {
    T scaledForce;      // 2 pi R gamma cos(theta) L^2, N m^2
    T squaredLength;    // L^2, m^2
    T ruptureDistance;  // m

    [[nodiscard]] T force(T separation) const {
        const T root = sqrt(separation * separation + squaredLength);
        return scaledForce / (root * (root + separation));
    }
    [[nodiscard]] T range() const { return ruptureDistance; }
};

/// Lambert, Chau, Delchambre and Regnier, Langmuir 24 (2008) 3157-3163, equation 65:
///     F = 2 pi R gamma cos(theta) / (1 + S/(2d)),  d = (S/2)(-1 + sqrt(1 + 2 V/(pi R S^2))),
/// Derjaguin's approximation (equation as cited in YADE); also Rabinovich's without the pull of the rim, and
/// model D of Yang, Sega and Harting. It gives no rupture distance: the bridge ends at that of Lian et al.
struct LiquidBridgeLambert : LiquidBridge<LiquidBridgeLambert> {
    static constexpr std::string_view name = "LiquidBridgeLambert";
    static constexpr std::string_view summary = "liquid bridge, Derjaguin's force (Lambert et al., 2008)";
    static constexpr std::string_view domain =
        "the limit of small bridges, V* below about 1e-4, theta below 90 degrees";
    static constexpr Range madeForVolume = positiveUpTo(1e-4);  // V*

    template <class T>
    using Interaction = LiquidBridgeLambertInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return {0, 1, 0};
        const BridgeScales bridge = scales(bodies);
        const double squaredLength = 2 * liquidBridgeVolume / (std::numbers::pi * bridge.radius);
        return {.scaledForce = bridge.forceScale * std::cos(contactAngle) * squaredLength,
                .squaredLength = squaredLength,
                .ruptureDistance = range(bodies)};
    }
    [[nodiscard]] double range(const Bodies&) const { return lianRupture(liquidBridgeVolume, contactAngle); }
};

}  // namespace pendular
