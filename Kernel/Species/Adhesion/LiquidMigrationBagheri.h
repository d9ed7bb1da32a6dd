#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Species/Adhesion/Shared/LiquidMigration.h"

namespace pendular {

using LiquidMigrationBagheri = LiquidMigration<LiquidBridgeBagheri>;

}  // namespace pendular
