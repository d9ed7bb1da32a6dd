#include "Kernel/Scene/Collisions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/PopularSpecies.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Laws/Concepts/ElasticConstants.h"
#include "SelfTests/Papers/IndependentWetCollision.h"
#include "SelfTests/Species/Normal/IndependentCollisions.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::collisionsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

constexpr double radius = 1e-3, density = 2500, stiffness = 1e4;  // m, kg/m^3, N/m
const double massOfGrain = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;

LinearViscoelasticSlidingFrictionSpecies linear(double restitution) {
    LinearViscoelasticSlidingFrictionSpecies species;
    species.setDensity(density);
    species.setStiffnessAndRestitutionCoefficient(stiffness, restitution, massOfGrain);
    species.setSlidingStiffness(2.0 / 7 * stiffness);
    species.setSlidingFrictionCoefficient(0.3);
    return species;
}

/// The half period of the damped spring, and the peak of its overlap, v sqrt(m / k) exp(-(L / w) arctan(w /
/// L)).
TEST(Collisions, linearSpringAndDashpotAreThoseOfTheClosedForm) {
    const double mass = 0.5 * massOfGrain, speed = 0.2;
    for (const double e : {0.1, 0.5, 0.9, 1.0}) {
        const double time =
            std::sqrt(mass / stiffness * (std::pow(std::numbers::pi, 2) + std::pow(std::log(e), 2)));
        const double w = std::numbers::pi / time, rate = -std::log(e) / time;
        const double peak = speed * std::sqrt(mass / stiffness) * std::exp(-rate / w * std::atan2(w, rate));
        const CollisionOutcome seen =
            collide(linear(e), {.radius1 = radius, .radius2 = radius, .normalVelocity = speed});
        const double steps = time / seen.timeStep;
        // As in DryCollisionTest: the frequency of the steps, and the dashpot in the steps in which the touch
        // begins and ends.
        const double turn = std::numbers::pi / steps, damped = std::log(e) / steps;
        const double tolerance =
            (turn * turn / 24 + 2 * damped * damped) * (1 + turn) + std::pow(turn, 3) / 6;
        EXPECT_GE(steps, 199);
        EXPECT_NEAR(seen.restitution / e, 1, tolerance - std::log(e) * turn * turn / 24);
        EXPECT_NEAR(seen.contactTime / time, 1, tolerance - std::log(e) / (steps * steps));
        EXPECT_NEAR(seen.largestOverlap / peak, 1, tolerance);
        EXPECT_NEAR(seen.partingVelocity, speed * seen.restitution, 1e-15);
        EXPECT_NEAR(seen.energyLost / seen.energyBefore, 1 - seen.restitution * seen.restitution, 1e-14);
        EXPECT_TRUE(seen.parted());
        EXPECT_EQ(seen.ruptureDistance, 0);
        EXPECT_TRUE(std::isnan(seen.tangentialRestitution));
    }
}

/// Independent solutions of Hertz's law with its dashpot.
TEST(Collisions, hertzianCollisionsAreThoseOfIndependentSolutions) {
    const auto compare = [](const independent::Collision& expected) {
        HertzianViscoelasticSpecies species;
        species.setDensity(expected.density);
        species.setElasticModulusAndPoissonRatio(expected.youngModulus, expected.poissonRatio);
        species.setRestitutionCoefficient(expected.restitution);
        const CollisionOutcome seen = collide(species, {.radius1 = expected.radius1,
                                                        .radius2 = expected.radius2,
                                                        .normalVelocity = expected.speed,
                                                        .timeStep = expected.contactTime / 200});
        // DryCollisionTest has the reasons of both.
        const double turn = 4.03 / 200, damped = std::log(expected.restitution) / 200,
                     tolerance = turn * turn / 24 + 2 * damped * damped;
        EXPECT_NEAR(seen.contactTime / expected.contactTime, 1, tolerance);
        EXPECT_NEAR(seen.largestOverlap / expected.largestOverlap, 1, tolerance);
        EXPECT_NEAR(seen.partingVelocity / expected.rebound, 1, 0.002 * std::pow(0.25, 1.25));
    };
    for (const auto& expected : independent::dampedCollisions) compare(expected);
    for (const auto& expected : independent::elasticCollisions) compare(expected);
}

/// A sphere that slides along a wall as long as it touches it: the impulse of friction is that of the normal
/// force by the coefficient. Without a dashpot all samples of both have one ratio.
TEST(Collisions, aSlidingSphereLosesWhatCoulombsLawTakes) {
    const double mu = 0.3, normal = 0.2, spin = 30;
    for (const double tangential : {1.0, -2.0}) {
        const CollisionOutcome seen = collide(linear(1), {.radius1 = radius,
                                                          .radius2 = infinity,
                                                          .normalVelocity = normal,
                                                          .tangentialVelocity = tangential,
                                                          .spin1 = spin});
        const double change = -std::copysign(mu * (1 + seen.restitution) * normal, tangential);
        EXPECT_NEAR(seen.tangentialVelocity, tangential + change, 1e-12);
        // The arm of friction ends in the middle of the overlap.
        const double shorter = 0.5 * seen.largestOverlap / radius;
        EXPECT_NEAR(seen.spin1, spin + 2.5 * change / radius, shorter * std::abs(2.5 * change / radius));
        EXPECT_EQ(seen.spin2, 0);
        const double before = tangential + radius * spin, after = before + 3.5 * change;
        EXPECT_NEAR(seen.tangentialRestitution, -after / before, shorter * std::abs(2.5 * change / before));
        EXPECT_NEAR(seen.largestTangentialForce, mu * seen.largestNormalForce, 1e-12);
        EXPECT_NEAR(seen.largestNormalForce / (stiffness * seen.largestOverlap), 1, 1e-3);  // 100 steps to it
        const double energy =
            0.5 * massOfGrain *
            (normal * normal + tangential * tangential + 0.4 * radius * radius * spin * spin);
        EXPECT_NEAR(seen.energyBefore, energy, 1e-14 * energy);
    }
}

std::vector<CollisionOutcome> series(int threads, std::size_t count = 40) {
    return collideMany(count, threads, [](std::size_t k) {
        const double share = static_cast<double>(k);
        return collide(linear(0.2 + 0.02 * share), {.radius1 = radius,
                                                    .radius2 = k % 5 == 0 ? infinity : radius,
                                                    .normalVelocity = 0.01 + 0.01 * share,
                                                    .tangentialVelocity = 0.02 * share});
    });
}

/// At grazing impacts grains turn about each other while they touch, and how far depends on where they touch
/// first: along x, whatever the steps. The shorter of these touches has 100 of the 200 steps, which err by
/// (pi/100)^2 in the second order, and so does the start between two steps.
TEST(Collisions, grazingImpactsDoNotDependOnTheStart) {
    const double tolerance = 2 * std::pow(std::numbers::pi / 100, 2);
    for (const double ratio : {10.0, 30.0}) {
        const auto at = [&](double steps) {
            return collide(linear(0.8), {.radius1 = radius,
                                         .radius2 = radius,
                                         .normalVelocity = 0.1,
                                         .tangentialVelocity = 0.1 * ratio,
                                         .stepsInContact = steps});
        };
        const CollisionOutcome coarse = at(200), fine = at(5000);
        ASSERT_TRUE(coarse.parted() && fine.parted());
        EXPECT_NEAR(coarse.partingVelocity / fine.partingVelocity, 1, tolerance) << ratio;
        EXPECT_NEAR(coarse.largestOverlap / fine.largestOverlap, 1, tolerance) << ratio;
        EXPECT_NEAR(coarse.energyLost / fine.energyLost, 1, tolerance) << ratio;
    }
    // It ended as creeping, without a touch.
    const CollisionOutcome grazing = collide(
        linear(0.8), {.radius1 = radius, .radius2 = radius, .normalVelocity = 0.01, .tangentialVelocity = 3});
    EXPECT_TRUE(grazing.parted());
    EXPECT_GT(grazing.largestOverlap, 0);
}

/// The chord along which grains are in each other has the length 2 v_n (r1 + r2) / |v|: one that is passed
/// within a step is missed.
TEST(Collisions, grainsThatPassEachOtherAreRefused) {
    const Collision given{
        .radius1 = radius, .radius2 = radius, .normalVelocity = 1e-6, .tangentialVelocity = 100};
    try {
        (void)collide(linear(0.8), given);
        FAIL() << "they have met";
    } catch (const RunError& error) {
        EXPECT_TRUE(isOneSentence(error.what()));
        EXPECT_TRUE(contains(error.what(), "pass each other without a touch")) << error.what();
    }
}

/// Ten steps in the shortest contact are the fewest, as those that are asked for.
TEST(Collisions, stepsThatAreTooLongAreRefused) {
    Collision given{.radius1 = radius, .radius2 = radius, .normalVelocity = 0.1, .stepsInContact = 10};
    const double longest = collide(linear(0.5), given).timeStep;
    given.timeStep = longest;
    EXPECT_EQ(collide(linear(0.5), given).timeStep, longest);
    for (const double step : {1.001 * longest, 2e-4, 0.0, -1e-6, std::nan("")}) {
        given.timeStep = step;
        const std::string sentence = refusal([&] { (void)collide(linear(0.5), given); });
        EXPECT_TRUE(isOneSentence(sentence));
        EXPECT_TRUE(contains(sentence, "timeStep")) << sentence;
    }
}

/// A question that throws ends a collision, and those of all threads.
TEST(Collisions, anInterruptionEndsThemWithinACollision) {
    struct Interrupted {};
    struct Asked {
        Asked() {
            setInterruption([] { throw Interrupted{}; });
        }
        ~Asked() { setInterruption({}); }
    } const asked;
    const Collision slow{.radius1 = radius, .radius2 = radius, .normalVelocity = 0.1, .stepsInContact = 1e6};
    EXPECT_THROW((void)collide(linear(0.5), slow), Interrupted);
    for (const int threads : {1, 3})
        EXPECT_THROW((void)collideMany(100, threads, [&](std::size_t) { return collide(linear(0.5), slow); }),
                     Interrupted);
}

TEST(Collisions, threadsAreInTheirRange) {
    for (const int threads : {0, -3, 4097}) {
        const std::string sentence = refusal([&] { (void)series(threads, 0); });
        EXPECT_TRUE(isOneSentence(sentence));
        EXPECT_TRUE(contains(sentence, "threads")) << sentence;
    }
}

/// Momentum and angular momentum of two grains stay, and what the ledger finds is what the motion loses.
TEST(Collisions, whatTheMotionLosesIsInTheLedger) {
    for (const double radius2 : {0.5e-3, 2e-3, infinity}) {
        const CollisionOutcome seen = collide(linear(0.6), {.radius1 = radius,
                                                            .radius2 = radius2,
                                                            .normalVelocity = 0.2,
                                                            .tangentialVelocity = 0.1,
                                                            .spin2 = radius2 < infinity ? 50.0 : 0.0,
                                                            .keepsEnergies = true});
        ASSERT_TRUE(seen.energies);
        const EnergyLedger& ledger = *seen.energies;
        EXPECT_NEAR(ledger.lost() + ledger.stored() + ledger.stepError, seen.energyLost,
                    1e-12 * seen.energyBefore);
        EXPECT_GT(ledger.normalDashpots, 0.3 * seen.energyLost);
        EXPECT_FALSE(
            collide(linear(1), {.radius1 = radius, .radius2 = radius2, .normalVelocity = 0.2}).energies);
    }
}

HertzianViscoelasticLiquidBridgeBagheriSpecies wet() {
    namespace paper = independent::wetCollisionScene;
    HertzianViscoelasticLiquidBridgeBagheriSpecies species;
    species.setDensity(paper::density);
    species.setElasticModulusAndPoissonRatio(paper::youngModulus, paper::poissonRatio);
    species.setRestitutionCoefficient(paper::restitution);
    species.setLiquidBridgeVolume(paper::volume);
    species.setContactAngle(paper::contactAngle);
    species.setSurfaceTension(paper::surfaceTension);
    return species;
}

/// Above the slowest speed of a rupture the bridge takes its work; below it, it draws the grains back.
TEST(Collisions, aBridgeTakesTheWorkOfItsRupture) {
    namespace paper = independent::wetCollisionScene;
    for (const independent::WetCollision& expected : independent::wetCollisions) {
        const CollisionOutcome seen = collide(wet(), {.radius1 = paper::radius1,
                                                      .radius2 = paper::radius2,
                                                      .normalVelocity = expected.speed,
                                                      .timeStep = expected.contactTime / 400});
        const double way = expected.speed * seen.timeStep;  // m, in a step at most
        EXPECT_NEAR(seen.contactTime / expected.contactTime, 1,
                    1e-3);  // the dashpot: (50/400)^(5/4) 0.002, and the start
        EXPECT_NEAR(seen.largestOverlap / expected.largestOverlap, 1, 1e-3);
        EXPECT_GT(seen.largestAttraction, 0.999 * paper::contactForce);
        const bool ruptures = expected.secondContactTime == independent::neverAgain;
        EXPECT_EQ(seen.parted(), ruptures);
        EXPECT_EQ(seen.end, ruptures ? CollisionEnd::Parted : CollisionEnd::DrawnBack);
        if (!ruptures) {
            EXPECT_EQ(seen.restitution, 0);
            EXPECT_EQ(seen.ruptureDistance, 0);  // also where the gap was past a step
            continue;
        }
        EXPECT_LE(seen.ruptureDistance, paper::ruptureDistance * (1 + 1e-9));
        EXPECT_GT(seen.ruptureDistance, paper::ruptureDistance - way);
        // The restitution of the contact errs by 0.002 (50/400)^(5/4) = 1.5e-4 of the energy's root, the work
        // by the force at the rupture over the way of a step.
        const double lost = expected.dissipated + expected.bridgeWork;
        EXPECT_NEAR(seen.energyLost, lost, 3e-4 * seen.energyBefore + 0.5 * paper::contactForce * way);
        EXPECT_NEAR(seen.duration, expected.farthestTime, 4e-3 * expected.farthestTime);
    }
}

TEST(Collisions, doNotDependOnThreads) {
    const auto one = series(1);
    for (const int threads : {2, 7}) {
        const auto many = series(threads);
        ASSERT_EQ(many.size(), one.size());
        for (std::size_t k = 0; k < one.size(); ++k) {
            EXPECT_EQ(many[k].partingVelocity, one[k].partingVelocity);
            EXPECT_EQ(many[k].spin1, one[k].spin1);
            EXPECT_EQ(many[k].contactTime, one[k].contactTime);
            EXPECT_EQ(many[k].steps, one[k].steps);
        }
    }
    EXPECT_TRUE(series(2, 0).empty());
}

/// One sentence with the lowest number of those that fail, whatever the number of threads.
TEST(Collisions, refuseWrongNumbersByTheirPlace) {
    for (const int threads : {1, 3}) {
        const auto refused = [&](auto&& change, std::size_t from) {
            return refusal([&] {
                (void)collideMany(30, threads, [&](std::size_t k) {
                    Collision given{.radius1 = radius, .radius2 = radius, .normalVelocity = 0.1};
                    if (k >= from) change(given);
                    return collide(linear(0.5), given);
                });
            });
        };
        const std::string sentence = refused([](Collision& c) { c.normalVelocity = -1; }, 17);
        EXPECT_TRUE(isOneSentence(sentence));
        EXPECT_TRUE(contains(sentence, "collision 17: normalVelocity = -1 m/s")) << sentence;
        for (const std::string& other : {refused([](Collision& c) { c.radius1 = 0; }, 3),
                                         refused([](Collision& c) { c.radius2 = -infinity; }, 3),
                                         refused([](Collision& c) { c.spin2 = std::nan(""); }, 3),
                                         refused([](Collision& c) { c.radius2 = infinity, c.spin2 = 5; }, 3),
                                         refused([](Collision& c) { c.stepsInContact = 1; }, 3),
                                         refused([](Collision& c) { c.timeStep = 0; }, 3)}) {
            EXPECT_TRUE(isOneSentence(other));
            EXPECT_TRUE(contains(other, "collision 3: ")) << other;
        }
    }
}

}  // namespace
}  // namespace pendular::collisionsTest
