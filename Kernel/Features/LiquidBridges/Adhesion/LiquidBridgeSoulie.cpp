#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeSoulie.h"

#include <fmt/format.h>

namespace pendular {

std::optional<std::string> LiquidBridgeSoulie::objection(const Bodies& bodies) const {
    if (liquidBridgeVolume == 0) return std::nullopt;
    if (std::isinf(bodies.radius1) || std::isinf(bodies.radius2))
        return fmt::format(
            "{}: the fit is for two spheres and has no limit at a wall (r1 = {:.6g} m, r2 = {:.6g} m), "
            "so take another bridge law.",
            name, bodies.radius1, bodies.radius2);
    if (auto angle = LiquidBridge::objection(bodies)) return angle;
    return objectionToExponential(name, prepare(bodies), scales(bodies), contactAngle);
}

}  // namespace pendular
