#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/Collision.h"
#include "SelfTests/Species/Normal/IndependentCollisions.h"

namespace pendular::dryCollisionTest {
namespace {

using scenes::Approach;
using scenes::Collision;
using scenes::spreadOffset;
using scenes::Touch;

using Hertz = Species<HertzianViscoelastic>;
using Linear = Species<LinearViscoelastic>;

constexpr double modulus = 2.8e6;  // E*, Pa
constexpr double stiffness = 1e3;  // N/m
const std::vector<double> restitutions = {0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 0.99};
const std::vector<double> stepsPerContact = {50, 47.3, 53.9};

Hertz hertz(double restitution) {
    Hertz species;
    species.setEffectiveElasticModulusAndRestitutionCoefficient(modulus, restitution);
    return species;
}
/// The time (s) of the elastic contact with the same E*.
double contactTime(const Hertz&, const Approach& a) {
    return hertzContactTime(modulus, a.reducedRadius(), a.reducedMass(), a.speed);
}
Linear linear(double restitution) {
    Linear species;
    species.setStiffnessAndRestitutionCoefficient(stiffness, restitution, 2 * Approach{}.reducedMass());
    return species;
}
double contactTime(const Linear& species, const Approach& a) {
    return linearContactTime(stiffness, species.getDissipation(), a.reducedMass());
}

template <class S>
double measuredRestitution(const S& species, double steps, double offset, double speed = 0.2) {
    Approach approach{.speed = speed, .offset = offset};
    approach.step = contactTime(species, approach) / steps;
    return Collision<S>(species, approach).finishTouch().restitution;
}

template <class S>
double worstError(const S& species, double restitution, double steps, int offsets) {
    double worst = 0;
    for (int k = 0; k < offsets; ++k)
        worst =
            std::max(worst, std::abs(measuredRestitution(species, steps, spreadOffset(k)) / restitution - 1));
    return worst;
}

/// What the restitution of the linear contact may err, as a share of it. With the rate L = g/(2 m*) and e =
/// exp(-L t_c):
/// - the step in which the touch begins moves the grains without the dashpot that acts in the later part of
/// it, so that
///   the overlap is too large by up to L v dt^2. A contact that starts with the overlap x at the speed v is
///   one that started from zero with v + 2 L x: the error is 2 (L dt)^2;
/// - velocity Verlet's frequency is too high by the share (w dt)^2/24, w = pi/t_c, and with it t_c too short:
/// L t_c of that;
/// - the first and the last sample count forces that grow linearly in time exactly, but not their curvature:
/// (w dt)^3/12,
///   the error of the trapezoidal rule in one step, at each end.
/// The terms that follow are smaller by w dt.
double linearTolerance(double restitution, double steps) {
    const double rate = -std::log(restitution) / steps, frequency = std::numbers::pi / steps;
    const double leading =
        2 * rate * rate - std::log(restitution) * frequency * frequency / 24 + std::pow(frequency, 3) / 6;
    return leading * (1 + frequency);
}

TEST(DryCollision, hertzianRestitutionIsTheGivenOneAtEverySpeed) {
    // The dashpot goes with the overlap to the power 1/4: the sum over samples errs with dt^(5/4) at both
    // ends of the touch.
    for (double e : restitutions)
        for (double steps : stepsPerContact)
            for (double speed : {1e-3, 1e-2, 0.1, 1.0})
                for (int k = 0; k < 24; ++k)
                    EXPECT_NEAR(measuredRestitution(hertz(e), steps, spreadOffset(k), speed) / e, 1,
                                0.002 * std::pow(50 / steps, 1.25))
                        << "e = " << e << ", " << steps << " steps, " << speed << " m/s, offset " << k;
}

TEST(DryCollision, linearRestitutionIsTheGivenOneAtEverySpeed) {
    for (double e : restitutions)
        for (double steps : stepsPerContact)
            for (double speed : {1e-3, 1e-2, 0.1, 1.0})
                for (int k = 0; k < 24; ++k)
                    EXPECT_NEAR(measuredRestitution(linear(e), steps, spreadOffset(k), speed) / e, 1,
                                linearTolerance(e, steps))
                        << "e = " << e << ", " << steps << " steps, " << speed << " m/s, offset " << k;
    // That is below 0.2 % at 50 steps except for the two strongest dashpots.
    EXPECT_LT(linearTolerance(0.3, 50), 0.002);
    EXPECT_LT(linearTolerance(0.2, 50), 0.0026);
    EXPECT_LT(linearTolerance(0.1, 50), 0.005);
}

TEST(DryCollision, restitutionIsTheSameNumberAtAllSpeeds) {
    // Collisions at different speeds are similar; a unit of them is the way of a step, and round-off of the
    // position (1e-19 m against 1e-10 m at the slowest) the only difference. It enters with the force's slope
    // at the ends.
    for (double e : {0.1, 0.5, 0.99})
        for (int k = 0; k < 16; ++k) {
            const double hertzian = measuredRestitution(hertz(e), 50, spreadOffset(k), 1);
            const double elastic = measuredRestitution(linear(e), 50, spreadOffset(k), 1);
            for (double speed : {1e-3, 0.03}) {
                EXPECT_NEAR(measuredRestitution(hertz(e), 50, spreadOffset(k), speed) / hertzian, 1, 1e-8);
                EXPECT_NEAR(measuredRestitution(linear(e), 50, spreadOffset(k), speed) / elastic, 1, 1e-8);
            }
        }
}

TEST(DryCollision, restitutionHoldsWithOneStepForAllSpeeds) {
    // The slower a Hertzian collision, the more steps it has.
    Approach fastest{.speed = 1};
    fastest.step = contactTime(hertz(0.5), fastest) / 50;
    for (double e : restitutions)
        for (double speed : {1e-3, 1e-2, 0.1, 1.0}) {
            Approach approach = fastest;
            approach.speed = speed;
            EXPECT_NEAR(Collision<Hertz>(hertz(e), approach).finishTouch().restitution / e, 1, 0.002)
                << e << ' ' << speed;
        }
}

TEST(DryCollision, errorFallsWithTheStep) {
    for (double e : {0.1, 0.2, 0.5}) {
        double hertzian = worstError(hertz(e), e, 50, 64), elastic = worstError(linear(e), e, 50, 64);
        for (double steps : {100, 200}) {
            const double finerHertzian = worstError(hertz(e), e, steps, 64);
            const double finerElastic = worstError(linear(e), e, steps, 64);
            EXPECT_GT(elastic / finerElastic, 3.5) << e << ' ' << steps;    // 4 at second order
            EXPECT_GT(hertzian / finerHertzian, 1.9) << e << ' ' << steps;  // 2.4 at order 5/4
            hertzian = finerHertzian, elastic = finerElastic;
        }
    }
}

TEST(DryCollision, noOffsetOfTheFirstTouchIsWorse) {
    // 10 000 offsets put the end of some touches within 1e-4 of a step behind a sample, whose force then
    // stands for half a step in which it was up to 10 000 times as large.
    for (double e : {0.3, 0.9})
        for (int k = 0; k < 10000; ++k) {
            const double steps = 50 + 0.25 * (k % 40);
            EXPECT_NEAR(measuredRestitution(hertz(e), steps, spreadOffset(k)) / e, 1, 0.002)
                << steps << ' ' << k;
            EXPECT_NEAR(measuredRestitution(linear(e), steps, spreadOffset(k)) / e, 1,
                        linearTolerance(e, steps))
                << steps << ' ' << k;
        }
}

/// What the contact time and the largest overlap of a Hertzian collision may err, as a share of them:
/// velocity Verlet's frequency by (w dt)^2/24 with the largest frequency, w t_c = sqrt(15/8) x 2.943 = 4.03,
/// and the dashpot's part in the first step, as in linearTolerance().
double hertzTolerance(double restitution, double steps) {
    const double rate = std::log(restitution) / steps, frequency = 4.03 / steps;
    return frequency * frequency / 24 + 2 * rate * rate;
}

void compare(const independent::Collision& expected, double steps) {
    Hertz species;
    species.setElasticModulusAndPoissonRatio(expected.youngModulus, expected.poissonRatio);
    species.setRestitutionCoefficient(expected.restitution);
    for (int k = 0; k < 16; ++k) {
        const Approach approach{.radius1 = expected.radius1,
                                .radius2 = expected.radius2,
                                .density = expected.density,
                                .speed = expected.speed,
                                .step = expected.contactTime / steps,
                                .offset = spreadOffset(k)};
        const Touch touch = Collision<Hertz>(species, approach).finishTouch();
        const double tolerance = hertzTolerance(expected.restitution, steps);
        EXPECT_NEAR(touch.contactTime / expected.contactTime, 1, tolerance) << expected.restitution;
        EXPECT_NEAR(touch.largestOverlap / expected.largestOverlap, 1, tolerance) << expected.restitution;
        EXPECT_NEAR(touch.rebound / expected.rebound, 1, 0.002 * std::pow(50 / steps, 1.25))
            << expected.restitution;
    }
}

TEST(DryCollision, firstSampleMayLieArbitrarilyNearTheTouch) {
    // The sample is as far after the touch as the round-off of the positions (1e-19 m against a way of 1e-7 m
    // in a step) or more.
    for (double e : {0.1, 0.5, 0.9})
        for (double steps : {50.0, 158.0})
            for (double after : {0.0, 1e-11, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
                const double tolerance = 0.002 * std::pow(50 / steps, 1.25);
                EXPECT_NEAR(measuredRestitution(hertz(e), steps, 1 - after) / e, 1, tolerance)
                    << "e = " << e << ", " << steps << " steps, " << after << " steps after the touch";
                EXPECT_NEAR(measuredRestitution(linear(e), steps, 1 - after) / e, 1,
                            linearTolerance(e, steps))
                    << "e = " << e << ", " << steps << " steps, " << after << " steps after the touch";
            }
}

TEST(DryCollision, contactTimeAndLargestOverlapAreTheIndependentOnes) {
    for (double steps : {50, 100}) {
        for (const auto& collision : independent::elasticCollisions) compare(collision, steps);
        for (const auto& collision : independent::dampedCollisions) compare(collision, steps);
    }
}

/// The elastic collision by its closed forms, d_max = (15 m v^2/(16 E* sqrt(R)))^(2/5) and t = 4 sqrt(pi)
/// Gamma(2/5) / (5 Gamma(9/10)) d_max/v; damped, it is changed by factors that depend on nothing but e, taken
/// from the table.
independent::Collision scaled(const Approach& a, double effectiveModulus,
                              const independent::Collision& damped) {
    const independent::Collision& elastic = independent::elasticCollisions[0];
    const double overlap = std::pow(
        15 * a.reducedMass() * a.speed * a.speed / (16 * effectiveModulus * std::sqrt(a.reducedRadius())),
        0.4);
    const double time =
        4 * std::sqrt(std::numbers::pi) * std::tgamma(0.4) / (5 * std::tgamma(0.9)) * overlap / a.speed;
    independent::Collision result = damped;
    result.rebound = damped.restitution * a.speed;
    result.contactTime = time * damped.contactTime / elastic.contactTime;
    result.largestOverlap = overlap * damped.largestOverlap / elastic.largestOverlap;
    return result;
}

TEST(DryCollision, unequalSpheresAndWallsFollowTheClosedForms) {
    for (double radius2 : {0.3e-3, 4e-3, 50e-3, infinity})
        for (double speed : {0.1, 0.5})
            for (const auto& collision : independent::dampedCollisions) {
                if (collision.radius1 != independent::elasticCollisions[0].radius1) continue;
                Approach approach{.radius1 = 1e-3, .radius2 = radius2, .speed = speed};
                const independent::Collision expected = scaled(approach, modulus, collision);
                approach.step =
                    expected.contactTime / 100;  // at 50, two of the smallest grains would be unstable
                const Touch touch = Collision<Hertz>(hertz(expected.restitution), approach).finishTouch();
                const double tolerance = hertzTolerance(expected.restitution, 100);
                EXPECT_NEAR(touch.contactTime / expected.contactTime, 1, tolerance)
                    << radius2 << ' ' << speed;
                EXPECT_NEAR(touch.largestOverlap / expected.largestOverlap, 1, tolerance)
                    << radius2 << ' ' << speed;
                EXPECT_NEAR(touch.rebound / expected.rebound, 1, 0.002) << radius2 << ' ' << speed;
            }
}

TEST(DryCollision, linearContactTimeIsThatOfTheDampedOscillator) {
    for (double e : restitutions)
        for (double radius2 : {1e-3, infinity}) {
            Approach approach{.radius2 = radius2};
            Linear species;
            species.setStiffnessAndRestitutionCoefficient(stiffness, e, 2 * approach.reducedMass());
            approach.step = contactTime(species, approach) / 50;
            const Touch touch = Collision<Linear>(species, approach).finishTouch();
            // Its largest overlap is v/w_0 exp(-L/w arctan(w/L)).
            const double rate = -std::log(e), frequency = std::numbers::pi,
                         natural = std::hypot(rate, frequency);
            const double overlap = approach.speed * 50 * approach.step / natural *
                                   std::exp(-rate / frequency * std::atan2(frequency, rate));
            EXPECT_NEAR(touch.contactTime / (50 * approach.step), 1, linearTolerance(e, 50) + 1.7e-4) << e;
            EXPECT_NEAR(touch.largestOverlap / overlap, 1, linearTolerance(e, 50) + 1.7e-4) << e;
        }
}

}  // namespace
}  // namespace pendular::dryCollisionTest
