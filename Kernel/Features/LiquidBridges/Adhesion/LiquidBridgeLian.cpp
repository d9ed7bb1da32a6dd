#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeLian.h"

#include "Kernel/Features/LiquidBridges/Shared/ToroidalBridge.h"

namespace pendular {

PublishedBridge LiquidBridgeLian::published(double volume) const {
    return attractiveBridge(ToroidsOfVolume(volume, contactAngle), &Toroid::gorgeForce,
                            lianRupture(volume, contactAngle));
}

}  // namespace pendular
