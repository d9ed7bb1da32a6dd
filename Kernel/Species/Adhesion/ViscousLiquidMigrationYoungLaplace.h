#pragma once

#include "Kernel/Species/Adhesion/LiquidMigrationYoungLaplace.h"
#include "Kernel/Species/Adhesion/Shared/ViscousBridge.h"

namespace pendular {

using ViscousLiquidMigrationYoungLaplace = ViscousBridge<LiquidMigrationYoungLaplace>;

}  // namespace pendular
