#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeLianSeville.h"
#include "Kernel/Species/Adhesion/Shared/LiquidMigration.h"

namespace pendular {

/// The capillary part of MercuryDPM's law of this name.
using LiquidMigrationLS = LiquidMigration<LiquidBridgeLianSeville>;

}  // namespace pendular
