#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeYoungLaplace.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/Refusal.h"

// The exact law in SI units. How near its table is to the solver is tested with the table, in
// SelfTests/Capillary.

namespace pendular::youngLaplaceTest {
namespace {

using std::numbers::pi;

LiquidBridgeYoungLaplace bridge(double volume, double contactAngle, double surfaceTension = 0.07) {
    LiquidBridgeYoungLaplace law;
    law.setLiquidBridgeVolume(volume);
    law.setContactAngle(contactAngle);
    law.setSurfaceTension(surfaceTension);
    return law;
}

// 5e-3 and 2e-3: the largest errors that the table may have.
TEST(YoungLaplace, isTheSolverInSiUnits) {
    support::Draw draw(1);
    for (int k = 0; k < 60; ++k) {
        const double r1 = draw.logarithmic(1e-6, 1e-2),
                     r2 = draw.oneIn(4) ? infinity : r1 * draw.logarithmic(1, 20);
        const double radius = 2 * Bodies{r1, r2}.effectiveRadius();
        const double volume = draw.logarithmic(1e-6, 0.5) * radius * radius * radius;
        const double theta = draw.uniform(0, 1), tension = draw.uniform(0.02, 0.08);
        const auto law = bridge(volume, theta, tension);
        const auto interaction = law.prepare(Bodies{r1, r2});
        const BridgeConditions conditions{{r1, theta}, {r2, theta}, volume};
        EXPECT_NEAR(interaction.range() / findRupture(conditions)->last.gap(), 1, 2e-3);
        for (const double share : {0.0, 0.2, 0.7, 0.94}) {
            const double s = share * interaction.range();
            const auto exact = solveBridge(conditions, s);
            ASSERT_TRUE(exact);
            EXPECT_NEAR(interaction.force(s) / (tension * exact->force()), 1, 5e-3);
            EXPECT_NEAR(law.lateralArea(Bodies{r1, r2}, s) / exact->lateralArea(), 1, 2e-2);
        }
    }
}

// Found elsewhere by other programs, to the digits given: the cases of Figures 3 and 4 of Bagheri et al.
TEST(YoungLaplace, agreesWithOtherPrograms) {
    const Bodies bodies{0.5e-3, 0.8e-3};
    const auto small = bridge(10e-12, 0, 0.079).prepare(bodies),
               large = bridge(80e-12, 0, 0.079).prepare(bodies);
    EXPECT_NEAR(1e6 * small.force(0.0), 253.1, 1e-3 * 253.1);
    EXPECT_NEAR(1e6 * large.force(0.0), 213.3, 1e-3 * 213.3);
    EXPECT_NEAR(1e3 * small.range(), 0.2149, 1e-3 * 0.2149);
    EXPECT_NEAR(1e3 * large.range(), 0.4288, 1e-3 * 0.4288);
}

TEST(YoungLaplace, pushesOnlyWithPinnedContactLines) {
    const Bodies bodies{1e-3, 1e-3};
    auto law = bridge(1e-10, 2.3);
    EXPECT_EQ(law.prepare(bodies).force(0.0), 0);
    law.setPinned(true);
    const double exact = 0.07 * solveBridge({{1e-3, 2.3}, {1e-3, 2.3}, 1e-10}, 0)->pinnedForce();
    EXPECT_LT(exact, 0);
    EXPECT_NEAR(law.prepare(bodies).force(0.0) / exact, 1, 1e-3);
    // There is no difference where it pulls.
    law = bridge(1e-10, 0.5);
    const double free = law.prepare(bodies).force(1e-5);
    law.setPinned(true);
    EXPECT_EQ(law.prepare(bodies).force(1e-5), free);
}

TEST(YoungLaplace, objectsToVolumesOutsideOfTheTable) {
    const Bodies bodies{1, 1};
    for (const double inside : {BridgeTable::leastVolume, 1e-3, BridgeTable::mostVolume})
        EXPECT_FALSE(bridge(inside, 0.5).objection(bodies)) << inside;
    for (const double outside : {0.999 * BridgeTable::leastVolume, 1.001 * BridgeTable::mostVolume}) {
        auto law = bridge(outside, 0.5);
        const auto objection = law.objection(bodies);
        ASSERT_TRUE(objection);
        EXPECT_TRUE(support::isOneSentence(*objection));
        for (const auto part : {"LiquidBridgeYoungLaplace", "contactAngle = 0.5 rad", "liquidBridgeVolume",
                                "m^3", "1e-07 to 0.5", "), so take another volume or",
                                "setSolveOutsideTable(true)", "--solve-outside-table."})
            EXPECT_TRUE(support::contains(*objection, part));
        law.setSolveOutsideTable(true);
        EXPECT_FALSE(law.objection(bodies));
    }
}

// The volume is divided by R^3, and so an edge is seldom hit to the last digit; it is not to be refused then.
TEST(YoungLaplace, takesTheEdgesOfTheTableAtEveryRadius) {
    support::Draw draw(3);
    int beyond = 0;
    for (int k = 0; k < 200; ++k) {
        const double r = draw.logarithmic(1e-6, 1e-2);
        for (const double edge : {BridgeTable::leastVolume, BridgeTable::mostVolume}) {
            const auto law = bridge(edge * r * r * r, 0.3), one = bridge(edge, 0.3);
            const Bodies bodies{r, r}, unit{1, 1};
            const double volume = law.shape(bodies).volume;
            if (volume < BridgeTable::leastVolume || volume > BridgeTable::mostVolume) ++beyond;
            EXPECT_FALSE(law.objection(bodies)) << r;
            EXPECT_NEAR(law.range(bodies) / r / one.range(unit), 1, 1e-12) << r;
            EXPECT_NEAR(law.prepare(bodies).force(0.0) / r / one.prepare(unit).force(0.0), 1, 1e-12) << r;
        }
    }
    EXPECT_GT(beyond, 10);
}

// What is refused is never written like the edge that it is said to be beyond.
TEST(YoungLaplace, refusalDoesNotContradictItself) {
    const Bodies bodies{1, 1};
    for (const double share : {1.1e-6, 1e-5}) {
        const auto large = bridge(BridgeTable::mostVolume * (1 + share), 0.5).objection(bodies),
                   small = bridge(BridgeTable::leastVolume * (1 - share), 0.5).objection(bodies);
        ASSERT_TRUE(large && small);
        EXPECT_FALSE(support::contains(*large, "liquidBridgeVolume/R^3 = 0.5 ")) << *large;
        EXPECT_FALSE(support::contains(*small, "liquidBridgeVolume/R^3 = 1e-07 ")) << *small;
    }
}

// 1 %: see BridgeTable.canBeSolvedForOtherVolumes.
TEST(YoungLaplace, canSolveOutsideOfTheTable) {
    const Bodies bodies{2, 3};
    const double radius = 2 * bodies.effectiveRadius();
    for (const double volume : {1e-9, 1.5}) {
        const double v = volume * radius * radius * radius;
        auto law = bridge(v, 0.4);
        law.setSolveOutsideTable(true);
        const auto interaction = law.prepare(bodies);
        const BridgeConditions conditions{{2, 0.4}, {3, 0.4}, v};
        EXPECT_NEAR(interaction.range() / findRupture(conditions)->last.gap(), 1, 1e-9);
        EXPECT_EQ(interaction.range(), law.range(bodies));
        for (const double share : {0.0, 0.5, 0.9}) {
            const auto exact = solveBridge(conditions, share * interaction.range());
            EXPECT_NEAR(interaction.force(share * interaction.range()) / (0.07 * exact->force()), 1, 1e-2);
            EXPECT_NEAR(law.lateralArea(bodies, share * interaction.range()) / exact->lateralArea(), 1, 1e-9);
        }
    }
}

// At the joint of table and solver the force changes by no more than the table's error.
TEST(YoungLaplace, tableAndSolverMeetAtTheEdge) {
    const Bodies bodies{1, 1};
    for (const double edge : {BridgeTable::leastVolume, BridgeTable::mostVolume})
        for (const double theta : {0.0, 0.4, 0.8}) {
            const bool isLeast = edge == BridgeTable::leastVolume;
            auto outside = bridge(edge * (isLeast ? 1 - 2e-6 : 1 + 2e-6), theta);
            outside.setSolveOutsideTable(true);
            const auto one = bridge(edge, theta).prepare(bodies), other = outside.prepare(bodies);
            EXPECT_NEAR(one.range() / other.range(), 1, 2e-3);
            for (const double share : {0.0, 0.4, 0.9})
                EXPECT_NEAR(one.force(share * one.range()) / other.force(share * one.range()), 1, 5e-3);
        }
}

// The neighbour search looks as far as the extremes of the sizes reach (Kernel/Core/Contacts/ContactList.h).
TEST(YoungLaplace, reachesFarthestBetweenExtremesOfTheSizes) {
    support::Draw draw(2);
    for (int k = 0; k < 300; ++k) {
        const double smallest = draw.logarithmic(0.3, 1), largest = 1;
        const auto law = bridge(draw.logarithmic(1e-4, 1e-2), draw.uniform(0, 1.5));
        double farthest = 0;
        for (const double r1 : {smallest, largest})
            for (const double r2 : {smallest, largest})
                farthest = std::max(farthest, law.range(Bodies{r1, r2}));
        for (int pair = 0; pair < 20; ++pair) {
            const Bodies bodies{draw.uniform(smallest, largest), draw.uniform(smallest, largest)};
            EXPECT_LE(law.range(bodies), farthest * (1 + 2e-3))  // error of the table
                << bodies.radius1 << " " << bodies.radius2 << " of " << smallest << " to 1";
        }
    }
}

// F at contact, for small volumes: 1 - (pi/8) (2/pi)^(1/4) V*^(1/4) of 2 pi R gamma at theta = 0, with the
// next term of the order V*^(1/2).
TEST(YoungLaplace, tendsToDerjaguinsForceForSmallVolumes) {
    const Bodies bodies{1, 1};
    for (const double volume : {1e-7, 1e-6, 1e-5}) {
        const double share = bridge(volume, 0, 0.5 / pi).prepare(bodies).force(0.0);
        const double root = std::pow(volume, 0.25);
        EXPECT_NEAR(share, 1 - pi / 8 * std::pow(2 / pi, 0.25) * root, root * root + 1e-3);
    }
}

}  // namespace
}  // namespace pendular::youngLaplaceTest
