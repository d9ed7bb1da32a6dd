// The measures of the driver EllipsoidPacking, and what it writes.
#include <gtest/gtest.h>

#include "Drivers/EllipsoidPacking/EllipsoidBed.h"
#include "SelfTests/Drivers/DriverRun.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::ellipsoidPackingTest {
namespace {

using driverRuns::rowsOf;

// The share of an ellipsoid below a plane at x h from its centre, with the support function h up and down, is
// that of a sphere, (2 + 3 x - x^3) / 4. The plane cuts up to 24^2 of the 24^3 cells in which the points are,
// each wrong by up to a half with random signs: some 24 / 2 of 24^3 pi / 6 points, and five times that.
TEST(EllipsoidPacking, measuresTheShareOfAGrainInALayer) {
    const Superquadric shape = spheroidOf(1.7, 2);
    const double tolerance = 5 * 12 / (24 * 24 * 24 * constants::pi / 6);
    for (const Vec3D& direction : {Vec3D(0.31, 0.2, 0.9), Vec3D(1, -0.7, 0.2), Vec3D(0.1, 1, -0.5)}) {
        const Vec3D up = direction.normalized();
        const double h = Vec3D(shape.a * up.x(), shape.b * up.y(), shape.c * up.z()).norm();
        for (const double x : {-0.6, 0.0, 0.3, 0.8})
            EXPECT_NEAR(shareBetween(shape, up, 5, 0, 5 + x * h), (2 + 3 * x - x * x * x) / 4, tolerance);
    }
    EXPECT_EQ(shareBetween(shape, {0, 0, 1}, 5, 0, 10), 1);
    EXPECT_EQ(shareBetween(shape, {0, 0, 1}, 5, 8, 10), 0);
}

TEST(EllipsoidPacking, hasShapesOfVolumeOne) {
    for (const double aspect : {0.5, 1.0, 3.0})
        for (const int exponent : {2, 5, 8}) {
            const Superquadric shape = spheroidOf(aspect, exponent);
            EXPECT_NEAR(shape.volume(), 1, 1e-14);
            EXPECT_NEAR(shape.c / shape.a, aspect, 1e-14);
        }
}

TEST(EllipsoidPacking, writesARowForEachAspectRatio) {
    const support::TestFolder folder;
    const auto result =
        support::run(driverRuns::drivers +
                     "/EllipsoidPacking/EllipsoidPacking --quiet --number 30 --aspects 1 1.4 --width 4 "
                     "--friction 0.5 " +
                     folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto rows = rowsOf(folder.path() / "packing.csv");
    ASSERT_EQ(rows.size(), 2u);
    for (const auto& row : rows) {
        EXPECT_LT(row[8], 5e-4);           // at rest: of few grains without friction some go on to slide
        EXPECT_GT(row[3], 0.45);           // looser than any bed at rest
        EXPECT_LT(row[3], 0.7405 + 0.03);  // about the densest of equal spheres
        EXPECT_GT(row[4], 3);
        EXPECT_EQ(row[6], 0);  // fallbacks
    }
    support::expectOneSentence(
        support::run(driverRuns::drivers + "/EllipsoidPacking/EllipsoidPacking --exponent 1 " +
                     folder.option()),
        "--exponent");
}

}  // namespace
}  // namespace pendular::ellipsoidPackingTest
