#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeRabinovich.h"

namespace pendular {

PublishedBridge LiquidBridgeRabinovich::published(double volume) const {
    const double length2 = volume * (2 / std::numbers::pi), theta = contactAngle;
    const auto force = [length2, theta](double gap) {
        const double root = std::sqrt(gap * gap + length2), pressure = length2 / (root * (root + gap));
        const double alpha = std::sqrt(length2 / (root + gap));
        return 2 * std::numbers::pi *
               (std::cos(theta) * pressure + std::sin(alpha) * std::sin(theta + alpha));
    };
    return {force, lianRupture(volume, theta)};
}

}  // namespace pendular
