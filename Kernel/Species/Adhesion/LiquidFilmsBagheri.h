#pragma once

#include "Kernel/Species/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Species/Adhesion/Shared/LiquidFilms.h"

namespace pendular {

using LiquidFilmsBagheri = LiquidFilms<LiquidBridgeBagheri>;

}  // namespace pendular
