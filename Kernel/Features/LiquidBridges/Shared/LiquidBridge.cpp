#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> objectionToBridgeVolume(std::string_view law, double liquidBridgeVolume,
                                                   const BridgeScales& scales) {
    if (scales.volume <= mostBridgeVolume) return std::nullopt;
    return fmt::format(
        "{}: liquidBridgeVolume = {:.6g} m^3 is V* = V/R^3 = {:.6g} between two bodies of this scene (R = "
        "{:.6g} "
        "m), and no bridge; it must be at most V* = {:g}, which is {:.6g} m^3 there.",
        law, liquidBridgeVolume, scales.volume, scales.radius, mostBridgeVolume,
        mostBridgeVolume * scales.radius * scales.radius * scales.radius);
}

std::optional<std::string> objectionAboveRightAngle(std::string_view law, double contactAngle) {
    if (contactAngle <= 0.5 * std::numbers::pi) return std::nullopt;
    return fmt::format(
        "{}: contactAngle = {:.6g} rad is above pi/2, where a bridge does not attract at contact and this "
        "law "
        "does not hold; take a smaller angle, or LiquidBridgeYoungLaplace.",
        law, contactAngle);
}

}  // namespace pendular
