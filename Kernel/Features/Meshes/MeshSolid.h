#pragma once

#include <array>
#include <span>

#include "Kernel/Features/RigidBodies/MassProperties.h"
#include "Kernel/Foundation/Math/EigenConversion.h"

namespace pendular {

using CornersOfTriangle = std::array<Vector<double>, 3>;  // m

/// Volume, centre and inertia of what a closed mesh holds, by the divergence theorem: the sum over the
/// tetrahedra that its triangles p, q, r make with a point, with signs; each has det/6 of volume and
/// (det/120) (p p + q q + r r + s s) of the second moments, s = p + q + r. Exact but for round-off: the point
/// is the mean of the corners. Whether the mesh is closed is not looked at: MeshRegion refuses one that is
/// not.
/// @param triangles counter-clockwise from outside; if they are clockwise, all of them, it does not matter
inline MassProperties massOfMesh(std::span<const CornersOfTriangle> triangles) {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    for (const CornersOfTriangle& t : triangles)
        for (const Vector<double>& p : t)
            origin += toEigen(p) / (3.0 * static_cast<double>(triangles.size()));
    double volume = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const CornersOfTriangle& t : triangles) {
        const Eigen::Vector3d p = toEigen(t[0]) - origin, q = toEigen(t[1]) - origin,
                              r = toEigen(t[2]) - origin;
        const double determinant = p.dot(q.cross(r));
        const Eigen::Vector3d s = p + q + r;
        volume += determinant / 6;
        first += determinant / 24 * s;
        second += determinant / 120 *
                  (p * p.transpose() + q * q.transpose() + r * r.transpose() + s * s.transpose());
    }
    if (volume < 0) volume = -volume, first = -first, second = -second;
    MassProperties result = MassProperties::fromMoments(volume, first, second);
    result.centre += origin;
    result.error = 1e-13;  // of round-off
    return result;
}

/// m^2
inline double areaOfMesh(std::span<const CornersOfTriangle> triangles) {
    double sum = 0;
    for (const CornersOfTriangle& t : triangles) sum += 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
    return sum;
}

}  // namespace pendular
