#include "Kernel/Core/Contacts/Rearrangement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "Kernel/Core/Contacts/ContactStore.h"

namespace pendular::rearrangementTest {
namespace {

constexpr std::uint32_t nothing = Rearrangement::nothing;

/// New places for some of the old ones, at random.
std::vector<std::uint32_t> randomOrigins(std::size_t oldCount, std::size_t newCount, std::mt19937& random) {
    std::vector<std::uint32_t> origins(std::max(oldCount, newCount), nothing);
    std::iota(origins.begin(), origins.begin() + static_cast<std::ptrdiff_t>(oldCount), 0u);
    std::ranges::shuffle(origins, random);
    origins.resize(newCount);
    return origins;
}

/// What a rearrangement in place must come to, by a copy.
void requireSame(const std::vector<std::uint32_t>& origins, std::size_t oldCount, int threads) {
    const Rearrangement order(origins, oldCount);
    std::vector<double> values(std::max(origins.size(), oldCount));
    std::iota(values.begin(), values.end(), 100.0);
    const std::vector<double> before = values;
    order.carryOut(
        threads, [&](std::uint32_t k) { return values[k]; },
        [&](std::uint32_t k, double value) { values[k] = value; });
    std::vector<std::uint32_t> empty;
    for (std::uint32_t k = 0; k < origins.size(); ++k) {
        if (origins[k] == nothing) empty.push_back(k);
        else ASSERT_EQ(values[k], before[origins[k]]) << "at place " << k;
    }
    EXPECT_EQ(order.emptyPlaces(), empty);
    EXPECT_EQ(order.places(), values.size());
    std::ranges::sort(values);  // nothing is lost
    EXPECT_EQ(values, before);
}

TEST(Rearrangement, bringsEachToItsPlace) {
    requireSame({}, 0, 1);
    requireSame({0, 1, 2}, 3, 1);
    requireSame({2, 0, 1}, 3, 1);
    requireSame({nothing, nothing}, 5, 1);
    requireSame({4, nothing, 0, nothing, nothing, nothing, nothing}, 5, 1);
    std::mt19937 random(1);
    for (const std::size_t oldCount : {0, 1000})
        for (const std::size_t newCount : {500, 1000, 1300})
            for (const int threads : {1, 3})
                requireSame(randomOrigins(oldCount, newCount, random), oldCount, threads);
}

TEST(Rearrangement, bringsAllThatAContactRemembers) {
    ContactMemory memory;
    memory.setLayout({.history = 3,
                      .normalHistory = 1,
                      .interaction = 5,
                      .liquid = ContactMemory::liquidNumbers,
                      .named = 2,
                      .hasTorque = true,
                      .hasContactTorque = true});
    memory.reset(true, 3);
    const std::size_t width = memory.numberCount();
    EXPECT_EQ(width, 3u + 1 + 5 + 2 + 2 + 8 + 4);
    const auto numbersOf = [&](std::size_t slot) {
        std::vector<double> numbers(width);
        memory.getNumbers(slot, numbers.data());
        return numbers;
    };
    const auto originalOf = [&](std::size_t slot) {
        std::vector<double> numbers(width);
        std::iota(numbers.begin(), numbers.end(), 1000.0 * static_cast<double>(slot));
        return numbers;
    };
    for (std::size_t slot = Pack::lanes; slot < memory.slotCount(); ++slot) {
        memory.setNumbers(slot, originalOf(slot).data());
        memory.energies[slot].now.adhesiveForce = static_cast<double>(slot);
    }
    // Block 0 stays; one new block, of slots of all three old ones.
    std::vector<std::uint32_t> origins{0, 1, 2, 3, 4, 5, 6, 7, 31, 8, nothing, 20, 16, nothing, 9, nothing};
    memory.rearrange(origins, {0, 77}, 1);
    ASSERT_EQ(memory.slotCount(), 2 * Pack::lanes);
    EXPECT_EQ(memory.blockOf[1], 77u);
    for (std::size_t slot = Pack::lanes; slot < memory.slotCount(); ++slot) {
        const bool isEmpty = origins[slot] == nothing;
        EXPECT_EQ(numbersOf(slot), isEmpty ? std::vector<double>(width) : originalOf(origins[slot]));
        EXPECT_EQ(memory.energies[slot].now.adhesiveForce, isEmpty ? 0 : origins[slot]);
    }
}

}  // namespace
}  // namespace pendular::rearrangementTest
