#pragma once

#include "Kernel/Core/Particles/ParticleHandler.h"

namespace pendular {

/// Throws InputError where grains that are held in the plane of x and y are not all at one height: what is
/// not in one plane would meet by its distance in space, and never feel it.
void requireOnePlane(ParticleHandler& particles);

}  // namespace pendular
