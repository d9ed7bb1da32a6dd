#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWeigert.h"

#include <algorithm>

#include "Kernel/Features/LiquidBridges/Shared/ToroidalBridge.h"
#include "Kernel/Foundation/Math/Halving.h"

namespace pendular {

PublishedBridge LiquidBridgeWeigert::published(double volume) const {
    const double theta = contactAngle;
    const auto fourthPowerOfSine = [volume, theta](double gap) {
        return volume / (0.12 * 8 * (1 + 6 * gap / 2) * (1 + 1.1 * std::sin(theta)));
    };
    const auto toroid = [=](double gap) {
        const double sine = std::sqrt(std::sqrt(std::min(fourthPowerOfSine(gap), 1.0)));
        return Toroid{std::asin(sine), gap, theta};
    };
    const auto attracts = [&](double gap) {
        return toroid(gap).neck() > 0 && toroid(gap).boundaryForce() > 0;
    };
    if (fourthPowerOfSine(0) > 1 || !attracts(0)) return {[](double) { return 0.0; }, 0};
    double rupture = lianRupture(volume, theta);
    if (!attracts(rupture)) rupture = turningPoint(0, rupture, attracts, 50).holds;
    return {[=](double gap) { return toroid(gap).boundaryForce(); }, rupture};
}

}  // namespace pendular
