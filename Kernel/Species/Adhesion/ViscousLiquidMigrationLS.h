#pragma once

#include "Kernel/Species/Adhesion/LiquidMigrationLS.h"
#include "Kernel/Species/Adhesion/Shared/ViscousBridge.h"

namespace pendular {

using ViscousLiquidMigrationLS = ViscousBridge<LiquidMigrationLS>;

}  // namespace pendular
