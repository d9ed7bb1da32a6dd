#include "Kernel/Species/Adhesion/LiquidBridgeLian.h"

#include "Kernel/Species/Adhesion/Shared/ToroidalBridge.h"

namespace pendular {

PublishedBridge LiquidBridgeLian::published(double volume) const {
    return attractiveBridge(ToroidsOfVolume(volume, contactAngle), &Toroid::gorgeForce,
                            lianRupture(volume, contactAngle));
}

}  // namespace pendular
