#pragma once

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeEquations.h"

namespace pendular {

/// A first guess of the arc: a circular meridian between parabolic bodies that holds the volume.
/// Exact for small bridges and small gaps, good enough for Newton's method on most others.
DelaunayArc guessArc(const BridgeConditions& conditions, double gap);

}  // namespace pendular
