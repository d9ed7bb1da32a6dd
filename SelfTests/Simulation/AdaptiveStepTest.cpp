#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Simulation/StateHash.h"
#include "Kernel/Species/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Species/Friction/Mindlin.h"
#include "Kernel/Species/Friction/SlidingFriction.h"
#include "Kernel/Species/Normal/HertzianViscoelastic.h"
#include "Kernel/Species/Normal/LinearViscoelastic.h"
#include "Kernel/State/Hdf5File.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// A time step that follows the contacts of the scene.

namespace pendular {
namespace {

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using Smooth = Species<LinearViscoelastic>;

template <class S>
struct Box : scenes::SettlingBox<S> {
    explicit Box(double share = 0.5) : scenes::SettlingBox<S>(4) {
        this->setAdaptiveTimeStep(share);
        this->setQuiet();
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(this->particleHandler.store()); }
};

template <class S>
void expectSameBitsForThreads() {
    Box<S> one;
    one.initialise();
    one.step(250);
    Box<S> two;
    two.setNumberOfThreads(2);
    two.initialise();
    for (int k = 0; k < 250; ++k) two.step();
    EXPECT_EQ(one.hash(), two.hash());
    EXPECT_EQ(one.getTime(), two.getTime());
    EXPECT_GT(one.adaptiveTimeStep().choiceCount(), 5u);
}

TEST(AdaptiveStep, givesTheSameBitsForAnyThreads) {
    expectSameBitsForThreads<Wet>();
    expectSameBitsForThreads<Smooth>();
}

// Also between two choices, when contacts are listed otherwise.
TEST(AdaptiveStep, givesTheSameBitsThroughARestart) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP();
    const support::TestFolder folder;
    const auto file = folder.path() / "middle.h5";
    for (const std::size_t first : {1u, 130u, 777u}) {
        Box<Wet> whole;
        whole.initialise();
        whole.step(first);
        whole.writeRestart(file);
        whole.step(600);
        Box<Wet> again;
        again.restartFrom(file);
        again.initialise();
        EXPECT_EQ(again.getNumberOfTimeSteps(), first);
        again.step(600);
        EXPECT_EQ(again.hash(), whole.hash()) << first;
        EXPECT_EQ(again.getTime(), whole.getTime());
        EXPECT_EQ(again.adaptiveTimeStep().choiceCount(), whole.adaptiveTimeStep().choiceCount());
    }
}

using Hertz = Species<HertzianViscoelastic, Mindlin>;
Hertz hertz() {
    Hertz species;
    species.setDensity(2500);
    species.setEffectiveElasticModulus(1e7);
    species.setRestitutionCoefficient(0.8);
    species.setEffectiveShearModulus(4e6);
    species.setSlidingFrictionCoefficient(0.5);
    return species;
}

/// A grain that falls on one that lies on a floor.
struct Impact : scenes::FewGrains<Hertz> {
    Impact(double speed, double firstStep)
        : FewGrains(hertz(),
                    {{.radius = 1e-3, .position = {0, 0, 1e-3}},
                     {.radius = 1e-3, .position = {0, 0, 3.5e-3}, .velocity = {0, 0, -speed}}},
                    firstStep, {{{0, 0, -1}, {0, 0, 0}}}) {
        setQuiet();
    }
};

// The step is at most the share of what the contacts stand, at each step until the next choice: also while
// the impact presses them.
TEST(AdaptiveStep, isBelowTheBoundAtEachStepOfAnImpact) {
    for (const double speed : {0.01, 0.3, 3.0}) {
        Impact scene(speed, 1e-7);
        scene.setAdaptiveTimeStep(0.8, 1);  // nothing else bounds it
        scene.initialise();
        double most = 0, longest = 0, shortest = infinity;
        const double end = 1e-3 / speed;
        while (scene.getTime() < end) {
            scene.step();
            most = std::max(most, scene.getTimeStep() / scene.stableStepOfContacts());
            longest = std::max(longest, scene.getTimeStep());
            shortest = std::min(shortest, scene.getTimeStep());
        }
        EXPECT_LE(most, 0.8) << speed;
        EXPECT_GT(longest, 2 * shortest) << speed;
        EXPECT_GT(scene.motion(1).velocity.z(), 0) << speed;
    }
}

// A wall that begins to move is seen in the step in which it does so, by what it moves. The grain lies on the
// floor with its weight, an overlap of 0.04 %, 3.4 times softer than at 5 %.
TEST(AdaptiveStep, isChosenAnewWhenAWallBeginsToMove) {
    scenes::FewGrains<Hertz> scene(hertz(), {{.radius = 1e-3, .position = {0, 0, 1e-3 - 3.9e-7}}}, 1e-7,
                                   {{{0, 0, -1}, {0, 0, 0}}});
    scene.setQuiet();
    scene.setGravity({0, 0, -9.81});
    scene.setAdaptiveTimeStep(0.8, 1);
    scene.initialise();
    scene.step(1510);
    const std::size_t before = scene.adaptiveTimeStep().choiceCount();
    const double step = scene.getTimeStep();
    EXPECT_GT(step, scene.stabilityLimit());
    dynamic_cast<InfiniteWall&>(scene.wallHandler.getObject(0)).setVelocity({0, 0, 0.1});
    scene.step(2);
    EXPECT_EQ(scene.adaptiveTimeStep().choiceCount(), before + 1);
    EXPECT_LT(scene.getTimeStep(), 0.8 * step);
}

TEST(AdaptiveStep, isChosenAnewForGrainsThatCome) {
    Impact scene(0.01, 1e-7);
    scene.setAdaptiveTimeStep(0.5);
    scene.initialise();
    scene.step(75);
    const std::size_t before = scene.adaptiveTimeStep().choiceCount();
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    grain.setRadius(1e-4);
    grain.setPosition({0, 0, 8e-3});
    scene.particleHandler.copyAndAddObject(grain);
    scene.step();
    EXPECT_EQ(scene.adaptiveTimeStep().choiceCount(), before + 1);
    // The new grain is the smallest, and its pairs the fastest: it bounds the largest step.
    EXPECT_LE(scene.getTimeStep(), 0.9 / std::numbers::pi * scene.shortestContactTime() * (1 + 1e-12));
}

TEST(AdaptiveStep, settlesAsWithFixedSteps) {
    const auto height = [](bool adapts) {
        scenes::SettlingBox<Wet> box(6);
        box.setQuiet();
        if (adapts) box.setAdaptiveTimeStep(0.5);
        box.setTimeMax(0.25);
        box.solve();
        EXPECT_LT(box.getKineticEnergy(), 1e-8);
        return std::pair{box.getCentreOfMass().z(), box.getNumberOfTimeSteps()};
    };
    const auto [fixed, fixedSteps] = height(false);
    const auto [adapted, adaptedSteps] = height(true);
    EXPECT_NEAR(adapted / fixed, 1, 0.03);  // another random packing of 96 grains
    EXPECT_NE(fixedSteps, adaptedSteps);
}

TEST(AdaptiveStep, isRefusedWhereItIsNotKnown) {
    const auto refusalOf = [](auto&& change) {
        Impact scene(0.1, 1e-7);
        scene.setAdaptiveTimeStep(0.5);
        change(scene);
        return support::refusal([&] { scene.initialise(); });
    };
    EXPECT_TRUE(support::isOneSentence(
        refusalOf([](Impact& scene) { scene.setIntegrator(integrators::adamsMoulton); })));
    EXPECT_TRUE(support::contains(refusalOf([](Impact& scene) {
                                      scene.wallHandler.clear();
                                      for (const int axis : {0, 1, 2}) scene.setPeriodic(axis, -0.1, 0.1);
                                      scene.setLeesEdwards(0, 1, 1);
                                  }),
                                  "does not know shear"));
    for (const double share : {0.0, -1.0, 1.1, std::nan("")})
        EXPECT_TRUE(
            support::isOneSentence(support::refusal([&] { Impact(0.1, 1e-7).setAdaptiveTimeStep(share); })));
    Impact begun(0.1, 1e-7);
    begun.initialise();
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { begun.setAdaptiveTimeStep(0.5); })));
}

}  // namespace
}  // namespace pendular
