#pragma once

#include "Kernel/Species/Adhesion/LiquidMigrationWillett.h"
#include "Kernel/Species/Adhesion/Shared/ViscousBridge.h"

namespace pendular {

using ViscousLiquidMigrationWillett = ViscousBridge<LiquidMigrationWillett>;

}  // namespace pendular
