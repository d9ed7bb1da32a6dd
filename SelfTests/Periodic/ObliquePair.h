#pragma once

#include <vector>

#include "SelfTests/Periodic/MovingImages.h"
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

inline constexpr double pairSpeedTolerance = 1e-9;                              // m/s
inline constexpr double pairSpinTolerance = 2.5 / 0.8e-3 * pairSpeedTolerance;  // rad/s

/// Whether the pair has met: it approached by 0.48 m/s before.
template <class S>
bool haveMet(S& scene) {
    const Vec3D relative = againstFlow(scene, scene.motion(0)) - againstFlow(scene, scene.motion(1));
    return relative.dot(Vec3D(2, -3, 4).normalized()) < 0.25;
}

/// Against the flow, the pairs of two scenes move alike.
template <class S>
void expectPairsMoveAlike(S& scene, S& expected) {
    for (std::size_t k : {0, 1}) {
        const scenes::GrainMotion a = scene.motion(k), b = expected.motion(k);
        EXPECT_LT((againstFlow(scene, a) - againstFlow(expected, b)).norm(), pairSpeedTolerance);
        EXPECT_LT((a.spin - b.spin).norm(), pairSpinTolerance);
    }
}

}  // namespace pendular::periodic
