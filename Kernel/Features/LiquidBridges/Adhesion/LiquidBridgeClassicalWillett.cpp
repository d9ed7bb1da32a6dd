#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeClassicalWillett.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> LiquidBridgeClassicalWillett::objection(const Bodies& bodies) const {
    if (liquidBridgeVolume == 0) return std::nullopt;
    if (auto angle = LiquidBridge::objection(bodies)) return angle;
    constexpr double mostReasonable = 10;  // F* at contact
    const BridgeScales bridge = scales(bodies);
    const Coefficients f = coefficients(bridge.volume, contactAngle);
    const bool falls = f.f2 > 0;
    if (falls && std::exp(f.f1) < mostReasonable) return std::nullopt;
    return fmt::format(
        "{}: the fit {} for contactAngle = {:.6g} rad and V* = liquidBridgeVolume/R^3 = {:.6g} "
        "(liquidBridgeVolume = {:.6g} m^3, R = {:.6g} m); its domain is V* from about 1e-5 to 1 and angles "
        "up to "
        "50 degrees, so take another bridge law.",
        name, falls ? "is more than ten times too strong at contact" : "grows with the separation",
        contactAngle, bridge.volume, liquidBridgeVolume, bridge.radius);
}

}  // namespace pendular
