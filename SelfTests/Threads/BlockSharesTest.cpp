#include "Kernel/Core/Contacts/BlockShares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace pendular::blockSharesTest {
namespace {

constexpr std::uint32_t active = 8;  // a place in the memory

/// A list whose stretches begin with active blocks, more of them towards its end.
std::vector<std::uint32_t> slotsOfList(std::size_t blocks) {
    constexpr std::size_t stretch = 256;
    std::vector<std::uint32_t> slots(blocks, ContactStore::asleep);
    for (std::size_t k = 0; k < blocks; ++k)
        if (k % stretch < 20 + 200 * k / blocks) slots[k] = active;
    return slots;
}

TEST(BlockShares, giveThreadsTheSameWork) {
    const std::vector<std::uint32_t> slots = slotsOfList(6000);
    constexpr std::size_t begin = 100, end = 5700;
    // An inactive block counts a sixteenth.
    const auto workOf = [&](std::size_t first, std::size_t last) {
        double sum = 0;
        for (std::size_t k = first; k < last; ++k) sum += slots[k] == active ? 1 : 1 / 16.0;
        return sum;
    };
    for (const int threads : {2, 3, 7}) {
        const BlockShares shares(slots, begin, end, threads);
        const std::span<const std::size_t> ranges = shares.ranges();
        ASSERT_EQ(ranges.size(), static_cast<std::size_t>(threads) + 1);
        EXPECT_EQ(ranges.front(), begin);
        EXPECT_EQ(ranges.back(), end);
        ASSERT_TRUE(std::ranges::is_sorted(ranges));
        // A block is not divided.
        for (std::size_t k = 0; k < static_cast<std::size_t>(threads); ++k)
            EXPECT_NEAR(workOf(ranges[k], ranges[k + 1]), workOf(begin, end) / threads, 2);
        EXPECT_GT(shares.length(), 0u);
    }
}

TEST(BlockShares, haveOneRangeForOneThread) {
    const std::vector<std::uint32_t> slots = slotsOfList(300);
    const BlockShares shares(slots, 7, 293, 1);
    ASSERT_EQ(shares.ranges().size(), 2u);
    EXPECT_EQ(shares.ranges()[0], 7u);
    EXPECT_EQ(shares.ranges()[1], 293u);
}

TEST(BlockShares, ofABucketWithoutActiveBlocksAreOfTheSameLength) {
    const std::vector<std::uint32_t> slots(4096, ContactStore::asleep);
    const BlockShares shares(slots, 0, slots.size(), 2);
    ASSERT_EQ(shares.ranges().size(), 3u);
    EXPECT_EQ(shares.ranges()[1], 2048u);
}

}  // namespace
}  // namespace pendular::blockSharesTest
