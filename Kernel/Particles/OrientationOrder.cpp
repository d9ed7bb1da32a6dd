#include "Kernel/Particles/OrientationOrder.h"

#include <Eigen/Eigenvalues>
#include <vector>

#include "Kernel/Math/EigenConversion.h"

namespace pendular {

OrientationOrder orientationOrder(std::span<const Vec3D> axes) {
    if (axes.empty()) return {};
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Vec3D& axis : axes) sum += axis * axis.transpose();
    const Eigen::Matrix3d mean =
        1.5 / static_cast<double>(axes.size()) * sum - 0.5 * Eigen::Matrix3d::Identity();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(mean);
    return {solver.eigenvalues()[2], solver.eigenvectors().col(2), axes.size()};
}

std::optional<int> axisOf(const Vector<double>& moments) {
    const double below = moments.y - moments.x, above = moments.z - moments.y;
    if (!(below + above > 1e-6 * moments.z)) return std::nullopt;
    return below >= above ? 0 : 2;
}

OrientationOrder orientationOrder(const RigidBodies& bodies, std::size_t first) {
    std::vector<Vec3D> axes;
    for (std::size_t k = first; k < bodies.size(); ++k)
        if (const auto axis = axisOf(bodies[k].inertia))
            axes.push_back(toEigen(
                bodies[k].orientation.turn(*axis == 0 ? Vector<double>{1, 0, 0} : Vector<double>{0, 0, 1})));
    return orientationOrder(axes);
}

}  // namespace pendular
