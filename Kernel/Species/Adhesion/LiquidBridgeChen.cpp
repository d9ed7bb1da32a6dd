#include "Kernel/Species/Adhesion/LiquidBridgeChen.h"

#include <algorithm>

#include "Kernel/Species/Adhesion/Shared/UnequalToroid.h"

namespace pendular {

PublishedBridge LiquidBridgeChen::published(const Bodies& bodies) const {
    const double volume = scales(bodies).volume;
    const double smaller = std::min(bodies.radius1, bodies.radius2),
                 larger = std::max(bodies.radius1, bodies.radius2);
    const double asymmetry = std::isinf(larger) ? 1 : (larger - smaller) / (larger + smaller);
    const double most = lianRupture(volume, contactAngle);
    PublishedBridge bridge = attractiveBridge(UnequalToroidsOfVolume(volume, contactAngle, asymmetry),
                                              &UnequalToroid::gorgeForce, most);
    constexpr double leastShare = 0.5;  // ends earlier only where its arc becomes straight: the pole
    if (bridge.ruptureDistance < leastShare * most) bridge.ruptureDistance = 0;
    return bridge;
}

}  // namespace pendular
