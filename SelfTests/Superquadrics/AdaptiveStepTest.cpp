#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "Kernel/Foundation/Math/CountedRandom.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Support/TestFolder.h"

// A time step that follows the contacts of superquadrics.

namespace pendular::adaptiveSuperquadricsTest {
namespace {

using scenes::FewGrains;
using scenes::FewSuperquadrics;
using scenes::SuperquadricMotion;
using scenes::turnedBy;

using Smooth = Species<HertzianViscoelastic>;
using Rough = Species<HertzianViscoelastic, Mindlin>;

template <class S>
S hertz() {
    S species;
    species.setDensity(2500);
    species.setEffectiveElasticModulus(1e7);
    species.setRestitutionCoefficient(0.8);
    if constexpr (S::hasTorque) {
        species.setEffectiveShearModulus(4e6);
        species.setSlidingFrictionCoefficient(0.5);
    }
    return species;
}

/// The largest step of a scene over what its contacts stand then, while it runs for a time (s).
template <class Scene>
double largestShare(Scene& scene, double time) {
    scene.setQuiet();
    scene.initialise();
    double most = 0;
    while (scene.getTime() < time) {
        scene.step();
        most = std::max(most, scene.getTimeStep() / scene.stableStepOfContacts());
    }
    return most;
}

// A shape that spins hits a floor by its tip or its edge, and its contact goes on along its surface, where it
// is stiffer: the step is at most the share of what the contacts stand, at each step.
TEST(AdaptiveSuperquadrics, isBelowTheBoundAtEachStepOfAnImpact) {
    for (const Superquadric& shape : {Superquadric{2e-3, 1e-3, 1e-3}, Superquadric{2e-3, 2e-3, 0.7e-3},
                                      Superquadric{1e-3, 1.5e-3, 0.8e-3, 6, 6}})
        for (const double speed : {0.01, 0.3}) {
            FewSuperquadrics<Rough> scene(hertz<Rough>(),
                                          {{shape,
                                            {0, 0, 2.4e-3},
                                            {0.5 * speed, 0, -speed},
                                            Vec3D(200, 300, -100) * speed,
                                            Eigen::Quaterniond(1, 0.5, -0.3, 0.2).normalized()}},
                                          1e-7);
            scene.addPlane({0, 0, -1}, {0, 0, 0});
            scene.setAdaptiveTimeStep(0.8, 1);  // nothing else bounds it
            EXPECT_LE(largestShare(scene, 6e-3 / speed), 0.8) << shape.a << " " << shape.n1 << " " << speed;
            EXPECT_GT(scene.adaptiveTimeStep().largestStep(), 2 * scene.adaptiveTimeStep().smallestStep());
            EXPECT_GT(scene.body(0).getVelocity().z(), -0.9 * speed);  // it has touched
        }
}

/// Two blocks that fly at each other: a corner at a face, or an edge across an edge.
struct BlocksThatMeet : FewSuperquadrics<Rough> {
    BlocksThatMeet(bool edges, double speed, double edge, double secondEdge)
        : FewSuperquadrics(hertz<Rough>(), {}, 1e-7) {
        constexpr double quarter = 0.25 * std::numbers::pi;
        addBlock(edge, {0, 0, 0}, speed,
                 edges ? turnedBy(quarter, {1, 0, 0}) : Eigen::Quaterniond::Identity());
        addBlock(secondEdge, {3e-4, 2e-4, 5.5e-3}, -speed,
                 edges ? turnedBy(2 * quarter + 0.1, {0, 0, 1}) * turnedBy(quarter, {1, 0, 0})
                       : turnedBy(0.9, {1, 1.2, 0.3}));
    }

private:
    void addBlock(double edge, const Vec3D& place, double speed, const Eigen::Quaterniond& orientation) {
        BlockGrain block({2e-3, 1.5e-3, 1e-3}, edge);
        block.setSpecies(speciesHandler.getObject(0));
        block.setPosition(place), block.setVelocity({0, 0, speed}), block.setOrientation(orientation);
        superquadricHandler.copyAndAddObject(block);
    }
};
TEST(AdaptiveSuperquadrics, isBelowTheBoundAtEachStepOfAnImpactOfBlocks) {
    constexpr double speed = 0.3;
    for (const bool edges : {false, true})
        for (const double edge : {3e-4, 9e-4}) {
            BlocksThatMeet scene(edges, speed, edge, 9e-4);
            scene.setAdaptiveTimeStep(0.8, 1);  // nothing else bounds it
            EXPECT_LE(largestShare(scene, 3e-3 / speed), 0.8) << edges << " " << edge;
            EXPECT_GT(scene.body(0).getVelocity().z(), -speed);  // they have touched
            EXPECT_LT(scene.body(0).getVelocity().z(), 0.9 * speed);
        }
}

/// Rods, lenses and blocks that spin fall onto a floor and each other.
struct Heap : FewSuperquadrics<Rough> {
    explicit Heap(double share) : FewSuperquadrics(hertz<Rough>(), {}, 1e-7) {
        const std::vector<Superquadric> all{
            {1e-3, 1e-3, 2e-3}, {1.5e-3, 1.5e-3, 0.6e-3}, {1e-3, 1e-3, 1e-3, 4, 4}, {1e-3, 1e-3, 1e-3}};
        const CountedRandom random(5);
        for (std::uint32_t k = 0; k < 12; ++k) {
            const auto even = [&](std::uint32_t n) { return random.uniform(-1, 1, k, n); };
            add({all[k % 4],
                 {2.5e-3 * (k % 2), 2.5e-3 * (k / 2 % 2), 2.5e-3 + 2.9e-3 * k},
                 0.1 * Vec3D(even(0), even(1), even(2)) - 0.3 * Vec3D::UnitZ(),
                 100 * Vec3D(even(3), even(4), even(5)),
                 Eigen::Quaterniond(even(6), even(7), even(8), even(9))});
        }
        addPlane({0, 0, -1}, {0, 0, 0});
        setGravity({0, 0, -9.81});
        setAdaptiveTimeStep(share);
        setQuiet();
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(particleHandler.store()); }
};

// With a share of 0.7 no step is above what contacts stand.
TEST(AdaptiveSuperquadrics, isStableInAHeap) {
    Heap scene(0.7);
    EXPECT_LE(largestShare(scene, 0.06), 1);
    EXPECT_GT(scene.adaptiveTimeStep().largestStep(), 2 * scene.adaptiveTimeStep().smallestStep());
}

TEST(AdaptiveSuperquadrics, givesTheSameBitsForAnyThreadsAndRestarts) {
    const support::TestFolder folder;
    Heap whole(0.5);
    whole.initialise();
    whole.step(777);
    if (Hdf5File::isAvailable()) whole.writeRestart(folder.path() / "middle.h5");
    whole.step(600);
    Heap threaded(0.5);
    threaded.setNumberOfThreads(3);
    threaded.initialise();
    threaded.step(1377);
    EXPECT_EQ(threaded.hash(), whole.hash());
    EXPECT_EQ(threaded.getTime(), whole.getTime());
    if (!Hdf5File::isAvailable()) GTEST_SKIP();
    Heap again(0.5);
    again.restartFrom(folder.path() / "middle.h5");
    again.initialise();
    again.step(600);
    EXPECT_EQ(again.hash(), whole.hash());
    EXPECT_EQ(again.adaptiveTimeStep().choiceCount(), whole.adaptiveTimeStep().choiceCount());
}

/// s, the steps of a sphere that falls on another one.
template <class Scene>
std::vector<double> stepsOf(Scene& scene) {
    scene.setQuiet();
    scene.setAdaptiveTimeStep(0.1, 3e-5);
    scene.initialise();
    std::vector<double> steps;
    for (int k = 0; k < 1000; ++k) {
        scene.step();
        steps.push_back(scene.getTimeStep());
    }
    return steps;
}

// Without friction the matrix of a body is that of its sphere; eigenvalues are found to 1e-7. The largest
// step that is asked for is below that of the stiffest pair, to which shapes add 1 % of the radius
// (ExtremeContact.h).
TEST(AdaptiveSuperquadrics, ofEqualHalfLengthsTakesTheStepsOfSpheres) {
    const double r = 1e-3;
    const Vec3D below(0, 0, 0.999 * r), above(2e-4, 0, 3.4 * r), velocity(0, 0, -0.3);
    FewGrains<Smooth> spheres(
        hertz<Smooth>(),
        {{.radius = r, .position = below}, {.radius = r, .position = above, .velocity = velocity}}, 1e-5,
        {{{0, 0, -1}, {0, 0, 0}}});
    FewSuperquadrics<Smooth> shapes(hertz<Smooth>(), {{{r, r, r}, below}, {{r, r, r}, above, velocity}},
                                    1e-5);
    shapes.addPlane({0, 0, -1}, {0, 0, 0});
    const std::vector<double> expected = stepsOf(spheres), found = stepsOf(shapes);
    EXPECT_GT(spheres.adaptiveTimeStep().choiceCount(), 20u);
    EXPECT_LT(*std::ranges::min_element(expected), 0.7 * *std::ranges::max_element(expected));
    for (std::size_t k = 0; k < expected.size(); ++k)
        ASSERT_NEAR(found[k], expected[k], 1e-6 * expected[k]) << k;
}

}  // namespace
}  // namespace pendular::adaptiveSuperquadricsTest
