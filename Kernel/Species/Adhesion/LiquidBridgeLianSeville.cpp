#include "Kernel/Species/Adhesion/LiquidBridgeLianSeville.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> LiquidBridgeLianSeville::objection(const Bodies& bodies) const {
    if (liquidBridgeVolume == 0) return std::nullopt;
    constexpr double rightAngle = 0.5 * std::numbers::pi;
    const BridgeScales bridge = scales(bodies);
    const double beta = fillingAngle(bridge.volume, contactAngle);
    const bool fills = beta > 0 && beta < rightAngle;
    // Beyond 90 degrees tan(theta) is negative: the sign of the force means nothing there.
    if (fills && contactAngle < rightAngle && prepare(bodies).contactForce > 0) return std::nullopt;
    return fmt::format(
        "{}: the fit {} for contactAngle = {:.6g} rad and V* = liquidBridgeVolume/R^3 = {:.6g} "
        "(liquidBridgeVolume = {:.6g} m^3, R = {:.6g} m); take a smaller angle or volume, or another bridge "
        "law.",
        name, fills ? "does not attract" : "has no filling angle between 0 and 90 degrees", contactAngle,
        bridge.volume, liquidBridgeVolume, bridge.radius);
}

}  // namespace pendular
