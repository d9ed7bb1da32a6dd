#pragma once

#include <gtest/gtest.h>

#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

namespace pendular::scenes {

/// The distances (m) of a pair and of a grain and a plane at the start: negative overlaps, or gaps.
struct StartGaps {
    double pair, plane;
};

/// Adds a sphere to a scene.
template <class Scene>
void addSphere(Scene& scene, const SuperquadricMotion& motion) {
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    grain.setRadius(motion.shape.a);
    grain.setPosition(motion.position), grain.setVelocity(motion.velocity);
    grain.setAngularVelocity(motion.spin);
    scene.particleHandler.copyAndAddObject(grain);
}

/// Two grains that are round, of radii of 1 and 1.5 mm, in oblique motion.
inline std::vector<SuperquadricMotion> twoRoundGrains(double gap) {
    constexpr double r = 1e-3;
    return {{{r, r, r}, {0, 0, 0}, {0.1, 0.05, -0.02}, {30, -20, 10}},
            {{1.5 * r, 1.5 * r, 1.5 * r},
             (2.5 * r + gap) * Vec3D(0.6, 0, 0.8),
             {-0.2, 0.1, 0},
             {-10, 40, 25},
             Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Vec3D(1, 2, 3).normalized()))}};
}

/// Two scenes, in each of which a grain acts on another one and on a plane, that have begun: their forces and
/// motions are the same to 1e-12.
///
/// Depths are round-off of the radius, 2^-53 r, so those of 1 % of it are right to 1e-14, and forces to some
/// tens of that; of gaps of a thousandth, to ten times more. Springs are turned with the change of the
/// normal, by the sphere kernel with its velocity: that differs by a dt^2 / 2 r = 2e-8 rad in a step (a =
/// 3000 m/s^2), and springs, which are kept in the tangential plane, by its square.
template <class Spheres, class Shapes>
void expectSameForces(Spheres& spheres, Shapes& shapes, int steps) {
    double largest = 0;  // N
    for (int k = 0; k < steps; ++k) {
        const auto expected = spheres.interactions(), found = shapes.interactions();
        ASSERT_EQ(expected.size(), 2u) << k;
        ASSERT_EQ(found.size(), 2u) << k;
        for (std::size_t c = 0; c < 2; ++c) {
            largest = std::max(largest, norm(expected[c].force));
            EXPECT_LT(norm(found[c].force - expected[c].force), 1e-12 * largest) << k;
            EXPECT_NEAR(found[c].adhesiveForce, expected[c].adhesiveForce, 1e-12 * largest) << k;
            EXPECT_NEAR(found[c].overlap(), expected[c].overlap(), 1e-18) << k;
        }
        for (std::size_t g = 0; g < 2; ++g) {
            const auto one = spheres.particleHandler.getObject(g), two = shapes.particleHandler.getObject(g);
            EXPECT_LT((one.getVelocity() - two.getVelocity()).norm(), 1e-12 * one.getVelocity().norm()) << k;
            EXPECT_LT((one.getAngularVelocity() - two.getAngularVelocity()).norm(),
                      1e-12 * one.getAngularVelocity().norm())
                << k;
        }
        spheres.step(), shapes.step();
    }
}

/// Begins with a plane below the first grain.
template <class Scene>
void beginAtPlane(Scene& scene, const StartGaps& gaps, bool joins) {
    InfiniteWall wall;
    wall.setSpecies(scene.speciesHandler.getObject(0));
    wall.set({0, 0, -1}, {0, 0, -1e-3 - gaps.plane});
    scene.wallHandler.copyAndAddObject(wall);
    if (joins) scene.joinAtStart(2 * std::max(gaps.pair, gaps.plane));
    scene.initialise();
}

/// Superquadrics of three equal half lengths have the forces and motions of the sphere kernel.
template <class S>
void expectForcesOfSpheres(const S& material, const StartGaps& gaps, double step, int steps) {
    const auto grains = twoRoundGrains(gaps.pair);
    FewGrains<S> spheres(material, {}, step);
    for (const SuperquadricMotion& motion : grains) addSphere(spheres, motion);
    FewSuperquadrics<S> shapes(material, grains, step);
    bool joins = false;
    if constexpr (S::Adhesion::acts) joins = S::Adhesion::formsAtContact && gaps.pair > 0;
    beginAtPlane(spheres, gaps, joins), beginAtPlane(shapes, gaps, joins);
    expectSameForces(spheres, shapes, steps);
}

}  // namespace pendular::scenes
