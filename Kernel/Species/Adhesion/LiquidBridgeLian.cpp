#include "Kernel/Species/Adhesion/LiquidBridgeLian.h"

#include "Kernel/Species/Adhesion/Shared/ToroidalBridge.h"

namespace pendular {

PublishedBridge LiquidBridgeLian::published(double volume) const {
    return toroidalBridge(volume, contactAngle, &Toroid::gorgeForce);
}

}  // namespace pendular
