#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/ForceTotals.h"
#include "Kernel/Core/Contacts/ParticleSum.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"

namespace pendular::forceTotalsTest {
namespace {

using scenes::boxMaterial;
using scenes::FewGrains;
using scenes::SettlingBox;
using Rough = Species<HertzianViscoelastic, Mindlin>;
using Rolling = Species<LinearViscoelastic, SlidingRollingTorsion>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

TEST(ForceQuantum, isAPowerOfTwoTimesTheSquareOfOneBelowTheRadius) {
    const ForceQuantum quantum(1e7);
    ASSERT_TRUE(quantum.isChosen());
    for (const double radius : {1e-9, 1e-5, 0x1p-10, 0x1.fffffffffffffp-10, 1e-3, 0.7, 1.0, 3.0, 1e3}) {
        const double p = std::ldexp(1.0, std::ilogb(radius));
        const double perNewton = quantum.perNewton(radius);
        EXPECT_EQ(std::ldexp(0.5, std::ilogb(perNewton) + 1), perNewton);
        EXPECT_EQ(perNewton * p * p, quantum.perUnitForce());
        EXPECT_EQ(quantum.newtons(radius) * perNewton, 1);
        EXPECT_EQ(ForceQuantum::perNewtonMetre(radius, perNewton) * p, perNewton);
        EXPECT_EQ(ForceQuantum::lengthOf(radius), p);
        // The largest force that it was made for fits, with a factor of 2 left at most 8 of the pressure, for
        // the powers of two of the radius and of the quantum.
        const auto fits = [&](double force) {
            return ForceQuantum::fits(Vector<double>{0, force, 0}, perNewton);
        };
        EXPECT_TRUE(fits(0.999e7 * radius * radius)) << radius;
        EXPECT_FALSE(fits(8.001e7 * radius * radius)) << radius;
        EXPECT_FALSE(fits(std::nan("")));
    }
}

// The kernel's sums, of whole numbers in the order of blocks, against the sums of the records, in that of
// partners: bit for bit.
template <class S>
void expectSumsOfRecords() {
    int acting = 0;
    SettlingBox<S> scene(5);
    scene.initialise();
    for (int n = 0; n < 600; ++n) {
        scene.step();
        const ParticleStore& grains = scene.particleHandler.store();
        const ContactStore& store = scene.contacts().store();
        ASSERT_TRUE(store.keepsTotals);
        for (std::size_t k = 0; k < grains.size(); ++k) {
            const ContactSum sum = contactSum(store, k, grains.translation[k].radius);
            const Vector<double> acceleration =
                grains.translation[k].inverseMass * sum.force + Vector<double>{0, 0, -9.81};
            ASSERT_EQ(grains.acceleration[k], acceleration);
            if constexpr (S::hasTorque) {
                ASSERT_EQ(grains.rotation[k].angularAcceleration,
                          grains.rotation[k].inverseInertia * sum.torque);
            }
            acting += norm(sum.force) > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(acting, 1000);
}
TEST(ForceTotals, areTheSumsOfTheRecords) {
    expectSumsOfRecords<Species<LinearViscoelastic>>();
    expectSumsOfRecords<Rough>();
    expectSumsOfRecords<Rolling>();
    expectSumsOfRecords<Wet>();
}

// Both sizes of grains have the same quantum, and no force is above 2^53 of them: so each sum is exact.
TEST(ForceTotals, cancelToTheLastBitWithoutWalls) {
    SettlingBox<Rough> scene(5);
    scene.wallHandler.clear();
    scene.setGravity({0, 0, 0});
    scene.initialise();
    int acting = 0;
    for (int n = 0; n < 600; ++n) {
        scene.step();
        const ParticleStore& grains = scene.particleHandler.store();
        ExactVectorSum all;
        for (std::size_t k = 0; k < grains.size(); ++k) {
            const ContactSum sum = contactSum(scene.contacts().store(), k, grains.translation[k].radius);
            all.add(sum.force);
            acting += norm(sum.force) > 0 ? 1 : 0;
        }
        ASSERT_EQ(all.value(), (Vector<double>{0, 0, 0})) << n;
    }
    EXPECT_GT(acting, 1000);
}

/// The state of a box whose quanta are made for a pressure (Pa); how many sums did not fit at its end.
struct Ending {
    std::uint64_t hash = 0;
    std::vector<Vector<double>> positions;
    int beyond = 0;
};
Ending settledWith(double pressure, int threads, int steps) {
    SettlingBox<Rough> scene(5);
    scene.initialise();
    scene.setNumberOfThreads(threads);
    if (pressure > 0) scene.contacts().store().totals.quantum = ForceQuantum(pressure);
    for (int n = 0; n < steps; ++n) scene.step();
    const ParticleStore& grains = scene.particleHandler.store();
    const ContactStore& store = scene.contacts().store();
    Ending end{stateHash(grains), {}, 0};
    for (std::size_t k = 0; k < grains.size(); ++k) {
        end.positions.push_back(grains.translation[k].position);
        const double perNewton = store.totals.quantum.perNewton(grains.translation[k].radius);
        for (const std::uint32_t side : store.sidesOf(k))
            end.beyond += ForceQuantum::fits(store.memory.records.force(side / 2), perNewton) ? 0 : 1;
    }
    return end;
}

// With quanta for 1 Pa no contact of a grain of 1 mm may have more than some uN; the weight of one is 100 uN.
TEST(ForceTotals, forcesThatDoNotFitAreSummedInOrder) {
    // Few steps: on several threads small work waits for them.
    const int steps = 300;
    const Ending usual = settledWith(0, 1, steps);
    EXPECT_EQ(usual.beyond, 0);
    for (const double pressure : {1e-6, 30.0, 300.0}) {
        const Ending one = settledWith(pressure, 1, steps);
        EXPECT_GT(one.beyond, 0) << pressure;
        for (const int threads : {2, 7}) EXPECT_EQ(settledWith(pressure, threads, steps).hash, one.hash);
        for (std::size_t k = 0; k < one.positions.size(); ++k)
            // Round-off of 1e-16 of the forces in 300 steps: grains have hit each other, which makes it
            // larger by the path over the radius, some ten times at each of a few hits.
            EXPECT_LT(norm(one.positions[k] - usual.positions[k]), 1e-10 * 1e-3) << pressure << ' ' << k;
    }
}

// One grain of 2 kg presses a small one with 20 N, 5e5 of its weights, while others of its size fly: the sums
// of the small one are in order, or not, and it stays where the forces balance.
TEST(ForceTotals, haveRoomForTheWholeRangeOfAScene) {
    Rough species = boxMaterial<Rough>(0);
    species.setEffectiveElasticModulus(1e9);
    species.setEffectiveShearModulus(1e9);
    const double small = 1e-3, large = 0.058;
    FewGrains<Rough> scene(species,
                           {{.radius = small, .position = {0, 0, small}},
                            {.radius = large, .position = {0, 0, 2 * small + large}}},
                           1e-7, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setGravity({0, 0, -9.81});
    scene.initialise();
    // F = 4/3 E* sqrt(R*) d^(3/2); some 20 N make an overlap of some 0.02 r. What is pressed to twice the
    // balance and more fits.
    for (int n = 0; n < 20000; ++n) scene.step();
    const ParticleStore& grains = scene.particleHandler.store();
    const ContactStore& store = scene.contacts().store();
    double largest = 0;
    for (const std::uint32_t side : store.sidesOf(0)) {
        const Vector<double> force = store.memory.records.force(side / 2);
        largest = std::max(largest, norm(force));
        EXPECT_TRUE(ForceQuantum::fits(force, store.totals.quantum.perNewton(grains.translation[0].radius)));
    }
    EXPECT_GT(largest, 1);
}

TEST(ForceTotals, areZeroWhereTheyBegin) {
    ForceTotals totals;
    totals.begin(200, 3);
    for (const int thread : {0, 1, 2}) {
        const OwnTotals own = totals.of(thread);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(own.totals) % 64, 0u);
        own.totals[130].force = ForceTotal::Whole{1, 2, 3, 0};
        own.totals[130].torque = ForceTotal::Whole{4, 5, 6, 0};
        if (own.marks != nullptr) own.marks[130 / OwnTotals::grainsOfAMark] = 1;
    }
    const ForceTotal sum = totals.taker().take(130);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(sum.force[c], 3 * (c + 1));
        EXPECT_EQ(sum.torque[c], 3 * (c + 4));
    }
    EXPECT_EQ(totals.taker().take(130).force[0], 0);
    // What has not been taken is gone at the next beginning, also with more grains and fewer threads.
    for (const int thread : {0, 1, 2}) {
        const OwnTotals own = totals.of(thread);
        own.totals[199].force = ForceTotal::Whole{1, 1, 1, 1};
        if (own.marks != nullptr) own.marks[199 / OwnTotals::grainsOfAMark] = 1;
    }
    totals.begin(1000, 2);
    for (std::size_t k = 0; k < 1000; ++k) {
        const ForceTotal total = totals.taker().take(k);
        ASSERT_TRUE(total.fits());
        ASSERT_EQ(total.force[0], 0);
    }
    totals.begin(200, 3);
    for (const int thread : {0, 1, 2}) EXPECT_EQ(totals.of(thread).totals[199].force[0], 0);
}

}  // namespace
}  // namespace pendular::forceTotalsTest
