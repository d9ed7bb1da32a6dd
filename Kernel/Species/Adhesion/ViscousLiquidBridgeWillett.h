#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Species/Adhesion/Shared/ViscousBridge.h"

namespace pendular {

using ViscousLiquidBridgeWillett = ViscousBridge<LiquidBridgeWillett>;

}  // namespace pendular
