#pragma once

#include "Kernel/Particles/RigidBodies.h"
#include "Kernel/Superquadrics/SuperquadricGrain.h"

namespace pendular {

/// The rigid body that a superquadric is. The axes of the shape are the principal ones: no search for them,
/// which might change their order.
/// @param density kg/m^3; @param turning of its extreme contact (ExtremeContact.h)
[[nodiscard]] RigidBody bodyOf(const SuperquadricGrain& grain, double density, double turning);

}  // namespace pendular
