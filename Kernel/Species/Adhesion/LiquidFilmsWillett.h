#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Species/Adhesion/Shared/LiquidFilms.h"

namespace pendular {

using LiquidFilmsWillett = LiquidFilms<LiquidBridgeWillett>;

}  // namespace pendular
