#include "Kernel/Species/Adhesion/LiquidBridgePietschRumpf.h"

#include "Kernel/Species/Adhesion/Shared/ToroidalBridge.h"

namespace pendular {

PublishedBridge LiquidBridgePietschRumpf::published(double volume) const {
    return toroidalBridge(volume, contactAngle, &Toroid::boundaryForce);
}

}  // namespace pendular
