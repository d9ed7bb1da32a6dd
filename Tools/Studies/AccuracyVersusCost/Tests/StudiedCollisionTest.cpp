#include <gtest/gtest.h>

#include <cmath>

#include "Tools/Studies/AccuracyVersusCost/CollisionCases.h"

namespace pendular::studiedCollisionTest {
namespace {

// Thornton and Ning (1998), Powder Technology 99, 154: without a dashpot the neck takes
// 7.09 (w^5 R*^4 / E*^2)^(1/3) (7.0895 by the integral of the force). The snap is seen up to a step late, at
// 5/9 of F_c = 3/2 pi w R*, and so is the start at 8/9 of it: with the speed v_0 of the touch, which grows to
// no more than 1.3 v_0, at most 13/9 F_c 1.3 v_0 dt.
TEST(StudiedCollision, losesToTheNeckWhatThorntonAndNingGive) {
    const auto studied = collisions::sticky(1);
    const double steps = 20000;
    const Aftermath after = finish(studied, steps, 2.5, integrators::predictedVelocityVerlet);
    const double radius = 0.5 * studied.encounter.radius,
                 modulus = studied.species.getEffectiveElasticModulus(),
                 work = studied.species.getWorkOfAdhesion(), speed = studied.encounter.speed;
    const double cost = 7.0895 * std::cbrt(std::pow(work, 5) * std::pow(radius, 4) / (modulus * modulus));
    const double mass = collisions::reducedMass(studied.encounter.radius);
    const double taken = 0.5 * mass * (speed * speed - after.parting * after.parting);
    const double late =
        13.0 / 9 * 1.5 * std::numbers::pi * work * radius * 1.3 * speed * studied.contactTime / steps;
    EXPECT_NEAR(taken, cost, late + 1e-5 * cost);
    EXPECT_LT(late, 0.02 * cost);
    EXPECT_NEAR(cost / (0.5 * mass * speed * speed), 0.25, 0.05);  // about a quarter
}

// Slower than the speed at which the neck takes all of the energy, by the square root of the quarter above.
TEST(StudiedCollision, leavesNothingToGrainsThatStayTogether) {
    auto studied = collisions::sticky();
    studied.encounter.speed *= 0.4;
    const Aftermath after = finish(studied, 20, 2.5, integrators::predictedVelocityVerlet);
    EXPECT_EQ(after.parting, 0);
    EXPECT_EQ(after.energy, 0);
}

}  // namespace
}  // namespace pendular::studiedCollisionTest
