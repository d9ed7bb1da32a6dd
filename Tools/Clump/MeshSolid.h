#pragma once

#include <span>

#include "Kernel/Insertion/MeshRegion.h"
#include "Kernel/Shapes/MassProperties.h"

namespace pendular::clump {

/// Volume, centre and inertia of what a closed mesh holds, by the divergence theorem: the sum over the
/// tetrahedra that its triangles p, q, r make with a point, with signs; each has det/6 of volume and
/// (det/120) (p p + q q + r r + s s) of the second moments, s = p + q + r. Exact but for round-off: the point
/// is the mean of the corners.
/// @param triangles counter-clockwise from outside; if they are clockwise, all of them, it does not matter
inline MassProperties massOfMesh(std::span<const Triangle> triangles) {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    for (const Triangle& t : triangles)
        for (const Vector<double>& p : t)
            origin += toEigen(p) / (3.0 * static_cast<double>(triangles.size()));
    double volume = 0;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (const Triangle& t : triangles) {
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
inline double areaOfMesh(std::span<const Triangle> triangles) {
    double sum = 0;
    for (const Triangle& t : triangles) sum += 0.5 * norm(cross(t[1] - t[0], t[2] - t[0]));
    return sum;
}

/// m, from a point to the nearest point of a triangle. Source: Ericson, Real-Time Collision Detection (2005),
/// section 5.1.5: by the region of the plane that the point lies over.
inline double distanceTo(const Triangle& t, const Vector<double>& p) {
    const Vector<double> ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp);
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return norm(ap);
    if (d3 >= 0 && d4 <= d3) return norm(bp);
    if (d6 >= 0 && d5 <= d6) return norm(cp);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return norm(ap - (d1 / (d1 - d3)) * ab);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return norm(ap - (d2 / (d2 - d6)) * ac);
    if (va <= 0 && d4 >= d3 && d5 >= d6)
        return norm(bp - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]));
    const double scale = 1 / (va + vb + vc);
    return norm(ap - (vb * scale) * ab - (vc * scale) * ac);
}

}  // namespace pendular::clump
