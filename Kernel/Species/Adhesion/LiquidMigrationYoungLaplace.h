#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeYoungLaplace.h"
#include "Kernel/Species/Adhesion/Shared/LiquidMigration.h"

namespace pendular {

using LiquidMigrationYoungLaplace = LiquidMigration<LiquidBridgeYoungLaplace>;

}  // namespace pendular
