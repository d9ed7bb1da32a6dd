#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeClassicalWillett.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Laws/Concepts/TypeList.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Papers/IndependentWetCollision.h"
#include "SelfTests/Scenes/Collision.h"

namespace pendular::wetCollisionTest {
namespace {

namespace paper = independent::wetCollisionScene;
using independent::WetCollision;
using independent::wetCollisions;
using scenes::Approach;
using scenes::Collision;
using scenes::spreadOffset;
using scenes::Touch;

using Bridges = TypeList<LiquidBridgeWillett, LiquidBridgeClassicalWillett, LiquidBridgeBagheri>;
template <class Bridge>
using Wet = Species<HertzianViscoelastic, NoFriction, Bridge>;

const Bodies paperBodies{paper::radius1, paper::radius2};

template <class Bridge>
Wet<Bridge> paperSpecies() {
    Wet<Bridge> species;
    species.setElasticModulusAndPoissonRatio(paper::youngModulus, paper::poissonRatio);
    species.setRestitutionCoefficient(paper::restitution);
    species.setLiquidBridgeVolume(paper::volume);
    species.setContactAngle(paper::contactAngle);
    species.setSurfaceTension(paper::surfaceTension);
    return species;
}

/// The bridge of the paper's grains, as its law prepares it.
template <class Bridge>
auto paperBridge() {
    const Wet<Bridge> species = paperSpecies<Bridge>();
    return static_cast<const Bridge&>(species).prepare(paperBodies);
}

Approach paperApproach(const WetCollision& collision, double stepsPerContact, double offset) {
    return {.radius1 = paper::radius1,
            .radius2 = paper::radius2,
            .density = paper::density,
            .speed = collision.speed,
            .step = collision.contactTime / stepsPerContact,
            .offset = offset,
            .ledger = true};
}

template <class S>
ObservedContact observed(const Collision<S>& scene) {
    ObservedContact seen{};
    scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        seen = scene.contacts().observe(scene.particleHandler.store(), bucket, contact);
    });
    return seen;
}

/// The collision up to the rupture, or until the pair turns back.
struct Flight {
    Touch touch;
    double speedAfterContact = 0;   // m/s, at the end of the overlap
    double dissipated = 0;          // J
    double farthestSeparation = 0;  // m
    double farthestTime = 0;        // s, from the first touch
    double bridgeWork = 0;          // J
    double speedLeft = 0;           // m/s
};

Flight fly(const WetCollision& collision, double stepsPerContact, double offset) {
    Collision scene(paperSpecies<LiquidBridgeBagheri>(), paperApproach(collision, stepsPerContact, offset));
    const double step = scene.scene.step, start = scene.scene.firstTouch();
    Flight flight;
    flight.touch = scene.finishTouch();
    // The bridge has slowed the grains since the end of the overlap, a fraction of a step ago.
    const double slowing = 2 * paper::contactForce / paper::reducedMass * scene.separation();
    flight.speedAfterContact = std::sqrt(scene.partingSpeed() * scene.partingSpeed() + slowing);
    flight.dissipated = scene.energyLedger().normalDashpots;
    for (;;) {
        const double separation = scene.separation(), speed = scene.partingSpeed();
        scene.step();
        if (scene.partingSpeed() <= 0) {
            const double part = speed / (speed - scene.partingSpeed());
            flight.farthestSeparation = separation + 0.5 * part * step * speed;
            flight.farthestTime = scene.getTime() - (1 - part) * step - start;
            break;
        }
        if (scene.separation() >= paper::ruptureDistance) {
            flight.farthestSeparation = paper::ruptureDistance;
            flight.speedLeft = scene.partingSpeed();
            flight.farthestTime =
                scene.getTime() - (scene.separation() - paper::ruptureDistance) / flight.speedLeft - start;
            break;
        }
    }
    flight.bridgeWork = scene.energyLedger().adhesionWork();
    return flight;
}

/// What the numbers of a flight may err, with Newton's second law as the only input.
/// A bridge's force begins and ends within a step, but acts in whole steps: its impulse errs by up to F dt/2.
/// At the start that changes the speed by F(0) dt / (2 m*), at the rupture by F(S_c) dt / (2 m*): first order
/// in dt. All else is smaller: the dry contact's error is, with e = 0.86, below (4.03/n)^2/24 + 2 (ln e/n)^2
/// (see DryCollisionTest).
struct Tolerance {
    double contact, speed, speedAfter, energyAfter, ruptureSpeed;

    Tolerance(const WetCollision& c, double stepsPerContact) {
        const double step = c.contactTime / stepsPerContact;
        const double rate = std::log(paper::restitution) / stepsPerContact,
                     frequency = 4.03 / stepsPerContact;
        contact = frequency * frequency / 24 + 2 * rate * rate;
        speed = paper::contactForce * step / (2 * paper::reducedMass);
        speedAfter = speed + contact * c.speedAfterContact;
        energyAfter = paper::reducedMass * c.speedAfterContact * speedAfter;
        ruptureSpeed = ruptureForce() * step / (2 * paper::reducedMass);
    }
    static double bridgeForce(double separation) {
        return paperBridge<LiquidBridgeBagheri>().force(separation);
    }
    static double ruptureForce() { return bridgeForce(paper::ruptureDistance); }
};

void compare(const WetCollision& expected, double stepsPerContact, const Flight& flight) {
    SCOPED_TRACE(testing::Message() << expected.speed << " m/s, " << stepsPerContact << " steps per contact");
    const Tolerance t(expected, stepsPerContact);
    const double step = expected.contactTime / stepsPerContact;
    EXPECT_NEAR(flight.speedAfterContact, expected.speedAfterContact, t.speedAfter);
    // Overlap ~ v^(4/5), loss ~ v^2 (1 - e^2).
    EXPECT_NEAR(flight.touch.largestOverlap / expected.largestOverlap, 1,
                t.speed / expected.speed + t.contact);
    const double lossPerRestitution =
        2 * paper::restitution * paper::restitution / (1 - paper::restitution * paper::restitution);
    EXPECT_NEAR(flight.dissipated / expected.dissipated, 1,
                2 * t.speed / expected.speed + lossPerRestitution * t.contact);
    // The work of the bridge is a sum of F v dt.
    EXPECT_NEAR(
        flight.bridgeWork, expected.bridgeWork,
        0.5 * step * expected.speed * (paper::contactForce + Tolerance::ruptureForce()) + t.energyAfter);
    if (expected.speedLeft > 0) {
        // m v^2/2 left = m v^2/2 after the contact - work; the time is the integral of dS/v, and v nowhere
        // below the last.
        const double left = t.energyAfter / (paper::reducedMass * expected.speedLeft) + t.ruptureSpeed;
        EXPECT_NEAR(flight.speedLeft, expected.speedLeft, left);
        EXPECT_NEAR(flight.farthestTime / expected.farthestTime, 1, left / expected.speedLeft);
    } else {
        // Where all energy is spent, dS = dE / F(S); the time of a grain thrown against a force is as its
        // speed.
        EXPECT_NEAR(flight.farthestSeparation, expected.farthestSeparation,
                    t.energyAfter / Tolerance::bridgeForce(expected.farthestSeparation));
        EXPECT_NEAR(flight.farthestTime / expected.farthestTime, 1,
                    2 * t.speedAfter / expected.speedAfterContact);
    }
}

TEST(HeavyWetCollision, followsTheIndependentSolution) {
    for (const WetCollision& collision : wetCollisions)
        for (double steps : {50, 100, 200, 400})
            for (int k = 0; k < 32; ++k) compare(collision, steps, fly(collision, steps, spreadOffset(k)));
}

TEST(HeavyWetCollision, convergesWithTheStep) {
    // The largest error over 64 offsets is halved with the step. Their mean is much smaller, because the
    // start of the bridge errs as much to the one side as to the other: an eighth of the largest one at 64
    // evenly spread offsets.
    const auto errors = [](const WetCollision& collision, double steps) {
        double largest = 0, sum = 0;
        for (int k = 0; k < 64; ++k) {
            const double error =
                fly(collision, steps, spreadOffset(k)).speedAfterContact - collision.speedAfterContact;
            largest = std::max(largest, std::abs(error));
            sum += error;
        }
        return std::pair{largest, std::abs(sum) / 64};
    };
    for (const WetCollision& collision : wetCollisions) {
        auto [largest, mean] = errors(collision, 50);
        for (double steps : {100, 200}) {
            const auto [finerLargest, finerMean] = errors(collision, steps);
            EXPECT_GT(largest / finerLargest, 1.8) << collision.speed << ' ' << steps;
            EXPECT_LT(finerMean, finerLargest / 8) << collision.speed << ' ' << steps;
            largest = finerLargest;
        }
    }
}

TEST(WetCollision, hasNoForceBeforeTheFirstTouch) {
    Bridges::forEach([]<class Bridge>() {
        Collision scene(paperSpecies<Bridge>(), paperApproach(wetCollisions[1], 50, 80.3));
        const double speed = scene.partingSpeed();
        ASSERT_LT(scene.separation(), 2 * paper::ruptureDistance);
        int within = 0;
        while (scene.separation() - scene.scene.speed * scene.scene.step > 0) {
            scene.step();
            within += scene.separation() < paper::ruptureDistance ? 1 : 0;
            EXPECT_EQ(scene.particleHandler.getObject(0).getForce().norm(), 0);
            EXPECT_EQ(scene.particleHandler.getObject(1).getForce().norm(), 0);
            EXPECT_FALSE(observed(scene).bridged);
            EXPECT_EQ(scene.partingSpeed(), speed);
        }
        EXPECT_GT(within, 50);  // steps in which an old bridge would act
    });
}

TEST(WetCollision, forceOnTheWayOutIsTheCurveUpToTheRupture) {
    Bridges::forEach([]<class Bridge>() {
        for (double speed : {0.4, 1.0})
            for (int k = 0; k < 16; ++k) {
                WetCollision collision = wetCollisions[2];
                collision.speed = speed;
                Collision scene(paperSpecies<Bridge>(), paperApproach(collision, 50, spreadOffset(k)));
                const auto law = paperBridge<Bridge>();
                scene.finishTouch();
                double separation = scene.separation();
                int steps = 0;
                for (; observed(scene).bridged; scene.step(), ++steps) {
                    separation = scene.separation();
                    EXPECT_LT(separation, paper::ruptureDistance);
                    // The overlap ends where the radii cancel the distance: 1e-19 m of 1e-4 m, and the force
                    // follows.
                    EXPECT_NEAR(observed(scene).adhesiveForce / law.force(separation), 1, 1e-12);
                    const double force = scene.particleHandler.getObject(0).getForce().x();
                    EXPECT_NEAR(force / law.force(separation), 1, 1e-12);
                    EXPECT_EQ(scene.particleHandler.getObject(1).getForce().y(), 0);
                }
                EXPECT_GT(steps, 20);
                // The rupture distance of the paper's Appendix A, within the 12 digits of the table.
                EXPECT_NEAR(law.range() / paper::ruptureDistance, 1, 1e-11);
                EXPECT_GE(scene.separation(), law.range());
                EXPECT_LE(scene.separation() - separation, scene.partingSpeed() * scene.scene.step * 1.01);
                scene.step();
                EXPECT_EQ(scene.particleHandler.getObject(0).getForce().norm(), 0);
            }
    });
}

TEST(WetCollision, bridgeDoesNotComeBackWithoutATouch) {
    Collision scene(paperSpecies<LiquidBridgeBagheri>(), paperApproach(wetCollisions[3], 50, 0.5));
    scene.finishTouch();
    while (observed(scene).bridged) scene.step();
    for (int grain : {0, 1}) {  // throw them back
        auto reference = scene.particleHandler.getObject(grain);
        reference.setVelocity(-reference.getVelocity());
    }
    while (scene.separation() > 0.1 * paper::ruptureDistance) {
        scene.step();
        ASSERT_FALSE(observed(scene).bridged);
        ASSERT_EQ(scene.particleHandler.getObject(0).getForce().norm(), 0);
    }
}

TEST(WetCollision, momentumIsKept) {
    Bridges::forEach([]<class Bridge>() {
        for (const WetCollision& collision : wetCollisions)
            for (double drift : {0.0, 0.7}) {
                Approach approach = paperApproach(collision, 50, 0.3);
                approach.drift = drift;
                Collision scene(paperSpecies<Bridge>(), approach);
                const double start = scene.momentum();
                const double scale = approach.mass(paper::radius2) * (collision.speed + std::abs(drift));
                for (int k = 0; k < 600; ++k) {
                    scene.step();
                    // 600 steps, each rounding to 1e-16 of the larger momentum.
                    ASSERT_NEAR(scene.momentum(), start, 1e-12 * scale);
                }
            }
    });
}

template <class Bridge>
double ledgerGap(const WetCollision& collision, double steps) {
    double largest = 0;
    for (int k = 0; k < 32; ++k) {
        Collision scene(paperSpecies<Bridge>(), paperApproach(collision, steps, spreadOffset(k)));
        const double start = scene.energyLedger().total();
        while (scene.getTime() < 6 * collision.contactTime) scene.step();
        largest = std::max(largest, std::abs(scene.energyLedger().total() - start));
    }
    return largest;
}

TEST(HeavyWetCollision, energyLedgerClosesWithTheSquareOfTheStep) {
    Bridges::forEach([]<class Bridge>() {
        for (const WetCollision& collision : wetCollisions) {
            const double energy = 0.5 * paper::reducedMass * collision.speed * collision.speed;
            double gap = ledgerGap<Bridge>(collision, 50);
            // Velocity Verlet keeps the energy less (dt^2/8) sum m a^2 (StabilityTest), at most (w dt)^2/4 of
            // the energy, where all of it is elastic; w t_c = 4.03.
            EXPECT_LT(gap, std::pow(4.03 / 50, 2) / 4 * energy) << Bridge::name;
            for (double steps : {100, 200}) {
                const double finer = ledgerGap<Bridge>(collision, steps);
                EXPECT_GT(gap / finer, 3.5) << Bridge::name << ' ' << collision.speed << ' ' << steps;
                gap = finer;
            }
        }
    });
}

}  // namespace
}  // namespace pendular::wetCollisionTest
