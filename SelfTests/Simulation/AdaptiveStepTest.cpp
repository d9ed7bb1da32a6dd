#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// A time step that follows the contacts of the scene.

namespace pendular::adaptiveStepTest {
namespace {

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using Smooth = Species<LinearViscoelastic>;
using Viscous = Species<HertzianViscoelastic, Mindlin, ViscousLiquidBridgeWillett>;

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

// The file may be written between two choices, too, when contacts are listed otherwise.
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

// A heavy grain presses a light one into the floor, deeper than the light one could by itself: as soon as a
// contact is deeper than was supposed, the step is chosen anew, before the next one.
/// The largest step of a scene over what its contacts stand then, while it runs for a time (s).
template <class Scene>
double largestShare(Scene& scene, double time) {
    scene.initialise();
    double most = 0;
    while (scene.getTime() < time) {
        scene.step();
        most = std::max(most, scene.getTimeStep() / scene.stableStepOfContacts());
    }
    return most;
}

// Rods that spin fall onto a floor and each other. With a share of 0.7 no step is above what contacts stand.
TEST(AdaptiveStep, isStableForRigidBodies) {
    scenes::FewGrains<Hertz> scene(hertz(), {}, 1e-7, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setQuiet();
    scene.setGravity({0, 0, -9.81});
    scene.setAdaptiveTimeStep(0.7);
    Clump rod{ClumpTemplate({{{0, 0, -1e-3}, 1e-3}, {{0, 0, 0}, 1e-3}, {{0, 0, 1e-3}, 1e-3}})};
    rod.setSpecies(scene.speciesHandler.getObject(0));
    for (int k = 0; k < 12; ++k) {
        rod.setPosition({2e-3 * (k % 2), 1.5e-3 * (k % 3), 3e-3 + 4.5e-3 * k});
        rod.setOrientation({std::cos(k), std::sin(k), 0.3, 0.1 * k});
        rod.setAngularVelocity({100, -50.0 * k, 20});
        scene.bodyHandler.copyAndAddObject(rod);
    }
    EXPECT_LE(largestShare(scene, 0.05), 1);
    EXPECT_GT(scene.adaptiveTimeStep().largestStep(), 2 * scene.adaptiveTimeStep().smallestStep());
}

// The speeds of grains count against the flow around them, so that a wide box has no smaller step.
TEST(AdaptiveStep, isStableInShearAndStrain) {
    for (const bool strained : {false, true}) {
        scenes::ShearedCloud<Hertz> scene(strained ? std::optional<double>() : 20.0, 1, hertz());
        scene.setQuiet();
        if (strained) scene.setStrainRate(2, -10);
        scene.setTimeStep(1e-7);
        scene.setAdaptiveTimeStep(0.7);
        EXPECT_LE(largestShare(scene, 2e-3), 1) << strained;
        EXPECT_GT(scene.adaptiveTimeStep().largestStep(), 5e-7) << strained;
    }
}

TEST(AdaptiveStep, isChosenAnewWhereAContactIsDeeperThanSupposed) {
    const double light = 1e-3, heavy = 4e-3;  // m
    scenes::FewGrains<Hertz> scene(
        hertz(),
        {{.radius = light, .position = {0, 0, light}},
         {.radius = heavy, .position = {0, 0, 2 * light + heavy + 4e-5}, .velocity = {0, 0, -0.3}}},
        1e-7, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setQuiet();
    scene.setTimeStep(0.9 * scene.stabilityLimit());
    scene.setAdaptiveTimeStep(0.9);
    scene.initialise();
    const auto deepest = [&] {  // over the effective radius
        double most = 0;
        for (const ObservedContact& seen : scene.interactions())
            most =
                std::max(most, seen.overlap() / (seen.wall >= 0 ? light : light * heavy / (light + heavy)));
        return most;
    };
    int surprises = 0;
    for (int k = 0; k < 3000; ++k) {
        const std::size_t choices = scene.adaptiveTimeStep().choiceCount();
        // The kernel's overlap has another rounding than the observer's.
        const bool isDeeper = deepest() > scene.adaptiveTimeStep().supposedOverlap() * (1 + 1e-9);
        scene.step();
        if (!isDeeper) continue;
        ++surprises;
        EXPECT_EQ(scene.adaptiveTimeStep().choiceCount(), choices + 1);
    }
    EXPECT_GT(surprises, 0);
    EXPECT_GT(scene.motion(1).velocity.z(), 0);  // it has come back
}

// What a grain reaches by itself is never more than was supposed: it is let go above a floor and falls, rests
// and is pressed by its weight alone, or comes with a speed.
TEST(AdaptiveStep, supposesAtLeastTheOverlapsOfALoneGrain) {
    for (const double speed : {0.0, 0.05, 0.5}) {
        scenes::FewGrains<Hertz> scene(
            hertz(), {{.radius = 1e-3, .position = {0, 0, 1e-3 + 2e-5}, .velocity = {0, 0, -speed}}}, 1e-6,
            {{{0, 0, -1}, {0, 0, 0}}});
        scene.setQuiet();
        scene.setGravity({0, 0, -9.81});
        scene.setAdaptiveTimeStep(0.9);
        scene.initialise();
        double deepest = 0;
        for (int k = 0; k < 2000; ++k) {
            scene.step();
            for (const ObservedContact& seen : scene.interactions()) {
                EXPECT_LE(seen.overlap() / 1e-3, scene.adaptiveTimeStep().supposedOverlap()) << speed;
                deepest = std::max(deepest, seen.overlap());
            }
        }
        EXPECT_GT(deepest, 1e-7) << speed;  // m
    }
}

// A wall that begins to move is seen in the step in which it does so, by what it moves. The grain lies on the
// floor with its weight, an overlap of 0.04 %, 3.4 times softer than at 5 %.
TEST(AdaptiveStep, isChosenAnewWhenAWallBeginsToMove) {
    scenes::FewGrains<Hertz> scene(hertz(), {{.radius = 1e-3, .position = {0, 0, 1e-3 - 3.9e-7}}}, 1e-7,
                                   {{{0, 0, -1}, {0, 0, 0}}});
    scene.setQuiet();
    scene.setGravity({0, 0, -9.81});
    scene.setAdaptiveTimeStep(0.3);
    scene.initialise();
    scene.step(1510);
    const std::size_t before = scene.adaptiveTimeStep().choiceCount();
    const double step = scene.getTimeStep();
    EXPECT_GT(step, scene.stabilityLimit());
    dynamic_cast<InfiniteWall&>(scene.wallHandler.getObject(0)).setVelocity({0, 0, 1});
    scene.step(2);
    EXPECT_EQ(scene.adaptiveTimeStep().choiceCount(), before + 1);
    EXPECT_LT(scene.getTimeStep(), 0.8 * step);
}

// They cost no choice: until the regular one the step is one that any contact of theirs stands.
TEST(AdaptiveStep, isShortEnoughForGrainsThatCome) {
    Impact scene(0.01, 1e-7);
    scene.setAdaptiveTimeStep(0.5);
    scene.initialise();
    scene.step(800);
    const std::size_t before = scene.adaptiveTimeStep().choiceCount();
    const double step = scene.getTimeStep();
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    grain.setRadius(1e-4);
    for (int k = 0; k < 100; ++k) {
        grain.setPosition({3e-4 * k, 0, 8e-3});
        scene.particleHandler.copyAndAddObject(grain);
        const std::size_t choices = scene.adaptiveTimeStep().choiceCount();
        scene.step();
        if (scene.adaptiveTimeStep().choiceCount() > choices) continue;  // by the contacts that there are
        EXPECT_LE(scene.getTimeStep(), 0.5 * scene.stabilityLimit() * (1 + 1e-12));
        EXPECT_LE(scene.getTimeStep(), 0.9 / std::numbers::pi * scene.shortestContactTime() * (1 + 1e-12));
    }
    EXPECT_LT(scene.getTimeStep(), 0.5 * step);
    EXPECT_LE(scene.adaptiveTimeStep().choiceCount(), before + 100 / AdaptiveStep::interval + 1);
}

// Nothing bounds it there: it stays as it was given.
TEST(AdaptiveStep, doesNotGrowWithoutGrains) {
    scenes::FewGrains<Hertz> scene(hertz(), {}, 1e-7, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setQuiet();
    scene.setAdaptiveTimeStep(0.5);
    scene.initialise();
    scene.step(400);
    EXPECT_EQ(scene.getTimeStep(), 1e-7);
    EXPECT_GT(scene.adaptiveTimeStep().choiceCount(), 5u);
}

/// A heap on a floor that moves as a test says.
struct Moved : Box<Hertz> {
    explicit Moved(const std::function<void(InfiniteWall&)>& move) : Box(0.5) {
        move(dynamic_cast<InfiniteWall&>(wallHandler.getObject(5)));
    }
};
void expectSameBitsOnAFloor(const std::function<void(InfiniteWall&)>& move) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP();
    const support::TestFolder folder;
    const auto file = folder.path() / "middle.h5";
    Moved whole(move);
    whole.initialise();
    whole.step(1110);
    whole.writeRestart(file);
    whole.step(300);
    Moved again(move);
    again.restartFrom(file);
    again.initialise();
    again.step(300);
    EXPECT_EQ(again.hash(), whole.hash());
    EXPECT_EQ(again.getTime(), whole.getTime());
    EXPECT_EQ(again.adaptiveTimeStep().choiceCount(), whole.adaptiveTimeStep().choiceCount());
}

TEST(AdaptiveStep, givesTheSameBitsOnAVibratingFloor) {
    expectSameBitsOnAFloor([](InfiniteWall& floor) {
        floor.setMotion([](double time) {
            return Eigen::Isometry3d(
                Eigen::Translation3d(0, 0, 1e-4 * std::sin(2 * std::numbers::pi * 200 * time)));
        });
    });
}

// An endless plane that tilts moves without bound somewhere: the step is the share of the stability limit.
TEST(AdaptiveStep, givesTheSameBitsOnATiltingFloor) {
    const auto tilt = [](InfiniteWall& floor) { floor.setAngularVelocity({0.5, 0, 0}, {0, 0, 0}); };
    expectSameBitsOnAFloor(tilt);
    Moved scene(tilt);
    scene.initialise();
    scene.step(500);
    EXPECT_DOUBLE_EQ(scene.getTimeStep(), 0.5 * scene.stabilityLimit());
}

// Boxes of 48 grains that start a little otherwise come to rest in other packings. Those with the adaptive
// step are of the same kind: the mean heights of eight differ by less than four standard errors (by chance
// once in 700 times, with 14 degrees of freedom), which are small enough to tell 6 %. Were steps too long,
// the grains would not come to rest.
TEST(HeavyAdaptiveStep, settlesAsWithFixedSteps) {
    constexpr int count = 8;
    struct Heights {
        double mean = 0, squaredError = 0;  // m, m^2
        std::size_t steps = 0;
    };
    const auto settle = [](double share) {
        Heights found;
        std::array<double, count> heights;
        for (int n = 0; n < count; ++n) {
            scenes::SettlingBox<Wet> box(3);
            box.setQuiet();
            for (std::size_t k = 0; k < box.particleHandler.getSize(); ++k) {
                GrainReference grain = box.particleHandler.getObject(k);
                grain.setVelocity(grain.getVelocity() + Vec3D(0.02 * n, 0.01 * n, 0));
            }
            if (share > 0) box.setAdaptiveTimeStep(share);
            box.setTimeMax(0.1);
            box.solve();
            EXPECT_LT(box.getKineticEnergy(), 1e-6);  // J, of some 1e-4
            found.steps += box.getNumberOfTimeSteps();
            found.mean += heights[static_cast<std::size_t>(n)] = box.getCentreOfMass().z();
        }
        found.mean /= count;
        for (const double height : heights) found.squaredError += std::pow(height - found.mean, 2);
        found.squaredError /= count * (count - 1);
        return found;
    };
    const Heights fixed = settle(0);
    for (const double share : {0.5, 0.9}) {
        const Heights adapted = settle(share);
        const double error = std::sqrt(fixed.squaredError + adapted.squaredError);
        EXPECT_NEAR(adapted.mean, fixed.mean, 4 * error) << share;
        EXPECT_LT(4 * error, 0.06 * fixed.mean) << share;
        EXPECT_LT(adapted.steps, fixed.steps) << share;
    }
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
    // Their kicks are weighed for steps that are known ahead.
    Box<Viscous> viscous;
    for (const std::size_t k : {0u, 1u}) {
        viscous.speciesHandler.getObject(k)->setViscosity(1e-3);
        viscous.speciesHandler.getObject(k)->setRoughness(1e-6);
    }
    EXPECT_TRUE(
        support::contains(support::refusal([&] { viscous.initialise(); }), "need steps of one length"));
    // Short steps would weigh too much in a mean of states at each step.
    const FieldOutput means =
        FieldOutput(FieldGrid("Z", {0, 0, 0}, {1e-2, 1e-2, 1e-2}, 1e-3), KernelShape::Gauss, 1e-3)
            .averagedOver(1e-3);
    Impact averaged(0.1, 1e-7);
    averaged.addOutput(means);
    averaged.setAdaptiveTimeStep(0.5);
    EXPECT_TRUE(support::contains(support::refusal([&] { averaged.initialise(); }), "need withInterval()"));
    for (const double share : {0.0, -1.0, 1.1, std::nan("")})
        EXPECT_TRUE(
            support::isOneSentence(support::refusal([&] { Impact(0.1, 1e-7).setAdaptiveTimeStep(share); })));
    Impact begun(0.1, 1e-7);
    begun.initialise();
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { begun.setAdaptiveTimeStep(0.5); })));
}

}  // namespace
}  // namespace pendular::adaptiveStepTest
