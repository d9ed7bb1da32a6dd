/// The largest stable steps of viscous bridges in beds, measured, against closed forms.

#include <gtest/gtest.h>

#include <algorithm>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Tools/Studies/AccuracyVersusCost/DryingBridges.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousBed.h"

namespace pendular::viscousBedTest {
namespace {

// A motion of a chain that alternates has four times the resistance of a bridge over the mass, 2 c / m*; that
// of planes in a face-centred crystal twice it.
TEST(BridgeNetwork, hasTheFastestRatesOfCrystals) {
    EXPECT_NEAR(networks::pair().fastestRate(), 1, 1e-9);
    EXPECT_NEAR(networks::chain().fastestRate(), 2, 1e-9);
    EXPECT_NEAR(networks::simpleCubic().fastestRate(), 2, 1e-9);
    EXPECT_NEAR(networks::faceCentred().fastestRate(), 4, 1e-9);
    EXPECT_EQ(networks::faceCentred().bridgesOfAGrain(), 12);
}

// c dt / m*: explicitly with velocities that are not predicted 2, 1 and 0.5, with predicted ones half of
// that; own changes implicit and others predicted: none, 1 and 1/3.
TEST(ViscousBed, hasTheGivenLimitsInClosedForm) {
    const auto limit = [](std::string_view name, double rate) {
        return std::ranges::find(bedSchemes, name, &BedScheme::name)->limit(rate);
    };
    for (const auto& [rate, given] : {std::pair{1.0, 2.0}, {2.0, 1.0}, {4.0, 0.5}}) {
        EXPECT_DOUBLE_EQ(limit("explicit by velocity Verlet", rate), given);
        EXPECT_DOUBLE_EQ(limit("explicit", rate), 0.5 * given);
    }
    for (const std::string_view name : {"gap", "implicit"}) {
        EXPECT_EQ(limit(name, 1), infinity);
        EXPECT_NEAR(limit(name, 2), 1, 1e-9);
    }
    EXPECT_DOUBLE_EQ(limit("implicit", 4), 1.0 / 3);
    EXPECT_EQ(limit("gap for twelve neighbours", 4), infinity);
}

// A motion that grows tenfold in 2000 steps, from 1 in 30 of the largest speed, has a root of 1.003, and the
// root goes with the step or faster. A fastest rate that is found by multiplication is less exact in a random
// bed, by a part in 1e4. So 1 % above the limits motions grow, and 1 % below they do not.
TEST(HeavyViscousBed, isStableUpToTheClosedFormsForEachScheme) {
    for (const BridgeNetwork& network :
         {networks::pair(), networks::chain(), networks::faceCentred(), networks::random()}) {
        const double rate = network.fastestRate();
        for (const BedScheme& scheme : bedSchemes) {
            const double limit = scheme.limit(rate);
            const auto grows = [&](double x) { return ViscousBed(network, scheme, x).grows(); };
            if (std::isinf(limit)) EXPECT_FALSE(grows(1000)) << scheme.name << network.name;
            else EXPECT_TRUE(!grows(0.99 * limit) && grows(1.01 * limit)) << scheme.name << network.name;
        }
    }
}

// What the gap scheme and the implicit one are advised to is below where they fail.
TEST(ViscousBed, isAdvisedBelowTheLimits) {
    for (const BridgeNetwork& network : {networks::chain(), networks::faceCentred()})
        for (const BedScheme& scheme : {bedSchemes[0], bedSchemes[2]})
            EXPECT_LT(ViscousBed(network, scheme, 1).advised(), scheme.limit(network.fastestRate()))
                << network.name << scheme.name;
}

// The force of a bridge that is prepared late goes with the volume to a power of 1 at most where it is not
// near to its rupture; the threshold is what the volume may have changed.
TEST(DryingBridges, errMoreTheLaterTheyArePrepared) {
    const auto dry = [](double threshold) { return dryBridges<LiquidBridgeBagheri>(threshold, 1e-3, 4); };
    const StaleForce each = dry(0), some = dry(1e-2), few = dry(4e-2);
    EXPECT_EQ(each.largest, 0);
    EXPECT_EQ(each.beyondRupture, 0);
    EXPECT_GT(some.largest, 0);
    EXPECT_LT(some.rootMeanSquare, 1e-2);
    // The error is of first order in the threshold, preparations go with its inverse; volumes change by whole
    // steps of 1e-3, a tenth of the smaller threshold.
    EXPECT_NEAR(few.rootMeanSquare / some.rootMeanSquare, 4, 0.5);
    EXPECT_NEAR(some.preparations / few.preparations, 4, 0.5);
}

}  // namespace
}  // namespace pendular::viscousBedTest
