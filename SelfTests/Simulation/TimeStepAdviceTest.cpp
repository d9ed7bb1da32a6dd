#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Species/Normal/IndependentCollisions.h"

namespace pendular::timeStepAdviceTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;

constexpr double density = 2000, radius = 1e-3;  // kg/m^3, m

double mass(double r) { return 4.0 / 3.0 * std::numbers::pi * r * r * r * density; }

TEST(TimeStepAdvice, rayleighTimeIsTheClosedForm) {
    // pi 0.001 sqrt(2500/1e8) / (0.1631 0.25 + 0.8766), by hand.
    EXPECT_NEAR(rayleighTime(1e-3, 1e8, 0.25, 2500), 1.712273e-5, 1e-11);
    // It is a length over a speed: proportional to r and sqrt(rho / G).
    EXPECT_NEAR(rayleighTime(3e-3, 4e8, 0.25, 2500) / rayleighTime(1e-3, 1e8, 0.25, 2500), 1.5, 1e-14);
    EXPECT_NEAR(rayleighTime(1e-3, 1e8, 0.25, 10000) / rayleighTime(1e-3, 1e8, 0.25, 2500), 2, 1e-14);
}

TEST(TimeStepAdvice, hertzContactTimeIsTheIndependentOne) {
    for (const auto& c : independent::elasticCollisions) {
        const double volume1 = std::pow(c.radius1, 3), volume2 = std::pow(c.radius2, 3);
        const double reducedMass =
            4.0 / 3.0 * std::numbers::pi * c.density * volume1 * volume2 / (volume1 + volume2);
        const double reducedRadius = c.radius1 * c.radius2 / (c.radius1 + c.radius2);
        const double modulus = 0.5 * c.youngModulus / (1 - c.poissonRatio * c.poissonRatio);
        EXPECT_NEAR(hertzContactTime(modulus, reducedRadius, reducedMass, c.speed) / c.contactTime, 1, 1e-11);
    }
    // t ~ v^(-1/5)
    EXPECT_NEAR(hertzContactTime(1e7, 1e-3, 1e-5, 32) / hertzContactTime(1e7, 1e-3, 1e-5, 1), 0.5, 1e-14);
}

TEST(TimeStepAdvice, linearContactTimeIsHalfAPeriod) {
    EXPECT_NEAR(linearContactTime(1e4, 0, 1e-4), std::numbers::pi * 1e-4, 1e-17);
    // k/m = 25/9 s^-2 and g/2m = 4/3 s^-1 leave a frequency of 1 s^-1.
    EXPECT_NEAR(linearContactTime(25.0 / 9, 8.0 / 3, 1), std::numbers::pi, 1e-14);
    EXPECT_TRUE(std::isinf(linearContactTime(1, 2, 1)));  // critical
    EXPECT_TRUE(std::isinf(linearContactTime(1, 3, 1)));
    LinearViscoelastic law;
    law.setCollisionTimeAndRestitutionCoefficient(1e-4, 0.3, 2e-5);
    EXPECT_NEAR(linearContactTime(law.getStiffness(), law.getDissipation(), 1e-5), 1e-4, 1e-17);
}

/// Whether a small motion of a grain that its weight presses on a wall, to an overlap of 4.9 % of its radius,
/// grows without limit.
template <class S>
bool grows(const S& species, double elasticForce, const GrainMotion& disturbance, double step) {
    GrainMotion grain = disturbance;
    grain.radius = radius;
    grain.position = {0, 0, 0.951 * radius};
    FewGrains<S> scene(species, {grain}, step, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setGravity({0, 0, -elasticForce / mass(radius)});
    scene.acceptUnstableTimeStep();
    const auto largestMotion = [&](int steps) {
        double largest = 0;
        for (int k = 0; k < steps; ++k) {
            scene.step();
            const GrainMotion now = scene.motion(0);
            largest = std::max(largest, now.velocity.norm() + radius * now.spin.norm());
        }
        return largest;
    };
    try {
        scene.initialise();
        const double first = largestMotion(20);
        largestMotion(400);
        return largestMotion(20) > 20 * first;
    } catch (const std::runtime_error&) {  // it has run away
        return true;
    }
}

/// The step (s) above which it does, found by bisection.
template <class S>
double measuredLimit(S species, double elasticForce, const GrainMotion& disturbance, double low,
                     double high) {
    species.setDensity(density);
    EXPECT_FALSE(grows(species, elasticForce, disturbance, low));
    EXPECT_TRUE(grows(species, elasticForce, disturbance, high));
    while (high - low > 1e-3 * high) {
        const double middle = 0.5 * (low + high);
        (grows(species, elasticForce, disturbance, middle) ? high : low) = middle;
    }
    return low;
}

TEST(TimeStepAdvice, linearLimitLiesBelowTheTrueOneOfAPair) {
    const double stiffness = 1e4;
    for (double restitution : {1.0, 0.5, 0.1}) {
        Species<LinearViscoelastic> species;
        species.setStiffnessAndRestitutionCoefficient(stiffness, restitution, 2 * mass(radius));
        const double advice =
            stabilityLimit<Species<LinearViscoelastic>::Mixed>(species, {radius}, mass(radius));
        const double undamped = std::sqrt(mass(radius) / stiffness);
        if (restitution == 1) {  // 1/w of a pair, as four contacts along a direction make it twice as fast
            EXPECT_NEAR(advice / undamped, stabilityMargin, 1e-14);
        }
        const double limit = measuredLimit(species, stiffness * 0.049 * radius, {.velocity = {0, 0, 1e-6}},
                                           advice, 8 * undamped);
        // Velocity Verlet stands w dt < 2; from sqrt(2) on, the kernel may take a slow opening for the end of
        // the touch.
        EXPECT_GT(limit, 1.4 * advice) << restitution;
        if (restitution == 1) {
            EXPECT_LT(stabilityMargin * limit, 2.01 * advice);
        }
    }
}

TEST(TimeStepAdvice, hertzianLimitLiesBelowTheTrueOneOfAPair) {
    const double modulus = 1e7;
    for (double restitution : {1.0, 0.5, 0.1}) {
        Species<HertzianViscoelastic> species;
        species.setEffectiveElasticModulusAndRestitutionCoefficient(modulus, restitution);
        const double advice =
            stabilityLimit<Species<HertzianViscoelastic>::Mixed>(species, {radius}, mass(radius));
        // k_n = 2 E* sqrt(R d) at d = 0.05 R.
        const double undamped = std::sqrt(mass(radius) / (2 * modulus * radius * std::sqrt(0.05)));
        if (restitution == 1) {
            EXPECT_NEAR(advice / undamped, stabilityMargin, 1e-14);
        }
        const double force = 4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(0.049 * radius, 1.5);
        const double limit = measuredLimit(species, force, {.velocity = {0, 0, 1e-6}}, advice, 8 * undamped);
        EXPECT_GT(limit, 1.4 * advice) << restitution;
        if (restitution == 1) {
            EXPECT_LT(stabilityMargin * limit, 2.05 * advice);  // a stiffness that changes with the motion
        }
    }
}

TEST(TimeStepAdvice, tangentialSpringsOfASingleContactHaveNoLimitOfTheirOwn) {
    // A stiff tangential spring makes rolling to and fro the stiffest motion: w^2 = k_t (1/m + r^2/I) = 7/2
    // k_t/m. Of two bodies it is integrated by the trapezoidal rule, which has no limit of its own: the
    // advice is that for a bed. Without dashpots the springs of a scene with a wall, which may touch a grain
    // at three places, move in the step: that stands 2 / w, and the advice is 0.378 / (w sqrt(20 / 3.5)),
    // 1/12.6 of it.
    const double modulus = 1e7, shearModulus = 1e7;
    using S = Species<HertzianViscoelastic, Mindlin>;
    for (double restitution : {1.0, 0.5, 0.1}) {
        S species;
        species.setDensity(density);
        species.setEffectiveElasticModulusAndRestitutionCoefficient(modulus, restitution);
        species.setEffectiveShearModulus(shearModulus);
        species.setSlidingFrictionCoefficient(1000);
        species.deriveUnset();
        const double advice = stabilityLimit<S::Mixed>(species, {radius}, mass(radius));
        const double stiffness = 2.0 / 3.0 * 8 * shearModulus * radius * std::sqrt(0.05);
        EXPECT_NEAR(halfPeriod<S::Mixed>(species, {radius}, mass(radius)) /
                        (std::numbers::pi * std::sqrt(mass(radius) / (3.5 * stiffness))),
                    1, 1e-14);
        const double force = 4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(0.049 * radius, 1.5);
        const GrainMotion slip{.velocity = {1e-6, 0, 0}, .spin = {0, -1e-3, 0}};
        // The normal spring is at its own limit at 38 times the advice.
        for (double share : {0.1, 0.3, 1.0, 4.0, 12.0, 16.0, 35.0}) {
            if (restitution == 1 && share > 12.6) continue;
            EXPECT_FALSE(grows(species, force, slip, share * advice)) << restitution << ' ' << share;
        }
    }
}

TEST(TimeStepAdvice, ofASceneIsTheSmallestOfItsPairs) {
    using S = Species<HertzianViscoelastic>;
    const Integrator& scheme = integrators::predictedVelocityVerlet;
    S species;
    species.setDensity(density);
    species.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.8);
    for (double ratio : {1.0, 3.0, 10.0, 1000.0}) {
        const std::vector<double> radii{radius, 0.5 * (1 + ratio) * radius, ratio * radius};
        std::vector<GrainMotion> grains;
        for (double r : radii) grains.push_back({.radius = r, .position = {0, 0, 10 * r}});
        double smallest = infinity;
        for (double a : radii)
            for (double b : radii)
                smallest = std::min(smallest, stabilityLimit<S::Mixed>(
                                                  species, {a, b}, mass(a) * mass(b) / (mass(a) + mass(b)),
                                                  scheme, 2));  // each of three grains has two neighbours
        FewGrains<S> pairs(species, grains, 1e-9);
        EXPECT_NEAR(pairs.stabilityLimit() / smallest, 1, 1e-12) << "sizes 1 to " << ratio;
        FewGrains<S> walled(species, grains, 1e-9, {{{0, 0, -1}, {0, 0, 0}}});
        EXPECT_LT(walled.stabilityLimit(), smallest) << "a wall is a neighbour too";
        smallest = infinity;
        for (double a : radii) {
            smallest = std::min(smallest, stabilityLimit<S::Mixed>(species, {a}, mass(a), scheme, 5));
            for (double b : radii)
                smallest = std::min(
                    smallest, stabilityLimit<S::Mixed>(species, {a, b},
                                                       mass(a) * mass(b) / (mass(a) + mass(b)), scheme, 5));
        }
        EXPECT_NEAR(walled.stabilityLimit() / smallest, 1, 1e-12) << "wall, sizes 1 to " << ratio;
    }
}

TEST(TimeStepAdvice, ofASceneKnowsEverySpecies) {
    using S = Species<HertzianViscoelastic>;
    Simulation<S> scene;
    S species;
    species.setDensity(density);
    species.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.8);
    const S* soft = scene.speciesHandler.copyAndAddObject(species);
    species.setEffectiveElasticModulus(1e9);
    const S* hard = scene.speciesHandler.copyAndAddObject(species);
    SphericalParticle grain;
    grain.setRadius(radius);
    grain.setSpecies(soft);
    scene.particleHandler.copyAndAddObject(grain);
    const double softLimit = scene.stabilityLimit();  // a species without grains does not count
    const Bodies pair{radius, radius};
    const double expected =
        stabilityLimit<S::Mixed>(*soft, pair, 0.5 * mass(radius), integrators::predictedVelocityVerlet, 1);
    EXPECT_NEAR(softLimit / expected, 1, 1e-14);
    grain.setSpecies(hard);
    grain.setPosition({1, 0, 0});
    scene.particleHandler.copyAndAddObject(grain);
    EXPECT_NEAR(softLimit / scene.stabilityLimit(), 10, 1e-12);  // sqrt(1e9 / 1e7)
}

}  // namespace
}  // namespace pendular::timeStepAdviceTest
