// The measures of the driver RodPacking, and what it writes.
#include <gtest/gtest.h>

#include "Drivers/RodPacking/RodBed.h"
#include "SelfTests/Drivers/DriverRun.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::rodPackingTest {
namespace {

using driverRuns::rowsOf;

/// A bed without output.
RodBedOptions fewRods() {
    RodBedOptions options;
    options.number = 60;
    options.run = {.output = "", .quiet = true};
    return options;
}

// Two spheres of diameter 1 with centres 0.4 apart share two caps of height 0.3: pi h^2 (3 r - h) / 3 each.
TEST(RodPacking, hasRodsOfTheRightLengthAndVolume) {
    const ClumpTemplate rod = rodOf(1.4, 0.5);
    EXPECT_EQ(rod.getSpheres().size(), 2u);
    EXPECT_NEAR(rod.getReach(), 0.7, 1e-12);
    const double cap = constants::pi * 0.09 * (1.5 - 0.3) / 3;
    EXPECT_NEAR(rod.getVolume(), constants::pi / 3 - 2 * cap, 1e-9);
    EXPECT_TRUE(rodOf(1, 0.5).isSphere());
    EXPECT_EQ(rodOf(1.6, 0.3).getSpheres().size(), 3u);  // 0.6 / 0.3 is 2 gaps, whatever the rounding
}

// Rods that overlap nothing fill a layer around them all with their own volumes. Points of a square grid with
// the step h miss the area of a circle by some (h / r)^(3/2) / pi of it (Kendall, Quart. J. Math. 19 (1948)
// 1): h is 0.024 d and the smallest r 0.3 d, 0.7 %, with a random sign for each of 60 rods: 0.1 %, and twice
// that.
TEST(RodPacking, measuresTheVolumeOfRodsThatOverlapNothing) {
    for (const double aspect : {1.0, 2.0}) {
        RodBed bed(fewRods(), aspect);
        bed.initialise();
        const RodBed::Layer all{0, bed.fillHeight()};
        double mass = 0;  // kg
        for (std::size_t k = 0; k < bed.bodyHandler.getSize(); ++k)
            mass += bed.bodyHandler.getObject(k).getMass();
        const double volume = mass / bed.speciesHandler.getObject(0)->getDensity();
        EXPECT_NEAR(bed.solidFraction(all) * bed.width() * bed.width() * all.top / volume, 1, 2e-3) << aspect;
        const RodBed::Means means = bed.meansOf(all);
        EXPECT_EQ(means.rods, 60);
        EXPECT_EQ(means.neighbours, 0);
        // Even directions: five standard errors of (3 cos^2 - 1) / 2, whose variance is 1/5.
        EXPECT_NEAR(means.order, 0, aspect > 1 ? 5 * std::sqrt(0.2 / 60) : 0);
    }
}

TEST(RodPacking, writesARowForEachAspectRatio) {
    const support::TestFolder folder;
    const auto result = support::run(
        driverRuns::drivers + "/RodPacking/RodPacking --quiet --number 30 --aspects 1 1.4 --width 3.5 " +
        folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto rows = rowsOf(folder.path() / "packing.csv");
    ASSERT_EQ(rows.size(), 2u);
    for (const auto& row : rows) {
        EXPECT_LT(row[9], 1e-4);           // at rest
        EXPECT_GT(row[4], 0.45);           // looser than any bed at rest without friction
        EXPECT_LT(row[4], 0.7405 + 0.01);  // denser than any bed of equal spheres
        EXPECT_GE(row[6], row[5]);         // a neighbour has a contact at least
        EXPECT_GT(row[5], 2);
    }
    EXPECT_EQ(rows[0][7], 0);
    support::expectOneSentence(
        support::run(driverRuns::drivers + "/RodPacking/RodPacking --aspects 1 15 " + folder.option()),
        "--width");
}

}  // namespace
}  // namespace pendular::rodPackingTest
