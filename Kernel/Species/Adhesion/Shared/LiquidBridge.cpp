#include "Kernel/Species/Adhesion/Shared/LiquidBridge.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> objectionAboveRightAngle(std::string_view law, double contactAngle) {
    if (contactAngle <= 0.5 * std::numbers::pi) return std::nullopt;
    return fmt::format(
        "{}: contactAngle = {:.6g} rad is above pi/2, where a bridge does not attract at contact and this "
        "law "
        "does not hold; take a smaller angle, or LiquidBridgeYoungLaplace.",
        law, contactAngle);
}

}  // namespace pendular
