#include "Kernel/Foundation/Math/Halving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pendular::halvingTest {
namespace {

const auto isBelowRoot = [](double x) { return x * x < 2; };

// Without a limit the two are neighbours, on both sides of where the statement turns; whichever is lower.
TEST(Halving, endsBetweenNeighbours) {
    const TurningPoint root = turningPoint(0, 7, isBelowRoot);
    EXPECT_TRUE(isBelowRoot(root.holds));
    EXPECT_FALSE(isBelowRoot(root.fails));
    EXPECT_EQ(std::nextafter(root.holds, 2), root.fails);
    const TurningPoint other = turningPoint(7, 0, [](double x) { return !isBelowRoot(x); });
    EXPECT_EQ(other.holds, root.fails);
    EXPECT_EQ(other.fails, root.holds);
    // Also down to the smallest number that there is.
    EXPECT_EQ(turningPoint(0, 1, [](double x) { return !(x > 0); }).fails,
              std::numeric_limits<double>::denorm_min());
}

TEST(Halving, makesTheIntervalShorterByAPowerOfTwo) {
    const TurningPoint root = turningPoint(1, 2, isBelowRoot, 10);
    EXPECT_EQ(root.fails - root.holds, std::ldexp(1, -10));
    EXPECT_LE(root.holds, std::sqrt(2));
    EXPECT_GE(root.fails, std::sqrt(2));
}

}  // namespace
}  // namespace pendular::halvingTest
