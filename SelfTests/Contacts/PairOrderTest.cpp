#include "Kernel/Core/Contacts/PairOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "SelfTests/Support/Random.h"

namespace pendular::pairOrderTest {
namespace {

constexpr double width = 1e-4;  // m

std::vector<std::uint32_t> numbersOf(const std::vector<ListedPair>& pairs) {
    std::vector<std::uint32_t> numbers;
    for (const ListedPair& pair : pairs) numbers.push_back(pair.first);
    return numbers;
}

/// Gaps of all sizes, of either sign, or zero.
std::vector<ListedPair> randomPairs(std::uint32_t count, support::Random& random) {
    const auto gap = [&] {
        const double size = width * std::pow(10, random.uniform(-9, 0.5));
        const double kind = random.uniform(0, 1);
        return static_cast<float>(kind < 0.45 ? size : kind < 0.9 ? -size : 0);
    };
    std::vector<ListedPair> pairs;
    for (std::uint32_t k = 0; k < count; ++k) pairs.push_back({k, 0, gap(), gap()});
    return pairs;
}

TEST(PairOrder, isThatOfAStableSortByClass) {
    support::Random random(1);
    const PairOrder order(width);
    PairOrder::Buffer buffer;
    for (const std::uint32_t count : {0u, 1u, 2u, 7u, 100u, 2048u, 31u}) {
        std::vector<ListedPair> pairs = randomPairs(count, random), sorted = pairs;
        std::ranges::stable_sort(sorted, {}, [&](const ListedPair& pair) { return order.classOf(pair); });
        order.sort(pairs, buffer);
        EXPECT_EQ(numbersOf(pairs), numbersOf(sorted));
    }
}

// Those that touch come first, then those that meet, then the others; among those that part and those that
// stay apart the expected gap does not fall from one class to the next.
TEST(PairOrder, putsPairsThatBeginOrEndToTouchTogether) {
    support::Random random(2);
    const PairOrder order(width);
    std::vector<ListedPair> pairs = randomPairs(2000, random);
    PairOrder::Buffer buffer;
    const auto kindOf = [](const ListedPair& pair) {
        if (pair.gap <= 0) return pair.soon > 0 ? 1 : 0;
        return pair.soon > 0 ? 3 : 2;
    };
    order.sort(pairs, buffer);
    EXPECT_TRUE(std::ranges::is_sorted(pairs, {}, kindOf));
    // A class of pairs apart spans at most a factor of 3/2, of pairs that part an eighth of a quarter of the
    // width.
    for (std::size_t k = 1; k < pairs.size(); ++k) {
        const double before = pairs[k - 1].soon, now = pairs[k].soon;
        if (kindOf(pairs[k - 1]) != kindOf(pairs[k]) || kindOf(pairs[k]) % 2 == 0 || before >= width ||
            before < 1e-5 * width)
            continue;
        const double fall = width / 32 * 1.0001;  // rounded
        EXPECT_GE(now, kindOf(pairs[k]) == 3 ? before / 1.5 : std::min(before, 7 * width / 32) - fall);
    }
}

TEST(PairOrder, keepsPairsThatGoOnToTouchInTheirOrder) {
    const PairOrder order(width);
    std::vector<ListedPair> pairs{{0, 0, -2e-6F, -1e-6F}, {1, 0, 3e-6F, 2e-6F}, {2, 0, -5e-6F, -9e-6F},
                                  {3, 0, 1e-6F, -1e-6F},  {4, 0, -1e-7F, 0},    {5, 0, -1e-7F, 9e-5F},
                                  {6, 0, -1e-9F, 1e-6F}};
    PairOrder::Buffer buffer;
    order.sort(pairs, buffer);
    EXPECT_EQ(numbersOf(pairs), (std::vector<std::uint32_t>{0, 2, 4, 6, 5, 3, 1}));
}

TEST(PairOrder, hasAClassForEveryNumber) {
    constexpr float huge = std::numeric_limits<float>::infinity(),
                    none = std::numeric_limits<float>::quiet_NaN(),
                    tiny = std::numeric_limits<float>::denorm_min();
    for (const double of : {0.0, 1e-40, 1e-4, 1e30})
        for (const float gap : {-huge, -1.0F, -tiny, -0.0F, 0.0F, tiny, 1.0F, huge})
            for (const float soon : {-huge, -1.0F, -tiny, 0.0F, tiny, 1e-5F, 1.0F, huge, none})
                EXPECT_LT(PairOrder(of).classOf({0, 0, gap, soon}), PairOrder::classes);
}

}  // namespace
}  // namespace pendular::pairOrderTest
