#pragma once

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeLianSeville.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeYoungLaplace.h"
#include "Kernel/Features/LiquidBridges/Shared/LiquidFilms.h"
#include "Kernel/Features/LiquidBridges/Shared/LiquidMigration.h"
#include "Kernel/Features/LiquidBridges/Shared/ViscousBridge.h"

namespace pendular {

// Laws that are made of a bridge and a template. CMake reads their names here: one `using` a line.

using LiquidFilmsBagheri = LiquidFilms<LiquidBridgeBagheri>;
using LiquidFilmsWillett = LiquidFilms<LiquidBridgeWillett>;
using LiquidFilmsYoungLaplace = LiquidFilms<LiquidBridgeYoungLaplace>;

using LiquidMigrationBagheri = LiquidMigration<LiquidBridgeBagheri>;
/// The capillary part of MercuryDPM's law of this name.
using LiquidMigrationLS = LiquidMigration<LiquidBridgeLianSeville>;
using LiquidMigrationWillett = LiquidMigration<LiquidBridgeWillett>;
using LiquidMigrationYoungLaplace = LiquidMigration<LiquidBridgeYoungLaplace>;

using ViscousLiquidBridgeBagheri = ViscousBridge<LiquidBridgeBagheri>;
using ViscousLiquidBridgeLianSeville = ViscousBridge<LiquidBridgeLianSeville>;
using ViscousLiquidBridgeWillett = ViscousBridge<LiquidBridgeWillett>;
using ViscousLiquidBridgeYoungLaplace = ViscousBridge<LiquidBridgeYoungLaplace>;

using ViscousLiquidMigrationLS = ViscousBridge<LiquidMigrationLS>;
using ViscousLiquidMigrationWillett = ViscousBridge<LiquidMigrationWillett>;
using ViscousLiquidMigrationYoungLaplace = ViscousBridge<LiquidMigrationYoungLaplace>;

}  // namespace pendular
