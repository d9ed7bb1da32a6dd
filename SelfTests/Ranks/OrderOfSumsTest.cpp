// Sums over a scene that are fed back or written must have the same bits in whatever order grains and
// contacts are added up: with several ranks, that order is another one for each number of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "Kernel/Features/Insertion/Region.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Random.h"

namespace pendular::orderOfSumsTest {
namespace {

using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
using scenes::GrainMotion;

constexpr int perSide = 4, pairCount = perSide * perSide * perSide;
constexpr double cell = 0.01;           // m, of a pair
constexpr double stepLength = 0x1p-19;  // s

/// Pairs of grains that fly against each other, each pair in a cell of its own, and its grains behind each
/// other.
std::vector<GrainMotion> pairs() {
    support::Random random(7);
    std::vector<GrainMotion> all;
    for (int k = 0; k < pairCount; ++k) {
        const Vec3D centre =
            cell * Vec3D(k % perSide + 0.5, k / perSide % perSide + 0.5, k / perSide / perSide + 0.5);
        const Vec3D direction = random.inCube(1).normalized(), drift = random.inCube(0.1);
        const double radius1 = random.uniform(0.7e-3, 1.4e-3), radius2 = random.uniform(0.7e-3, 1.4e-3);
        const double gap = random.uniform(0, 1e-5), speed = random.uniform(0.02, 0.2);
        all.push_back(
            {radius1, centre - (radius1 + gap) * direction, drift + speed * direction, random.inCube(30)});
        all.push_back({radius2, centre + radius2 * direction, drift - speed * direction + random.inCube(0.05),
                       random.inCube(30)});
    }
    return all;
}

/// Numbers of grains in the order in which they are added: any, but the first of each pair comes before the
/// second. So the motion of a pair does not depend on the order; sums over all of them do, unless they are
/// exact.
std::vector<std::size_t> orderOf(std::size_t count, unsigned seed) {
    std::vector<std::size_t> order(count), placeOf(count);
    std::iota(order.begin(), order.end(), 0u);
    if (seed > 0) std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    for (std::size_t k = 0; k < count; ++k) placeOf[order[k]] = k;
    for (std::size_t first = 0; first + 1 < count; first += 2)
        if (placeOf[first] > placeOf[first + 1]) std::swap(order[placeOf[first]], order[placeOf[first + 1]]);
    return order;
}

/// The pairs, added in some order; whatever it is, motion(k) is that of the same grain.
struct Shuffled : scenes::FewGrains<Wet> {
    explicit Shuffled(unsigned seed, const std::vector<GrainMotion>& grains = pairs())
        : FewGrains(scenes::boxMaterial<Wet>(0), inOrder(grains, seed), stepLength),
          order(orderOf(grains.size(), seed)) {}

    /// Position, velocity and spin of all grains, however they are numbered.
    [[nodiscard]] std::vector<double> motions() {
        std::vector<double> all(9 * order.size());
        for (std::size_t k = 0; k < order.size(); ++k) {
            const GrainMotion own = motion(k);
            double* to = &all[9 * order[k]];
            for (const Vec3D& v : {own.position, own.velocity, own.spin})
                to = std::copy(v.begin(), v.end(), to);
        }
        return all;
    }

    std::vector<std::size_t> order;

private:
    static std::vector<GrainMotion> inOrder(const std::vector<GrainMotion>& grains, unsigned seed) {
        std::vector<GrainMotion> all;
        for (const std::size_t k : orderOf(grains.size(), seed)) all.push_back(grains[k]);
        return all;
    }
};

constexpr auto seeds = {1u, 2u, 3u};

/// What is compared: all that setUp() makes of a scene of the pairs, after so many steps.
template <class SetUp, class Numbers>
void expectSameInAnyOrder(int steps, SetUp&& setUp, Numbers&& numbers) {
    const auto found = [&](unsigned seed) {
        Shuffled scene(seed);
        setUp(scene);
        scene.run(steps);
        EXPECT_GT(scene.contacts().counts().acting, 10u);
        std::vector<double> all = numbers(scene), motions = scene.motions();
        all.insert(all.end(), motions.begin(), motions.end());
        return all;
    };
    const std::vector<double> expected = found(0);
    for (const unsigned seed : seeds) EXPECT_EQ(found(seed), expected) << "order " << seed;
}

void repeat(Scene& scene) {
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, perSide * cell);
}

TEST(OrderOfSums, theEnergyLedger) {
    expectSameInAnyOrder(
        500,
        [](Shuffled& scene) {
            scene.setGravity({1, 0.3, -9.81});
            scene.keepEnergyLedger();
        },
        [](Shuffled& scene) {
            std::vector<double> all;
            for (const auto& entry : EnergyLedger::entries())
                all.push_back(scene.energyLedger().*entry.member);
            return all;
        });
}

TEST(OrderOfSums, theMeanStress) {
    expectSameInAnyOrder(
        50, [](Shuffled& scene) { repeat(scene); },
        [](Shuffled& scene) {
            const MeanStress stress = meanStress(scene);
            std::vector<double> all;
            for (const auto& part : {stress.kinetic, stress.contact, stress.capillary, stress.viscous})
                all.insert(all.end(), part.data(), part.data() + 9);
            return all;
        });
}

// The servo makes the rates of what it has summed, and the grains go along.
TEST(OrderOfSums, theServosOfTheStress) {
    expectSameInAnyOrder(
        500,
        [](Shuffled& scene) {
            repeat(scene);
            for (int axis = 0; axis < 3; ++axis) scene.setTargetStress(axis, 10, 100 * stepLength);
            scene.keepEnergyLedger();
        },
        [](Shuffled& scene) {
            return std::vector{scene.getStrainRate(0), scene.getStrainRate(1), scene.getStrainRate(2),
                               scene.energyLedger().images};
        });
    expectSameInAnyOrder(
        500,
        [](Shuffled& scene) {
            repeat(scene);
            scene.setLeesEdwards(0, 1, 5);
            scene.setTargetShearStress(10, 100 * stepLength);
        },
        [](Shuffled& scene) { return std::vector{scene.getShearRate()}; });
}

/// Gives all grains a common speed, which their mean velocity has then.
void letFly(Scene& scene) {
    for (GrainReference grain : scene.particleHandler)
        grain.setVelocity(grain.getVelocity() + Vec3D(13, 5, -7));
}

// Of what it looks at, the mean velocity of the grains is a sum: speeds are those against it.
TEST(OrderOfSums, theOutlookOfTheAdaptiveStep) {
    expectSameInAnyOrder(
        50, [](Shuffled& scene) { letFly(scene); },
        [](Shuffled& scene) {
            AdaptiveStep adaptive;
            adaptive.set(0.2, 0);
            const AdaptiveStep::Outlook outlook =
                adaptive.lookAhead(scene.particleHandler.store(), scene.getPeriodicBox(), stepLength, 1, 9.81,
                                   3e-3, 1e-3, nullptr);
            return std::vector{outlook.longest, outlook.contacts.reach};
        });
}

TEST(OrderOfSums, theAdaptiveStep) {
    expectSameInAnyOrder(
        500, [](Shuffled& scene) { letFly(scene), scene.setAdaptiveTimeStep(0.2); },
        [](Shuffled& scene) {
            EXPECT_GT(scene.adaptiveTimeStep().choiceCount(), 3u);
            return std::vector{scene.getTimeStep(), scene.adaptiveTimeStep().smallestStep(),
                               scene.adaptiveTimeStep().largestStep()};
        });
}

// All grains go through the plane, and out of the scene, in the same step.
TEST(OrderOfSums, ofWhatGoesThroughPlanesAndOutlets) {
    support::Random random(3);
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 60; ++k)
        grains.push_back({.radius = random.uniform(0.5e-3, 1e-3),
                          .position = Vec3D(3e-3 * (k % 8), 3e-3 * (k / 8), 1e-7),
                          .velocity = Vec3D(0, 0, -1) + random.inCube(0.1)});
    const auto found = [&](unsigned seed) {
        Shuffled scene(seed, grains);
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0});
        scene.outletHandler.copyAndAddObject(outlet);
        scene.fluxPlaneHandler.copyAndAddObject({{0, 0, 1}, {0, 0, 0}});
        scene.run(2);
        EXPECT_EQ(scene.outletHandler.removedNumber(), grains.size());
        const FluxCount& count = scene.fluxPlaneHandler.countOf(0);
        return std::vector{scene.outletHandler.removedMass(), count.massBackwards, count.momentumBackwards.x,
                           count.momentumBackwards.y, count.momentumBackwards.z};
    };
    const std::vector<double> expected = found(0);
    for (const unsigned seed : seeds) EXPECT_EQ(found(seed), expected) << "order " << seed;
}

}  // namespace
}  // namespace pendular::orderOfSumsTest
