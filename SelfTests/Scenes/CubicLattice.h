#pragma once

#include "Kernel/Core/Particles/SphericalParticle.h"

namespace pendular::scenes {

/// m: the middle of a cell of a cube of edge^3 cells that begins at the origin.
/// @param k number of the cell; @param edge cells; @param spacing m
inline Vec3D cellOfCube(int k, int edge, double spacing) {
    return spacing * Vec3D(k % edge + 0.5, k / edge % edge + 0.5, k / (edge * edge) + 0.5);
}

}  // namespace pendular::scenes
