#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeYoungLaplace.h"
#include "Kernel/Species/Adhesion/Shared/LiquidFilms.h"

namespace pendular {

using LiquidFilmsYoungLaplace = LiquidFilms<LiquidBridgeYoungLaplace>;

}  // namespace pendular
