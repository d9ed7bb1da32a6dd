#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"

// Springs of friction without dashpots, which springs kept half a step ahead would feed: the default
// integrator moves them in the step. Set-up warns where dashpots are only too weak for the step.

namespace pendular::fedSpringsTest {
namespace {

using S = Species<LinearViscoelastic, SlidingFriction>;

constexpr double radius = 1e-3, density = 2500, stiffness = 1000;  // m, kg/m^3, N/m, the tangential one

S material(double dissipation) {
    S species;
    species.setDensity(density);
    species.setStiffnessAndRestitutionCoefficient(stiffness, 0.5, sphereMass(radius, density));
    species.setSlidingStiffness(stiffness);
    species.setSlidingDissipation(dissipation);
    species.setSlidingFrictionCoefficient(0.5);
    return species;
}

struct Row : scenes::FewGrains<S> {
    Row(double dissipation, double step, double distance = 0.003)
        : FewGrains(material(dissipation),
                    {{.radius = radius, .position = {0, 0, 0}},
                     {.radius = radius, .position = {distance, 0, 0}, .spin = {0, 0, 10}},
                     {.radius = radius, .position = {2 * distance, 0, 0}}},
                    step) {}
    /// What set-up says on standard error.
    std::string warning() {
        testing::internal::CaptureStderr();
        initialise();
        return testing::internal::GetCapturedStderr();
    }
    std::uint64_t hashAfter(const Integrator& integrator) {
        setIntegrator(integrator);
        setQuiet();
        run(200);
        return stateHash(particleHandler.store());
    }
};

// In a row of three each has two contacts, w^2 = 2.8 (5/2) k / m* with m* = m / 2.
double frequency() { return std::sqrt(2.8 * 2.5 * stiffness / (0.5 * sphereMass(radius, density))); }
// kg/s, the dashpot at which springs that are kept ahead are no more fed at h w = 0.42: g/k = h (h w)^2 / 4.
double leastDashpot() { return 0.25 * std::pow(0.42, 3) * stiffness / frequency(); }

TEST(FedSprings, ofUsualSpeciesNeedNoWarning) {
    const double step = 0.5 * Row(0, 1).stabilityLimit();
    EXPECT_EQ(Row(0, step).warning(), "");
    Row absurd(0, 40 * step);
    absurd.acceptUnstableTimeStep();
    EXPECT_EQ(absurd.warning(), "");
}

// Without dashpots the limit is that of velocity Verlet: springs of two contacts, 2.8 (5/2) k / m*, turn
// grains, (2 + 2.8) k / m* shift them, with a dashpot g of the second contact: (h w)^2 / 4 + h g / m* = 1.
TEST(FedSprings, allowTheStepOfVelocityVerlet) {
    const double pair2 = stiffness / (0.5 * sphereMass(radius, density)), logarithm = std::log(0.5);
    const double rate = 2 * std::sqrt(pair2) * -logarithm / std::hypot(logarithm, std::numbers::pi);
    const double shift = 2 / (rate + std::sqrt(rate * rate + 4.8 * pair2));
    EXPECT_NEAR(Row(0, 1).stabilityLimit(), stabilityMargin * std::min(2 / frequency(), shift), 1e-12);
    EXPECT_LT(Row(1.02 * leastDashpot(), 1).stabilityLimit() * frequency(), 0.43);
}

// The dashpot of the motion takes a share h w^2 g / (2 k) a step, and (h w)^4 / 8 is fed: at three times the
// step that balances them, the latter is 27 times the former.
TEST(FedSprings, areWarnedOfWhereTheStepIsTooLongForTheirDashpots) {
    const double dissipation = 1.02 * leastDashpot(), step = 0.4 / frequency();
    EXPECT_EQ(Row(dissipation, step * 0.9).warning(), "");
    Row longer(dissipation, 3 * step);
    longer.acceptUnstableTimeStep();
    const std::string warning = longer.warning();
    EXPECT_TRUE(support::contains(warning, "SlidingFriction"));
    EXPECT_TRUE(support::contains(warning, " steps;"));
    EXPECT_TRUE(support::contains(warning, "integrators::springsInStep"));
    const double squared = std::pow(3 * step * frequency(), 2);
    EXPECT_NEAR(
        stepsToDouble<S::Mixed>(material(dissipation), {radius, radius}, 0.5 * sphereMass(radius, density),
                                integrators::predictedVelocityVerlet, 2, 3 * step) *
            (squared * squared / 8 - 0.5 * squared * dissipation / stiffness / (3 * step)),
        std::numbers::ln2, 1e-9);
}

// With a rigid body springs stay ahead, and the advice is what a scene with bodies takes.
TEST(FedSprings, areWarnedOfWithARigidBody) {
    Row row(0, 0.4 / frequency());
    row.bodyHandler.join({0});
    row.acceptUnstableTimeStep();
    const std::string warning = row.warning();
    EXPECT_TRUE(support::contains(warning, "larger dissipation"));
    EXPECT_TRUE(support::contains(warning, "integrators::springsInStep or velocityVerlet"));
    Row verlet(0, 0.4 / frequency());
    verlet.bodyHandler.join({0});
    verlet.setIntegrator(integrators::velocityVerlet);
    EXPECT_EQ(verlet.warning(), "");
}

TEST(FedSprings, areMovedInTheStepWhereDashpotsLackAndElseKeepTheirBits) {
    const double near = 1.99 * radius, step = 1e-6;
    const auto hash = [&](double dissipation, const Integrator& integrator) {
        return Row(dissipation, step, near).hashAfter(integrator);
    };
    const Integrator &standard = integrators::predictedVelocityVerlet, &inStep = integrators::springsInStep;
    EXPECT_EQ(hash(0, standard), hash(0, inStep));
    EXPECT_EQ(hash(0.98 * leastDashpot(), standard), hash(0.98 * leastDashpot(), inStep));
    EXPECT_NE(hash(1.02 * leastDashpot(), standard), hash(1.02 * leastDashpot(), inStep));
}

// A pair follows the trapezoidal rule by its own forces, which feeds nothing.
TEST(FedSprings, areNotUnderVelocityVerletNorInPairs) {
    Row verlet(0, 1e-6);
    verlet.setIntegrator(integrators::velocityVerlet);
    EXPECT_EQ(verlet.warning(), "");
    EXPECT_FALSE(lacksDashpots<S::Mixed>(material(0), {radius, radius}, 1e-6,
                                         integrators::predictedVelocityVerlet, 1));
    EXPECT_TRUE(lacksDashpots<S::Mixed>(material(0), {radius, radius}, 1e-6,
                                        integrators::predictedVelocityVerlet, 2));
}

}  // namespace
}  // namespace pendular::fedSpringsTest
