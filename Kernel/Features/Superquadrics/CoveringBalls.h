#pragma once

#include <vector>

#include "Kernel/Features/RigidBodies/MassProperties.h"
#include "Kernel/Features/Superquadrics/Superquadric.h"

namespace pendular {

/// Balls (m, in the axes of the superquadric) that hold all of it, and little besides: where it must find
/// room among others, and one sphere around it takes too much. The superquadric is cut by planes across its
/// axes, and each ball is around one piece; of all cuts into at most 48 pieces, the one whose balls fill the
/// least volume, but one ball more must save 1 % of it.
std::vector<Ball> coveringBalls(const Superquadric& shape);

}  // namespace pendular
