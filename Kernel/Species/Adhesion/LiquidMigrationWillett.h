#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Species/Adhesion/Shared/LiquidMigration.h"

namespace pendular {

using LiquidMigrationWillett = LiquidMigration<LiquidBridgeWillett>;

}  // namespace pendular
