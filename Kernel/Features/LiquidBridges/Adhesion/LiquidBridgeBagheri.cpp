#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"

#include <fmt/format.h>

#include <algorithm>

namespace pendular {

namespace {

/// The smallest value of 1 + b x + c x^2 for 0 <= x <= 1.
double smallestDenominator(double b, double c) {
    double smallest = std::min(1.0, 1 + b + c);
    if (const double x = -0.5 * b / c; c > 0 && x > 0 && x < 1)
        smallest = std::min(smallest, 1 + x * (b + c * x));
    return smallest;
}

}  // namespace

std::optional<std::string> LiquidBridgeBagheri::objection(const Bodies& bodies) const {
    if (liquidBridgeVolume == 0) return std::nullopt;
    if (rawFit > 0) return objectionToVolume(bodies);
    if (auto found = LiquidBridge::objection(bodies)) return found;
    const BridgeScales bridge = scales(bodies);
    const auto [wetted, angled, aS, bS, cTheta] = coefficients(bridge.volume, contactAngle);
    const bool attracts = wetted * angled > 0 && 1 + aS > 0;
    const bool pole = !(smallestDenominator(cTheta * aS * bS, cTheta * bS) > 0);
    if (attracts && !pole && bS > 0 && cTheta > 0) return std::nullopt;
    return fmt::format(
        "{}: the fit {} for contactAngle = {:.6g} rad and V* = liquidBridgeVolume/R^3 = {:.6g} "
        "(liquidBridgeVolume = {:.6g} "
        "m^3, R = {:.6g} m); take a smaller angle or volume, another bridge law, or setRawFit(true) to use "
        "it as it is.",
        name,
        pole        ? "has a pole before the rupture"
        : !attracts ? "is not attractive"
                    : "has a coefficient b_s or c_theta that is not positive",
        contactAngle, bridge.volume, liquidBridgeVolume, bridge.radius);
}

}  // namespace pendular
