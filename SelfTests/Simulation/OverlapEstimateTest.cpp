#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/TimeStep/OverlapEstimate.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"

// The overlaps that a scene is about to have, and the step that follows.

namespace pendular::overlapEstimateTest {
namespace {

using Hertz = Species<HertzianViscoelastic>;
using Linear = Species<LinearViscoelastic>;

constexpr double radius = 1e-3, density = 2500, modulus = 1e7;  // m, kg/m^3, Pa

// Hertz: 8/15 E* sqrt(R*) d^(5/2) = m* v^2 / 2. Integrals by 64 middles are right to 1e-4, the bisection to
// much less. The frequency goes with d^(1/4).
TEST(OverlapEstimate, isHertzsOfACollision) {
    Hertz species;
    species.setDensity(density);
    species.setEffectiveElasticModulus(modulus);
    species.setDissipation(0);
    for (const double speed : {0.01, 0.5}) {
        scenes::FewGrains<Hertz> scene(
            species,
            {{.radius = radius, .velocity = {speed, 0, 0}}, {.radius = radius, .position = {0.01, 0, 0}}},
            1e-7);
        const OverlapEstimate found = estimateOverlaps(scene);
        const double mass = 0.5 * sphereMass(radius, density);
        const double depth =
            std::pow(15.0 / 16 * mass * speed * speed / (modulus * std::sqrt(0.5 * radius)), 0.4);
        EXPECT_NEAR(found.bySpeed, depth / radius, 1e-3 * depth / radius);
        EXPECT_NEAR(found.byWeight, 0, 1e-12);
        EXPECT_NEAR(found.step, scene.stabilityLimit() * std::pow(0.05 * radius / depth, 0.25),
                    1e-3 * found.step);
    }
}

// Springs of rolling do not change with the overlap: where they bound the step, it is the limit itself.
TEST(OverlapEstimate, leavesTheStepToSpringsOfRolling) {
    using Rolling = Species<HertzianViscoelastic, MindlinRollingTorsion>;
    Rolling species;
    species.setDensity(density);
    species.setEffectiveElasticModulus(modulus);
    species.setEffectiveShearModulus(0.3 * modulus);
    species.setDissipation(0.1);
    species.setSlidingFrictionCoefficient(0.5);
    species.setRollingStiffness(1e6), species.setTorsionStiffness(1e6);
    species.setRollingDissipation(1), species.setTorsionDissipation(1);
    species.setRollingFrictionCoefficient(0.1), species.setTorsionFrictionCoefficient(0.1);
    std::vector<scenes::GrainMotion> grains;
    for (int k = 0; k < 4; ++k) grains.push_back({.radius = radius, .position = {0.01 * k, 0, 0}});
    grains[0].velocity = {0.01, 0, 0};
    scenes::FewGrains<Rolling> scene(species, grains, 1e-8);
    const OverlapEstimate found = estimateOverlaps(scene);
    EXPECT_LT(found.bySpeed, 0.01);
    EXPECT_NEAR(found.step, found.limit, 1e-3 * found.limit);
}

// The lowest contact of a column bears all of it, 3.6 / pi = 1.15 times the mean contact of a bed of the same
// weight over the column's shadow.
TEST(OverlapEstimate, knowsTheWeightOfAColumn) {
    Linear species;
    species.setDensity(density);
    species.setStiffness(1000);
    species.setDissipation(0);
    constexpr int count = 10;
    std::vector<scenes::GrainMotion> grains;
    for (int k = 0; k < count; ++k)
        grains.push_back({.radius = radius, .position = {0, 0, (2 * k + 1) * radius}});
    scenes::FewGrains<Linear> scene(species, grains, 1e-6);
    scene.setGravity({0, 0, -9.81});
    const double weight = count * sphereMass(radius, density) * 9.81;
    EXPECT_NEAR(estimateOverlaps(scene).byWeight, std::numbers::pi / 3.6 * weight / 1000 / radius,
                1e-6 * weight / 1000 / radius);
    // A pressure acts like more weight.
    const double pressure = weight / (4 * radius * radius);
    EXPECT_NEAR(estimateOverlaps(scene, pressure).byWeight, 2 * estimateOverlaps(scene).byWeight, 1e-9);
    EXPECT_GT(estimateOverlaps(scene).bySpeed, 0);  // of a fall through its height
}

// In a box that fills and comes to rest, the deepest contact of the fall is one that speed explains, and
// those at rest one that weight explains: the mean overlap of the bed is between a fifth of the estimate and
// it, as the estimate is that of the lowest layer, and of the box that is still loose.
TEST(OverlapEstimate, isOfTheSizeOfWhatHappens) {
    scenes::SettlingBox<Species<HertzianViscoelastic, Mindlin>> box(3);
    box.setQuiet();
    const OverlapEstimate expected = estimateOverlaps(box);
    box.setTimeMax(0.1);
    box.solve();
    const StabilityAdvice is = box.stabilityAdvice();
    EXPECT_LT(is.meanOverlap, expected.byWeight);
    EXPECT_GT(is.meanOverlap, 0.2 * expected.byWeight);
    // Dashpots take a part; the watch counts over the effective radius, up to twice as much.
    EXPECT_LT(box.contacts().overlaps().largestOverlap(), 2 * expected.bySpeed);
    EXPECT_GT(box.contacts().overlaps().largestOverlap(), 0.2 * expected.bySpeed);
    EXPECT_TRUE(support::contains(expected.text(), "by weight and pressure"));
}

TEST(OverlapEstimate, refusesWhatHasNoMeaning) {
    Linear species;
    species.setDensity(density);
    species.setStiffness(1000);
    species.setDissipation(0);
    scenes::FewGrains<Linear> empty(species, {}, 1e-6);
    EXPECT_TRUE(support::contains(support::refusal([&] { static_cast<void>(estimateOverlaps(empty)); }),
                                  "add them first"));
    scenes::FewGrains<Linear> one(species, {{.radius = radius}}, 1e-6);
    EXPECT_TRUE(
        support::isOneSentence(support::refusal([&] { static_cast<void>(estimateOverlaps(one, -1)); })));
}

}  // namespace
}  // namespace pendular::overlapEstimateTest
