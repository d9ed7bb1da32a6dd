#pragma once

#include <functional>
#include <vector>

#include "Kernel/Math/Random.h"
#include "Kernel/Particles/GrainFile.h"

namespace pendular {

/// The centres of cubic cells that stand side by side in a box, layer by layer from below; what is left over
/// of the box is shared by its sides.
/// @param edge m, of a cell; @param fits whether a cell with this centre is wanted
inline std::vector<Vec3D> latticeCells(const Vec3D& lowest, const Vec3D& highest, double edge,
                                       const std::function<bool(const Vec3D&)>& fits) {
    const Eigen::Array3d count = ((highest - lowest).array() / edge).floor();
    const Vec3D first = 0.5 * (lowest + highest) - 0.5 * edge * (count - 1).matrix();
    std::vector<Vec3D> cells;
    for (int z = 0; z < count.z(); ++z)
        for (int y = 0; y < count.y(); ++y)
            for (int x = 0; x < count.x(); ++x) {
                const Vec3D centre(first.x() + edge * x, first.y() + edge * y, lowest.z() + edge * (z + 0.5));
                if (fits(centre)) cells.push_back(centre);
            }
    return cells;
}

/// Of a cell's edge against the diameter of the grain in it; grains are displaced by up to 0.04 radii along
/// each axis, so that no two of them touch and none leaves its cell.
inline constexpr double latticeLooseness = 1.05;

inline GrainRow jittered(double radius, const Vec3D& centre, UniformRandom& random) {
    const auto shift = [&] { return random.uniform(-0.04 * radius, 0.04 * radius); };
    const double x = shift(), y = shift();
    return {radius, centre + Vec3D(x, y, shift())};
}

}  // namespace pendular
