#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgePietschRumpf.h"

#include "Kernel/Features/LiquidBridges/Shared/ToroidalBridge.h"

namespace pendular {

PublishedBridge LiquidBridgePietschRumpf::published(double volume) const {
    return attractiveBridge(ToroidsOfVolume(volume, contactAngle), &Toroid::boundaryForce,
                            lianRupture(volume, contactAngle));
}

}  // namespace pendular
