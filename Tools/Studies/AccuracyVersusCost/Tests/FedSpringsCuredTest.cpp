#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "Kernel/Laws/Adhesion/ReversibleAdhesive.h"
#include "Kernel/Laws/Friction/MindlinPartialSlip.h"
#include "Kernel/Laws/Friction/SlidingRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "Tools/Studies/AccuracyVersusCost/CriticalStep.h"

// Beds whose friction has no dashpots, which the default integrator would feed with springs kept half a step
// ahead: it moves them in the step, by velocity Verlet.

namespace pendular::fedSpringsCuredTest {
namespace {

using Held = ReversibleAdhesive;

/// The kinetic energy (J) of ten windows of 200 steps, in the mean, and its standard error.
struct MeanEnergy {
    double mean = 0, error = 0;
};
template <class Bed>
MeanEnergy meanEnergy(Bed& bed) {
    constexpr int windows = 10, steps = 200;
    std::array<double, windows> energies{};
    MeanEnergy found;
    for (double& energy : energies) {
        for (int n = 0; n < steps; ++n) {
            bed.step();
            energy += (bed.getKineticEnergy() + bed.getRotationalEnergy()) / steps;
        }
        found.mean += energy / windows;
    }
    double squares = 0;
    for (const double energy : energies) squares += std::pow(energy - found.mean, 2);
    found.error = std::sqrt(squares / (windows * (windows - 1)));
    return found;
}

/// A bed that is shaken keeps its kinetic energy over 4000 steps at a share of the stability limit.
template <class S>
void expectToKeepItsEnergy(double share) {
    const RestingGrains crystal = resting::crystal();
    const S species = criticalMaterial::make<S>({0, 1}, crystal.bodies(), crystal.effectiveMass());
    const auto scene = [&](double step) {
        return DisturbedGrains<S>(species, crystal, step, integrators::predictedVelocityVerlet);
    };
    auto bed = scene(share * scene(1).stabilityLimit());
    bed.initialise();
    const MeanEnergy first = meanEnergy(bed), last = meanEnergy(bed);
    const double error = std::hypot(first.error, last.error);
    EXPECT_NEAR(last.mean, first.mean, 5 * error) << share;
    EXPECT_LT(5 * error, 0.01 * first.mean) << share;
}

// A linear motion under velocity Verlet keeps an energy that differs from the true one by a factor of at most
// 1 / (1 - (h w)^2 / 4), which is 1 / (1 - 0.81) at 0.9 of the exact limit, and which part of it is kinetic
// comes back with each period: the mean of the second 2000 steps is that of the first, within five standard
// errors, which tell 1 %. With springs half a step ahead the speed was 110 times as large after 4000 steps
// at the limit, the energy 12 100 times.
TEST(FedSpringsCured, keepTheirEnergyAtTheLimit) {
    using Linear = Species<LinearViscoelastic, SlidingRollingTorsion, Held>;
    using Hertz = Species<HertzianViscoelastic, Mindlin, Held>;
    using Profile = Species<HertzianViscoelastic, MindlinPartialSlip, Held>;
    for (const double share : {0.3, 1.0}) {
        expectToKeepItsEnergy<Linear>(share);
        expectToKeepItsEnergy<Hertz>(share);
        expectToKeepItsEnergy<Profile>(share);
    }
}

// The accuracy of collisions stays: a pair without dashpots of friction, far from any other grain, has the
// trapezoidal rule in a scene of two, and springs in the step in one of three. Both are of second order: at
// 25 steps a contact the rims' speeds after an oblique collision differ by less than 1 %, at 100 by 1/16 of
// that, within a factor of 2.
TEST(FedSpringsCured, collideAlikeToSecondOrder) {
    using S = Species<LinearViscoelastic, SlidingFriction>;
    constexpr double radius = 1e-3, density = 2500, stiffness = 1000;
    S species;
    species.setDensity(density);
    species.setStiffnessAndRestitutionCoefficient(stiffness, 0.8, sphereMass(radius, density));
    species.setSlidingStiffness(2.0 / 7 * stiffness);
    species.setSlidingFrictionCoefficient(10);  // sticks
    const double contactTime = std::numbers::pi * std::sqrt(0.5 * sphereMass(radius, density) / stiffness);
    const auto spinAfter = [&](int stepsInContact, bool third) {
        std::vector<scenes::GrainMotion> grains{
            {.radius = radius, .position = {0, 0, 0}, .velocity = {0.05, 0.03, 0}},
            {.radius = radius, .position = {2.01e-3, 0, 0}, .velocity = {-0.05, 0, 0}}};
        if (third) grains.push_back({.radius = radius, .position = {0, 1, 0}});
        scenes::FewGrains<S> scene(species, grains, contactTime / stepsInContact);
        scene.setQuiet();
        scene.run(4 * stepsInContact);
        EXPECT_LT(scene.motion(0).velocity.x(), 0);
        return scene.motion(0).spin.z();
    };
    const double exact = spinAfter(4000, false), size = 0.03 / radius;
    EXPECT_NEAR(spinAfter(4000, true), exact, 2e-6 * size);
    const double coarse = std::abs(spinAfter(25, true) - exact),
                 fine = std::abs(spinAfter(100, true) - exact);
    EXPECT_LT(coarse, 0.01 * size);
    EXPECT_LT(fine, 2.0 / 16 * std::max(coarse, 1e-3 * size));
}

}  // namespace
}  // namespace pendular::fedSpringsCuredTest
