#pragma once

#include <vector>

#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::periodic {

/// Two grains that meet obliquely at a place (m), and are carried along (m/s); 1 mm is the radius of the
/// first.
inline std::vector<scenes::GrainMotion> obliquePair(const Vec3D& place,
                                                    const Vec3D& carried = Vec3D::Zero()) {
    constexpr double r = 1e-3;
    const Vec3D normal = Vec3D(2, -3, 4).normalized(), sideways(0.3, 0.5, 0.2);
    return {{.radius = r,
             .position = place - 1.01 * r * normal,
             .velocity = carried + 0.25 * normal + sideways,
             .spin = {90, 200, -70}},
            {.radius = 0.8 * r,
             .position = place + 0.81 * r * normal,
             .velocity = carried - 0.25 * normal,
             .spin = {-20, 40, 30}}};
}

}  // namespace pendular::periodic
