#pragma once

#include "Kernel/Features/RigidBodies/MassProperties.h"
#include "Kernel/Features/RigidBodies/RigidBodies.h"
#include "Kernel/Features/Superquadrics/SuperquadricGrain.h"

namespace pendular {

/// The rigid body that a grain with a shape is, without its largestFreeMass. The axes of the shape are the
/// principal ones: no search for them, which might change their order.
/// @param solid of the shape, of density 1; @param density kg/m^3
[[nodiscard]] RigidBody bodyOf(const ShapedGrain& grain, const MassProperties& solid, double density);
/// That of a superquadric. @param turning of its extreme contact (ExtremeContact.h)
[[nodiscard]] RigidBody bodyOf(const SuperquadricGrain& grain, double density, double turning);

}  // namespace pendular
