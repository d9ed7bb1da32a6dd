#pragma once

#include <vector>

#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::scenes {

/// 27 grains of two sizes on a cubic lattice that fly together, each with its own velocity and spin.
/// @param radius m, of the larger ones
inline std::vector<GrainMotion> cloudOfGrains(double radius) {
    std::vector<GrainMotion> all;
    for (int k = 0; k < 27; ++k) {
        const Vec3D cell(k % 3, k / 3 % 3, k / 9);
        all.push_back({.radius = (k % 2 == 0 ? 1 : 0.7) * radius,
                       .position = 2.3 * radius * cell,
                       .velocity = 0.4 * (Vec3D(1, 1, 1) - cell) + Vec3D(0.1 * (k % 5), -0.05 * (k % 4), 0),
                       .spin = Vec3D(20.0 * (k % 3), -30, 10.0 * (k % 7))});
    }
    return all;
}

}  // namespace pendular::scenes
