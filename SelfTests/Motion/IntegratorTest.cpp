#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Motion/Integrator.h"
#include "Kernel/Simulation/Simulation.h"
#include "Kernel/Species/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"

namespace pendular {
namespace {

using Linear = Species<LinearViscoelastic>;
using scenes::FewGrains;

constexpr double radius = 1e-3, stiffness = 1e3, density = 2500;  // m, N/m, kg/m^3

Linear elastic() {
    Linear species;
    species.setDensity(density);
    species.setStiffness(stiffness);
    species.setDissipation(0);
    return species;
}

TEST(Integrator, weightsOfEachPartAddUp) {
    for (const Integrator& scheme : integrators::all) {
        // Exact for a constant acceleration: h^2/2 of it in the position, h in the velocity.
        EXPECT_NEAR(scheme.position0 + scheme.position1, 0.5, 1e-15) << scheme.name;
        EXPECT_NEAR(
            scheme.velocity0 + scheme.velocity1 + scheme.corrector * (1 - scheme.now + scheme.earlier), 1,
            1e-15)
            << scheme.name;
    }
}

TEST(Integrator, freeFallIsExact) {
    for (const Integrator& scheme : integrators::all) {
        FewGrains<Linear> scene(elastic(), {{.radius = radius, .velocity = {1, 0, 2}}}, 5e-5);
        scene.setGravity({0, 0, -9.81});
        scene.setIntegrator(scheme);
        scene.run(100);
        const auto grain = scene.motion(0);
        EXPECT_NEAR(grain.velocity.z(), 2 - 9.81 * 0.005, 100 * 4e-16) << scheme.name;
        EXPECT_NEAR(grain.position.z(), 0.01 - 0.5 * 9.81 * 0.005 * 0.005, 100 * 4e-18) << scheme.name;
        EXPECT_NEAR(grain.position.x(), 0.005, 100 * 4e-18) << scheme.name;
    }
}

/// How far from cos(w t) two grains are that are pressed together and released, after an eighth of a period,
/// as a share of the overlap.
double errorOfOscillation(const Integrator& scheme, int steps) {
    const double overlap = 1e-6;
    const double mass = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
    const double frequency = std::sqrt(2 * stiffness / mass);
    const double x = radius - 0.5 * overlap;
    FewGrains<Linear> scene(
        elastic(), {{.radius = radius, .position = {-x, 0, 0}}, {.radius = radius, .position = {x, 0, 0}}},
        0.25 * std::numbers::pi / frequency / steps);
    scene.setIntegrator(scheme);
    scene.run(steps);
    const double now = 2 * radius - (scene.motion(1).position - scene.motion(0).position).norm();
    return std::abs(now / overlap - std::sqrt(0.5));
}

TEST(Integrator, hasItsOrderInAnOscillation) {
    // From rest, where the acceleration has no slope, the higher one starts with its own order. Round-off of
    // 1e-19 m against overlaps of 1e-6 m is far below the smallest error, 1e-7.
    for (const Integrator& scheme : integrators::all) {
        const double order = scheme == integrators::adamsMoulton ? 3 : 2;
        const double coarse = errorOfOscillation(scheme, 20), fine = errorOfOscillation(scheme, 40);
        EXPECT_NEAR(std::log2(coarse / fine), order, 0.2) << scheme.name << ' ' << coarse;
    }
}

}  // namespace
}  // namespace pendular
