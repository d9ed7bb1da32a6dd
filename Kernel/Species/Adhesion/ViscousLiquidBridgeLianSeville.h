#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeLianSeville.h"
#include "Kernel/Species/Adhesion/Shared/ViscousBridge.h"

namespace pendular {

using ViscousLiquidBridgeLianSeville = ViscousBridge<LiquidBridgeLianSeville>;

}  // namespace pendular
