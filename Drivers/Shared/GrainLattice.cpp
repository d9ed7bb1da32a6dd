#include "Drivers/Shared/GrainLattice.h"

namespace pendular {

std::vector<Vec3D> latticeCells(const Vec3D& lowest, const Vec3D& highest, double edge,
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

GrainRow jittered(double radius, const Vec3D& centre, UniformRandom& random) {
    const auto shift = [&] { return random.uniform(-0.04 * radius, 0.04 * radius); };
    const double x = shift(), y = shift();
    return {radius, centre + Vec3D(x, y, shift())};
}

}  // namespace pendular
