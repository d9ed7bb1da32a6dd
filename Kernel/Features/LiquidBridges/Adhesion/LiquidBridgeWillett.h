#pragma once

#include <cmath>

#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"

namespace pendular {

/// What one contact remembers of a simplified Willett bridge, and its force:
/// F* = cos(theta) / (1 + 2.1 S+ + 10 S+^2), S+ = S / sqrt(4 V / R).
template <class T>
struct LiquidBridgeWillettInteraction {
    T contactForce;     // F at S = 0, N
    T separationScale;  // 1 / sqrt(4 V / R), 1/m
    T ruptureDistance;  // m

    [[nodiscard]] T force(T separation) const {
        const T s = separation * separationScale;
        return contactForce / fma(s, fma(T(10), s, T(2.1)), T(1));
    }
    [[nodiscard]] T range() const { return ruptureDistance; }
};

/// The simplified form of Willett et al. (2000), Langmuir 16, 9396, equation 12; Bagheri et al., equation
/// A.2. It takes F(0) = 2 pi R gamma cos(theta) for every volume.
struct LiquidBridgeWillett : LiquidBridge<LiquidBridgeWillett> {
    static constexpr std::string_view name = "LiquidBridgeWillett";
    static constexpr std::string_view summary = "liquid bridge, simplified Willett form";
    static constexpr std::string_view domain =
        "small bridges between wetted grains, V* below about 0.001 and theta below 50 degrees; attractive "
        "below 90 degrees";
    static constexpr Range madeForVolume = positiveUpTo(1e-3);  // V*
    static constexpr double madeForAngle = 50;                  // degrees

    template <class T>
    using Interaction = LiquidBridgeWillettInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return {0, 0, 0};
        const BridgeScales bridge = scales(bodies);
        return {.contactForce = bridge.forceScale * std::cos(contactAngle),
                .separationScale = 0.5 * std::sqrt(bridge.radius / liquidBridgeVolume),
                .ruptureDistance = bridge.ruptureDistance};
    }
};

}  // namespace pendular
