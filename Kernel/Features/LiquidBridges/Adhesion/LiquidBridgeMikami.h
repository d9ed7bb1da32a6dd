#pragma once

#include <cmath>

#include "Kernel/Features/LiquidBridges/Shared/ExponentialBridge.h"

namespace pendular {

/// The fit of Mikami, Kamiya and Horio, Chem. Eng. Sci. 53 (1998) 1927-1940, to their solutions of the
/// Young-Laplace equation between equal spheres: F = pi R gamma (exp(A S/R + B) + C), with its own rupture
/// distance (0.99 + 0.62 theta) V*^0.34 R. The paper was not at hand: coefficients as in Yang, Sega and
/// Harting, Table II, the rupture distance as in two open programs. With V* = V / R^3 and the full separation
/// both agree with the exact solution at theta = 0 (a test); Yang et al. tabulate with half of it, others
/// divide V* by pi. Unequal spheres and walls by Derjaguin's R: the coefficients that one finds for their
/// fit to a wall give 1.7 times the exact force at contact.
struct LiquidBridgeMikami : LiquidBridge<LiquidBridgeMikami> {
    static constexpr std::string_view name = "LiquidBridgeMikami";
    static constexpr std::string_view summary = "liquid bridge, fit of Mikami et al. (1998)";
    static constexpr std::string_view domain =
        "equal spheres, V* from about 1e-4 to 0.1; with theta above 0 its force at contact grows with the "
        "angle "
        "for V* below 0.059";

    template <class T>
    using Interaction = ExponentialBridgeInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return {0, 0, 0, 0};
        const BridgeScales bridge = scales(bodies);
        const double logV = std::log(bridge.volume), t = contactAngle, force = 0.5 * bridge.forceScale;
        const double b = (-0.34 * logV - 0.96) * t * t - 0.019 * logV + 0.48;
        return {.falling = force * std::exp(b),
                .rate = -1.1 * std::pow(bridge.volume, -0.53) / (bridge.radius * std::numbers::ln2),
                .constant = force * (0.0042 * logV + 0.078),
                .ruptureDistance = range(bodies)};
    }
    [[nodiscard]] double range(const Bodies& bodies) const {
        const BridgeScales bridge = scales(bodies);
        return (0.99 + 0.62 * contactAngle) * std::pow(bridge.volume, 0.34) * bridge.radius;
    }
    /// Below the smallest volume at an angle above 0, the force at contact grows with the angle.
    [[nodiscard]] std::vector<DomainLimit> domainLimits(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return {};
        return {{"V*", scales(bodies).volume, {contactAngle > 0 ? 0.059 : 1e-4, 0.1}},
                {"ratio of the radii", bodies.radius2 / bodies.radius1, {1, 1}}};
    }
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return std::nullopt;
        if (auto angle = LiquidBridge::objection(bodies)) return angle;
        return objectionToExponential(name, prepare(bodies), scales(bodies), contactAngle);
    }
};

}  // namespace pendular
