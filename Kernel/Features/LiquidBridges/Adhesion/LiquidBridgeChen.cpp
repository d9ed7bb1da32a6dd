#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeChen.h"

#include <algorithm>

#include "Kernel/Features/LiquidBridges/Shared/UnequalToroid.h"

namespace pendular {

PublishedBridge LiquidBridgeChen::published(const Bodies& bodies) const {
    const double volume = scales(bodies).volume;
    const double smaller = std::min(bodies.radius1, bodies.radius2),
                 larger = std::max(bodies.radius1, bodies.radius2);
    const double asymmetry = std::isinf(larger) ? 1 : (larger - smaller) / (larger + smaller);
    const double most = lianRupture(volume, contactAngle);
    const UnequalToroidsOfVolume toroids(volume, contactAngle, asymmetry);
    const auto atContact = UnequalToroidsOfVolume(toroids).at(0);
    const bool concave = atContact && atContact->arcCurvature() > 0;
    if (!concave) return {[](double) { return 0.0; }, 0};
    return attractiveBridge(toroids, &UnequalToroid::gorgeForce, most);
}

}  // namespace pendular
