#include "Kernel/Features/Superquadrics/ExtremeContact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Features/Superquadrics/SuperquadricGeometry.h"
#include "Kernel/Features/Superquadrics/SuperquadricSupport.h"

namespace pendular {

ExtremeContact extremeContact(const Superquadric& shape) {
    constexpr int intervals = 64;
    const auto lanes = SuperquadricLanes<double>::from(shape);
    const MassProperties solid = shape.mass();
    const Eigen::Vector3d moments = solid.inertia.diagonal() / solid.volume;  // m^2, over the mass
    ExtremeContact most{0, 1, 0, 1};
    for (int i = 0; i <= intervals; ++i)
        for (int j = 0; j <= intervals; ++j) {
            const double down = 0.5 * std::numbers::pi * i / intervals,
                         around = 0.5 * std::numbers::pi * j / intervals;
            const Vector<double> n{std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                                   std::cos(down)};
            const SupportPoint<double> at = supportPoint(lanes, n);
            const TangentPlane<double> plane(n);
            const auto turning = [&](const Vector<double>& a, const Vector<double>& b) {
                const Vector<double> l = cross(at.point, a), k = cross(at.point, b);
                return l.x * k.x / moments.x() + l.y * k.y / moments.y() + l.z * k.z / moments.z();
            };
            most.turning = std::max(most.turning, turning(n, n));
            const double uu = turning(plane.u, plane.u), vv = turning(plane.v, plane.v);
            most.sliding =
                std::max(most.sliding, 0.5 * (uu + vv + std::hypot(uu - vv, 2 * turning(plane.u, plane.v))));
            const Curvature<double> k = curvature(at, plane.u, plane.v);
            const double mean = 0.5 * (k.uu + k.vv), largest = mean + std::hypot(0.5 * (k.uu - k.vv), k.uv);
            if (largest > 0)
                most.smallestRadius = std::min(most.smallestRadius, 1 / (largest * shape.boundingRadius()));
            most.radii = std::max(most.radii, gaussRadius(k) / shape.boundingRadius());
        }
    return {1.01 * most.turning, std::min(1.01 * most.radii, SuperquadricGeometry::mostRadii),
            1.01 * most.sliding, 0.8 * most.smallestRadius};
}

}  // namespace pendular
