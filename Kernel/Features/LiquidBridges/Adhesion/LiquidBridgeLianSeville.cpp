#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeLianSeville.h"

#include <fmt/format.h>

namespace pendular {

namespace {

/// d beta / d ln V*: above about 35 degrees the second term of beta is negative and wins at large volumes.
double growthOfFillingAngle(double volume, double theta) {
    const double power = 0.6327 + 0.897 * theta;
    return 0.26 * std::pow(volume, 0.26) + (0.285 - 0.4594 * theta) * power * std::pow(volume, power);
}

}  // namespace

std::optional<std::string> LiquidBridgeLianSeville::objection(const Bodies& bodies) const {
    if (liquidBridgeVolume == 0) return std::nullopt;
    if (auto angle = LiquidBridge::objection(bodies)) return angle;
    constexpr double rightAngle = 0.5 * std::numbers::pi;
    const BridgeScales bridge = scales(bodies);
    const double beta = fillingAngle(bridge.volume, contactAngle);
    const bool fills = beta > 0 && beta < rightAngle && growthOfFillingAngle(bridge.volume, contactAngle) > 0;
    // At 90 degrees the tangent is infinite.
    if (fills && contactAngle < rightAngle && prepare(bodies).contactForce > 0) return std::nullopt;
    return fmt::format(
        "{}: the fit {} for contactAngle = {:.6g} rad and V* = liquidBridgeVolume/R^3 = {:.6g} "
        "(liquidBridgeVolume = {:.6g} m^3, R = {:.6g} m); take a smaller angle or volume, or another bridge "
        "law.",
        name,
        fills ? "does not attract"
              : "has no filling angle between 0 and 90 degrees that grows with the volume",
        contactAngle, bridge.volume, liquidBridgeVolume, bridge.radius);
}

}  // namespace pendular
