#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Foundation/Math/CountedRandom.h"

namespace pendular::countedRandomTest {
namespace {

using Block = CountedRandom::Block;

// The known answers that the authors publish with their code (Random123, kat_vectors).
TEST(CountedRandom, isThePublishedFunction) {
    EXPECT_EQ(CountedRandom::philox({0, 0, 0, 0}, {0, 0}),
              (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(CountedRandom::philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
              (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(
        CountedRandom::philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
        (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

// Mean 1/2, variance 1/12, and no correlation between neighbours in each of the counts: within four standard
// deviations of the mean of n numbers, sqrt(1/12 / n), and of the correlation, 1/12 / sqrt(n).
TEST(CountedRandom, isEvenAndWithoutCorrelation) {
    const CountedRandom random(7);
    constexpr int n = 100000;
    double mean = 0, square = 0, identity = 0, purpose = 0, number = 0;
    for (std::uint32_t k = 0; k < n; ++k) {
        const double x = random.uniform(k, 1) - 0.5;
        mean += x / n;
        square += x * x / n;
        identity += x * (random.uniform(k + 1, 1) - 0.5) / n;
        purpose += x * (random.uniform(k, 2) - 0.5) / n;
        number += x * (random.uniform(k, 1, 1) - 0.5) / n;
        ASSERT_TRUE(x >= -0.5 && x < 0.5);
    }
    EXPECT_LT(std::abs(mean), 4 * std::sqrt(1.0 / 12 / n));
    EXPECT_NEAR(square, 1.0 / 12, 4 * std::sqrt(1.0 / 180 / n));  // the variance of x^2 is 1/180
    for (const double correlation : {identity, purpose, number})
        EXPECT_LT(std::abs(correlation), 4.0 / 12 / std::sqrt(n));
    EXPECT_NE(CountedRandom(8).uniform(1, 1), random.uniform(1, 1));
    EXPECT_EQ(random.uniform(2, 4, 9, 1), 2 + 2 * random.uniform(9, 1));
}

}  // namespace
}  // namespace pendular::countedRandomTest
