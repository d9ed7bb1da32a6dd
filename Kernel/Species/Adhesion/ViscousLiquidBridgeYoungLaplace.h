#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeYoungLaplace.h"
#include "Kernel/Species/Adhesion/Shared/ViscousBridge.h"

namespace pendular {

using ViscousLiquidBridgeYoungLaplace = ViscousBridge<LiquidBridgeYoungLaplace>;

}  // namespace pendular
