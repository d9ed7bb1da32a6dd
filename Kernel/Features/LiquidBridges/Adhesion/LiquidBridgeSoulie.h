#pragma once

#include <algorithm>
#include <cmath>

#include "Kernel/Features/LiquidBridges/Shared/ExponentialBridge.h"
#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

namespace pendular {

/// The fit of Soulie, Cherblanc, El Youssoufi and Saix, Int. J. Numer. Anal. Meth. Geomech. 30 (2006)
/// 213-228, equations 13 and 14, for spheres of radii r1 <= r2: F = pi gamma sqrt(r1 r2) (c + exp(a S/r2 +
/// b)), with V/r2^3 in a, b and c. The paper was not at hand: coefficients as in LIGGGHTS and YADE, which
/// agree; three of them are Mikami's over ln 10. The rupture distance is that of Lian et al., as in LIGGGHTS.
/// The fit is not for walls: it has no limit for r2 -> infinity.
struct LiquidBridgeSoulie : LiquidBridge<LiquidBridgeSoulie> {
    static constexpr std::string_view name = "LiquidBridgeSoulie";
    static constexpr std::string_view summary = "liquid bridge, fit of Soulie et al. (2006)";
    static constexpr std::string_view domain =
        "spheres, not walls; V/r2^3 from about 1e-4 to 0.1; with theta above 0 its force at contact grows "
        "with the "
        "angle for V/r2^3 below 0.0015";

    template <class T>
    using Interaction = ExponentialBridgeInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        const double larger = std::max(bodies.radius1, bodies.radius2);
        if (liquidBridgeVolume == 0 || std::isinf(larger)) return {0, 0, 0, range(bodies)};
        const double force = std::numbers::pi * surfaceTension * std::sqrt(bodies.radius1 * bodies.radius2);
        const double logV = std::log(liquidBridgeVolume / (larger * larger * larger)), t = contactAngle;
        const double b = (-0.148 * logV - 0.96) * t * t - 0.0082 * logV + 0.48;
        return {.falling = force * std::exp(b),
                .rate = -1.1 * std::exp(-0.53 * logV) / (larger * std::numbers::ln2),
                .constant = force * (0.0018 * logV + 0.078),
                .ruptureDistance = range(bodies)};
    }
    [[nodiscard]] double range(const Bodies&) const { return lianRupture(liquidBridgeVolume, contactAngle); }
    /// Below the smallest volume at an angle above 0, the force at contact grows with the angle. Walls are
    /// refused.
    [[nodiscard]] std::vector<DomainLimit> domainLimits(const Bodies& bodies) const {
        const double larger = std::max(bodies.radius1, bodies.radius2);
        if (liquidBridgeVolume == 0 || std::isinf(larger)) return {};
        return {{"V/r2^3",
                 liquidBridgeVolume / (larger * larger * larger),
                 {contactAngle > 0 ? 0.0015 : 1e-4, 0.1}}};
    }
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const;
};

}  // namespace pendular
