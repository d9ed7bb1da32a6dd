#include "Kernel/Species/Adhesion/LiquidBridgeMegiasAlguacil.h"

#include "Kernel/Species/Adhesion/Shared/ToroidalBridge.h"

namespace pendular {

PublishedBridge LiquidBridgeMegiasAlguacil::published(double volume) const {
    return toroidalBridge(volume, contactAngle, &Toroid::boundaryForce);
}

}  // namespace pendular
