#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Species/Adhesion/Shared/ViscousBridge.h"

namespace pendular {

using ViscousLiquidBridgeBagheri = ViscousBridge<LiquidBridgeBagheri>;

}  // namespace pendular
