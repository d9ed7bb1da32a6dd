#pragma once

#include "Kernel/Core/Step/StepContext.h"

namespace pendular {

/// Throws InputError where gravity, shear or strain would move grains along axes along which all of them are
/// held (ParticleHandler::holdAll()).
void refuseOutOfPlane(const StepContext& scene);

/// Throws InputError where grains are discs and the scene has what is made for spheres: other bodies, liquid,
/// inlets, contacts that predict their own force; or where they are not held in the plane of x and y.
void refuseForDiscs(const StepContext& scene);

}  // namespace pendular
