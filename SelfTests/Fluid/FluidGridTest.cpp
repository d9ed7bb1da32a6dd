#include "Kernel/Features/Fluid/FluidGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "SelfTests/Support/Refusal.h"

namespace pendular::fluidGridTest {
namespace {

constexpr FluidGrid grid{{-1, 0, 2}, {1, 3, 6}, {4, 1, 5}};

/// Points in the grid, one after the other by the golden ratio and its kin.
Vector<double> pointOf(int k) {
    const auto part = [&](double ratio) { return std::fmod(k * ratio, 1.0); };
    return {-1 + 2 * part(0.8191725134), 3 * part(0.6710436067), 2 + 4 * part(0.5497004779)};
}

TEST(FluidGrid, sharesSumToOneAndAreNotNegative) {
    for (int k = 0; k < 500; ++k) {
        double sum = 0;
        for (const CellShare& own : sharesAt(grid, pointOf(k))) {
            EXPECT_GE(own.share, 0);
            EXPECT_LT(own.cell, grid.size());
            sum += own.share;
        }
        EXPECT_NEAR(sum, 1, 4e-16);
    }
}

// A field that is linear between the centres of cells is read as it is; beyond the outermost ones it is
// constant.
TEST(FluidGrid, readsALinearFieldAsItIs) {
    std::vector<double> field;
    for (int k = 0; k < 5; ++k)
        for (int i = 0; i < 4; ++i) field.push_back(3 * (-0.75 + 0.5 * i) - 2 * (2.4 + 0.8 * k));
    for (int k = 0; k < 500; ++k) {
        const Vector<double> p = pointOf(k);
        const double known = 3 * std::clamp(p.x, -0.75, 0.75) - 2 * std::clamp(p.z, 2.4, 5.6);
        EXPECT_NEAR(meanOf(field, sharesAt(grid, p)), known, 2e-14);
    }
}

TEST(FluidGrid, refusesWhatCannotBe) {
    EXPECT_TRUE(support::isOneSentence(support::refusal([] {
        FluidGrid{{0, 0, 0}, {1, 0, 1}, {1, 1, 1}}.check();
    })));
    EXPECT_TRUE(support::isOneSentence(support::refusal([] {
        FluidGrid{{0, 0, 0}, {1, 1, 1}, {1, 0, 1}}.check();
    })));
    EXPECT_TRUE(support::isOneSentence(support::refusal([] {
        FluidGrid{{0, 0, 0}, {1, 1, 1}, {10000, 10000, 10000}}.check();
    })));
}

}  // namespace
}  // namespace pendular::fluidGridTest
