#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "Kernel/Motion/StabilityLimit.h"
#include "Kernel/Species/Friction/SlidingFriction.h"
#include "Kernel/Species/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"

// Springs of friction without dashpots, which the default integrator feeds: set-up warns of them.

namespace pendular {
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
    Row(double dissipation, double step)
        : FewGrains(material(dissipation),
                    {{.radius = radius, .position = {0, 0, 0}},
                     {.radius = radius, .position = {0.003, 0, 0}},
                     {.radius = radius, .position = {0.006, 0, 0}}},
                    step) {}
    /// What set-up says on standard error.
    std::string warning() {
        testing::internal::CaptureStderr();
        initialise();
        return testing::internal::GetCapturedStderr();
    }
};

/// s: half the stability limit.
double step() { return 0.5 * Row(0, 1).stabilityLimit(); }

TEST(FedSprings, areWarnedOf) {
    const std::string warning = Row(0, step()).warning();
    EXPECT_TRUE(support::contains(warning, "SlidingFriction"));
    EXPECT_TRUE(support::contains(warning, "larger dissipation"));
}

// The share is (h w)^4 / 8 a step: ln 2 at 1.53 / w, and 0.9 x 0.42 / w is the stability limit.
TEST(FedSprings, thatDoubleInAStepAreCalledSo) {
    Row absurd(0, 20 * step());
    absurd.acceptUnstableTimeStep();
    EXPECT_TRUE(support::contains(absurd.warning(), "may double in less than one step;"));
    EXPECT_TRUE(support::contains(Row(0, step()).warning(), " steps;"));
}

// (h w)^2 g / (2 k) a step against (h w)^4 / 8: the dashpot wins above g = k h^2 w^2 / 4 / h. In a row of
// three each has two contacts, w^2 = 2.8 (5/2) k / m* with m* = m / 2.
TEST(FedSprings, areNotWithASufficientDashpot) {
    const double mass = sphereMass(radius, density), h = step(),
                 squared = 2.8 * 2.5 * stiffness / (0.5 * mass);
    const double enough = 0.25 * stiffness * squared * h * h * h;  // kg/s
    EXPECT_NE(Row(0.98 * enough, h).warning(), "");
    EXPECT_EQ(Row(1.02 * enough, h).warning(), "");
    const double fed = std::pow(squared * h * h, 2) / 8;
    EXPECT_NEAR(stepsToDouble<S::Mixed>(material(0), {radius, radius}, 0.5 * mass,
                                        integrators::predictedVelocityVerlet, 2, h) *
                    fed,
                std::numbers::ln2, 1e-12);
}

TEST(FedSprings, areNotUnderVelocityVerletNorInPairsNorWhereAllIsQuiet) {
    Row verlet(0, step());
    verlet.setIntegrator(integrators::velocityVerlet);
    EXPECT_EQ(verlet.warning(), "");
    Row quiet(0, step());
    quiet.setQuiet();
    EXPECT_EQ(quiet.warning(), "");
    scenes::FewGrains<S> pair(material(0),
                              {{.radius = radius}, {.radius = radius, .position = {0.003, 0, 0}}}, step());
    testing::internal::CaptureStderr();
    pair.initialise();
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace pendular
