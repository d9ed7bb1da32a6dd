#include "Kernel/Features/LiquidBridges/Shared/ExponentialBridge.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> objectionToExponential(std::string_view law,
                                                  const ExponentialBridgeInteraction<double>& bridge,
                                                  const BridgeScales& scales, double contactAngle) {
    constexpr double mostReasonable = 10;  // F* at contact, as for the classical Willett fit
    const bool attracts = bridge.force(bridge.ruptureDistance) > 0;
    if (attracts && bridge.force(0.0) < mostReasonable * scales.forceScale) return std::nullopt;
    return fmt::format(
        "{}: the fit {} for contactAngle = {:.6g} rad and V* = liquidBridgeVolume/R^3 = {:.6g} (R = {:.6g} "
        "m); take "
        "a larger volume, a smaller angle, or another bridge law.",
        law, attracts ? "is more than ten times too strong at contact" : "does not attract up to the rupture",
        contactAngle, scales.volume, scales.radius);
}

}  // namespace pendular
