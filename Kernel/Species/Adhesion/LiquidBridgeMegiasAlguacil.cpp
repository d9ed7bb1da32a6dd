#include "Kernel/Species/Adhesion/LiquidBridgeMegiasAlguacil.h"

#include "Kernel/Species/Adhesion/Shared/ToroidalBridge.h"

namespace pendular {

PublishedBridge LiquidBridgeMegiasAlguacil::published(double volume) const {
    return attractiveBridge(ToroidsOfVolume(volume, contactAngle), &Toroid::boundaryForce,
                            lianRupture(volume, contactAngle));
}

}  // namespace pendular
