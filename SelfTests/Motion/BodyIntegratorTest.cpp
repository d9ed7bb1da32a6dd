#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Energy/OpenAccount.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/TestFolder.h"

// Rigid bodies with integrators that remember the last step, or move springs in it.

namespace pendular::bodyIntegratorTest {
namespace {

using scenes::FewGrains;
using scenes::SettlingBox;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;

constexpr double r = 1e-3, density = 2500, k = 1000;  // m, kg/m^3, N/m
const double m = 4.0 / 3 * std::numbers::pi * r * r * r * density;

Smooth smooth(double dissipation = 0) {
    Smooth s;
    s.setDensity(density);
    s.setStiffness(k);
    s.setDissipation(dissipation);
    return s;
}
Rough rough() {
    Rough s;
    s.setDensity(density);
    s.setStiffness(k);
    s.setDissipation(0.002);
    s.setSlidingStiffness(300);
    s.setSlidingDissipation(0.001);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}
double orderOf(const Integrator& scheme) { return scheme == integrators::adamsMoulton ? 3 : 2; }

/// How far (m) the height of a dimer that lies on a plane is from the closed form after an eighth of a
/// period: M z'' = -2 (k (z - z0) + c z'), started so that z''' = 0 and the step before the first does not
/// count.
double errorOnPlane(const Integrator& scheme, int steps) {
    const double c = 0.1 * std::sqrt(k * m), w2 = k / m, g = 0.5 * c / m;  // 2 k/M, half of 2 c/M
    const double wd = std::sqrt(w2 - g * g), depth = 1e-6;
    // z = e^-gt (A cos + B sin); z''' = 0 at 0: v = -2 g a / w2, a = -w2 x - 2 g v
    const double x = -depth, a = -w2 * x / (1 - 4 * g * g / w2), v = -2 * g * a / w2;
    const double time = 0.25 * std::numbers::pi / wd;
    FewGrains<Smooth> scene(smooth(c),
                            {{.radius = r, .position = {-r, 0, r + x}, .velocity = {0, 0, v}},
                             {.radius = r, .position = {r, 0, r + x}, .velocity = {0, 0, v}}},
                            time / steps, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setIntegrator(scheme);
    scene.acceptUnstableTimeStep();
    const BodyReference body = scene.bodyHandler.join({0, 1});
    scene.run(steps);
    const double exact =
        std::exp(-g * time) * (x * std::cos(wd * time) + (v + g * x) / wd * std::sin(wd * time));
    return std::abs(body.getPosition().z() - r - exact) / depth;
}

TEST(BodyIntegrator, hasItsOrderForADampedDimerOnAPlane) {
    for (const Integrator& scheme : {integrators::adamsMoulton, integrators::springsInStep}) {
        const double coarse = errorOnPlane(scheme, 20), fine = errorOnPlane(scheme, 40);
        EXPECT_NEAR(std::log2(coarse / fine), orderOf(scheme), 0.3) << scheme.name << ' ' << coarse;
        // The one of third order errs by some (w h)^3 / 8 of the depth, others by (w h)^2 / 12.
        EXPECT_LT(coarse, scheme == integrators::adamsMoulton ? 2e-5 : 5e-4);
    }
}

/// A dimer on two held spheres turns as I q'' = -2 k a^2 q (see HeldAxesTest); the error of q / q(0).
double errorOfTurning(const Integrator& scheme, int steps) {
    constexpr double d = 1e-5, q = 1e-6;
    const double inertia = 2.8 * m * r * r, frequency = std::sqrt(2 * k * r * r / inertia);
    const Vec3D arm(r * std::cos(q), 0, r * std::sin(q));
    FewGrains<Smooth> scene(smooth(),
                            {{.radius = r, .position = -arm},
                             {.radius = r, .position = arm},
                             {.radius = r, .position = {-r, 0, d - 2 * r}, .fixed = true},
                             {.radius = r, .position = {r, 0, d - 2 * r}, .fixed = true}},
                            0.25 * std::numbers::pi / frequency / steps);
    scene.setIntegrator(scheme);
    scene.acceptUnstableTimeStep();
    scene.bodyHandler.join({0, 1}).setHeldAxes({.x = true, .y = true, .z = true});
    scene.run(steps);
    const Vec3D along = scene.motion(1).position - scene.motion(0).position;
    return std::abs(std::atan2(along.z(), along.x()) / q - std::sqrt(0.5));
}

TEST(BodyIntegrator, hasItsOrderInATurningOscillation) {
    // Beside terms of second order in q and d/r, of 1e-6.
    for (const Integrator& scheme : {integrators::adamsMoulton, integrators::springsInStep}) {
        const double coarse = errorOfTurning(scheme, 8), fine = errorOfTurning(scheme, 16);
        EXPECT_NEAR(std::log2(coarse / fine), orderOf(scheme), 0.3) << scheme.name << ' ' << coarse;
    }
}

// A free top of the moments of a dimer and one more grain: the spin about its axes returns after a period,
// found here with steps of a twentieth.
TEST(BodyIntegrator, freeFlightIsExactAndATopTurnsToFourthOrder) {
    const auto flown = [](const Integrator& scheme, int steps) {
        FewGrains<Smooth> scene(smooth(),
                                {{.radius = r, .position = {0, 0, 0}},
                                 {.radius = r, .position = {2 * r, 0, 0}},
                                 {.radius = 0.7 * r, .position = {0, 1.7 * r, 0}}},
                                0.05 / steps);
        scene.setIntegrator(scheme);
        scene.acceptUnstableTimeStep();
        scene.setGravity({0, 0, -10});
        BodyReference body = scene.bodyHandler.join({0, 1, 2});
        body.setAngularVelocity({50, 40, 60});
        const Vec3D start = body.getPosition(), turning = body.getAngularMomentum();
        scene.run(steps);
        EXPECT_NEAR((body.getPosition() - start).z(), -0.5 * 10 * 0.05 * 0.05, steps * 4e-18);
        EXPECT_LT((body.getAngularMomentum() - turning).norm(), steps * 0x1p-53 * turning.norm());
        return body.getOrientation();
    };
    const Eigen::Quaterniond exact = flown(integrators::adamsMoulton, 4000);
    const double coarse = flown(integrators::adamsMoulton, 100).angularDistance(exact),
                 fine = flown(integrators::adamsMoulton, 200).angularDistance(exact);
    EXPECT_NEAR(std::log2(coarse / fine), 4, 0.3) << coarse;
    const double second = flown(integrators::springsInStep, 200).angularDistance(exact);
    EXPECT_GT(second, 10 * fine);
    EXPECT_LT(second, 1e-3);
}

// A dimer that does not turn sticks on a plane by two springs of friction without dashpots: M x'' = -2 k_t x,
// of which the default feeds the motion, and springs in the step do not.
TEST(BodyIntegrator, springsInTheStepDoNotFeedABody) {
    constexpr double depth = 1e-5, kt = 300, v = 1e-4;
    const double w = std::sqrt(kt / m);
    const auto largest = [&](const Integrator& scheme) {
        Rough s = rough();
        s.setDissipation(0), s.setSlidingDissipation(0), s.setSlidingFrictionCoefficient(1);
        FewGrains<Rough> scene(s,
                               {{.radius = r, .position = {-r, 0, r - depth}, .velocity = {v, 0, 0}},
                                {.radius = r, .position = {r, 0, r - depth}, .velocity = {v, 0, 0}}},
                               0.3 / w, {{{0, 0, -1}, {0, 0, 0}}});
        scene.setQuiet();
        scene.setIntegrator(scheme);
        scene.acceptUnstableTimeStep();
        BodyReference body = scene.bodyHandler.join({0, 1});
        body.setHeldAxes({.z = true, .aboutX = true, .aboutY = true, .aboutZ = true});
        scene.initialise();
        double most = 0;  // of the last period of 21 steps
        for (int n = 0; n < 2000; ++n) {
            scene.step();
            if (n >= 1975) most = std::max(most, std::abs(body.getVelocity().x()));
        }
        return most / v;
    };
    // (w h)^4 / 8 a step is 0.1 %: it would double in 700 steps. Verlet keeps the amplitude to (w h)^2 / 8.
    EXPECT_NEAR(largest(integrators::springsInStep), 1, 0.02);
    EXPECT_GT(largest(integrators::predictedVelocityVerlet), 2);
}

/// A box in which grains are joined, some of them in the run.
struct BoxOfBodies : SettlingBox<Rough> {
    explicit BoxOfBodies(const Integrator& scheme, int threads = 1) : SettlingBox<Rough>(4) {
        setNumberOfThreads(threads);
        setTimeStep(0x1p-20);
        setIntegrator(scheme);
        keepEnergyLedger();
        acceptUnstableTimeStep();
    }
    void setupInitialConditions() override {
        for (std::uint32_t n = 0; n + 10 < particleHandler.getSize(); n += 5) {
            bodyHandler.join({n, n + 1});
            if (n % 10 == 0) bodyHandler.join({n + 2});
        }
    }
    void steps(int count) {
        for (int n = 0; n < count; ++n) {
            if (getNumberOfTimeSteps() == 700) bodyHandler.join({3, 4});
            if (getNumberOfTimeSteps() == 900) bodyHandler.removeObject(1);
            step();
        }
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(particleHandler.store()); }
};

TEST(BodyIntegrator, givesTheSameBitsForAnyThreadsAndRestarts) {
    for (const Integrator& scheme : {integrators::adamsMoulton, integrators::springsInStep}) {
        SCOPED_TRACE(scheme.name);
        BoxOfBodies one(scheme), three(scheme, 3);
        one.initialise(), three.initialise();
        one.steps(1500), three.steps(1500);
        EXPECT_GT(one.interactions().size(), 10u);
        EXPECT_EQ(one.hash(), three.hash());
        for (const int first : {400, 800}) {
            const support::TestFolder folder;
            BoxOfBodies half(scheme);
            half.initialise();
            half.steps(first);
            half.writeRestart(folder.path() / "half.h5");
            half.steps(500);
            half.writeRestart(folder.path() / "whole.h5");
            BoxOfBodies resumed(scheme);
            resumed.restartFrom(folder.path() / "half.h5");
            resumed.initialise();
            resumed.steps(500);
            resumed.writeRestart(folder.path() / "resumed.h5");
            support::expectSameState(folder.path() / "whole.h5", folder.path() / "resumed.h5");
        }
    }
}

TEST(BodyIntegrator, closesTheLedgerThroughJoinsAndBreakage) {
    for (const Integrator& scheme : {integrators::adamsMoulton, integrators::springsInStep}) {
        BoxOfBodies scene(scheme);
        scene.initialise();
        scene.steps(650);
        const std::function<void(BoxOfBodies&)> changes[] = {
            [](BoxOfBodies& box) {
                box.bodyHandler.join({3, 4});
            },
            [](BoxOfBodies& box) { box.bodyHandler.removeObject(1); },
            [](BoxOfBodies& box) { box.bodyHandler.removeObject(0); }};
        for (const auto& change : changes)
            EXPECT_LT(energy::openness<BoxOfBodies>(scene, change, 150), 1) << scheme.name;
    }
}

}  // namespace
}  // namespace pendular::bodyIntegratorTest
