#include "Kernel/Features/RigidBodies/OrientationOrder.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"

namespace pendular {

OrientationOrder orientationOrder(std::span<const Vec3D> axes) {
    if (axes.empty()) return {};
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Vec3D& axis : axes) sum += axis * axis.transpose();
    const Eigen::Matrix3d mean =
        1.5 / static_cast<double>(axes.size()) * sum - 0.5 * Eigen::Matrix3d::Identity();
    const EigenSystem system = eigenSystem(mean);
    return {system.values[2], system.vectors.col(2), axes.size()};
}

std::optional<int> axisOf(const Vector<double>& moments) {
    std::array<std::pair<double, int>, 3> m{{{moments.x, 0}, {moments.y, 1}, {moments.z, 2}}};
    std::ranges::sort(m);
    const double below = m[1].first - m[0].first, above = m[2].first - m[1].first;
    if (!(below + above > 1e-6 * m[2].first)) return std::nullopt;
    return (below >= above ? m[0] : m[2]).second;
}

OrientationOrder orientationOrder(const RigidBodies& bodies, std::size_t first) {
    std::vector<Vec3D> axes;
    for (std::size_t k = first; k < bodies.size(); ++k)
        if (const auto axis = axisOf(bodies[k].inertia))
            axes.push_back(toEigen(bodies[k].orientation.turn(
                {*axis == 0 ? 1.0 : 0.0, *axis == 1 ? 1.0 : 0.0, *axis == 2 ? 1.0 : 0.0})));
    return orientationOrder(axes);
}

}  // namespace pendular
