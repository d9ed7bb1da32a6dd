#include <gtest/gtest.h>

#include "Kernel/Core/Walls/InfiniteWall.h"
#include "SelfTests/Support/AnyMaterial.h"
#include "SelfTests/Support/EveryLaw.h"
#include "SelfTests/Walls/WallScene.h"

namespace pendular::largeSphereTest {
namespace {

using namespace wallTests;
using scenes::GrainMotion;

const support::MaterialScale scale{density, youngModulus, poissonRatio, 500, mass()};

/// R* and the bridge's R of a contact with a sphere of 1000 R are smaller by 1/1000, and forces with them by
/// half (Hertz) to the whole of it (bridge); so are the velocities that a bounce gives.
TEST(LargeSphere, ofAThousandRadiiIsAlmostAWallForAllLaws) {
    support::forRepresentativeSpecies([]<class S>() {
        SCOPED_TRACE(S::name);
        const S species = support::anyMaterial<S>(scale);
        const GrainMotion grain{.radius = radius,
                                .position = {0, 0, 1.003e-3},
                                .velocity = {0.1, -0.05, -0.3},
                                .spin = {90, 200, -70}};
        const auto bounced = [&](auto&& addWall, bool isSphere, double large) {
            std::vector<GrainMotion> grains{grain};
            if (isSphere) grains.push_back({.radius = large, .position = {0, 0, -large}, .fixed = true});
            WallScene<S> scene(grains, species);
            scene.acceptUnstableTimeStep();  // two such spheres need not be thought of
            addWall(scene);
            // Both get this integrator: by itself only the scene with a wall would take it, where springs
            // lack dashpots.
            scene.setIntegrator(integrators::springsInStep);
            scene.initialise();
            scene.steps(200);
            return scene.motion(0);
        };
        const auto plane = bounced(
            [](auto& scene) {
                InfiniteWall wall;
                wall.set({0, 0, -1}, {0, 0, 0});
                scene.add(wall);
            },
            false, 0);
        const auto faces = bounced(
            [](auto& scene) {
                scene.add(mesh(parallelogram(at(-0.01, -0.01, 0), at(0.02, 0, 0), at(0, 0.02, 0), 4, 4)));
            },
            false, 0);
        ASSERT_GT(plane.velocity.z(), 0);
        EXPECT_LT((plane.velocity - faces.velocity).norm(), 1e-13);
        double last = infinity;
        for (double ratio : {1e3, 1e4}) {
            const auto sphere = bounced([](auto&) {}, true, ratio * radius);
            const double difference = (sphere.velocity - plane.velocity).norm();
            EXPECT_LT(difference, 5 * 0.3 / ratio);
            EXPECT_LT((sphere.spin - plane.spin).norm(), 5 * 0.3 / radius / ratio);
            EXPECT_LT(difference, 0.2 * last + 1e-8);
            last = difference;
        }
    });
}

}  // namespace
}  // namespace pendular::largeSphereTest
