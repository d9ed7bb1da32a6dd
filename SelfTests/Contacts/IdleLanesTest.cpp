#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/IdleLanes.h"

#include <gtest/gtest.h>

namespace pendular::idleLanesTest {
namespace {

/// Blocks of pairs, and one of a wall, of which each has so many lanes that touch.
ContactStore storeWith(std::size_t blocks, int touchingLanes) {
    ContactStore store;
    const auto pairs = static_cast<std::uint32_t>(blocks);
    store.buckets = {{.begin = 0, .end = pairs}, {.begin = pairs, .end = pairs + 1, .wall = 0}};
    const auto bits = static_cast<std::uint8_t>((1u << touchingLanes) - 1);
    store.states.assign(blocks + 1, {.listed = 0xff, .touching = bits});
    return store;
}

// 100 blocks of which each has lost 3 of 8 pairs: 300 lanes at 13 ns for 64 steps are 249 600 ns from one
// count to the next.
TEST(IdleLanes, areWorthAListWhenTheyHaveCostAsMuch) {
    const ContactStore full = storeWith(100, 8), thinned = storeWith(100, 5);
    IdleLanes idle;
    EXPECT_FALSE(idle.newListPays(full, 1e6));
    for (int count = 1; count <= 4; ++count) EXPECT_FALSE(idle.newListPays(thinned, 1e6)) << count;
    EXPECT_TRUE(idle.newListPays(thinned, 1e6));
    idle.listed();
    EXPECT_FALSE(idle.newListPays(thinned, 1e6));
}

// What a list has left idle, no other list fills.
TEST(IdleLanes, countFromThoseThatTheListLeft) {
    const ContactStore half = storeWith(1000, 4);
    IdleLanes idle;
    for (int count = 0; count < 100; ++count) EXPECT_FALSE(idle.newListPays(half, 1e3)) << count;
}

// A block in which nothing acts is not computed to its end; bridges act.
TEST(IdleLanes, areThoseOfBlocksThatAct) {
    const ContactStore full = storeWith(100, 8), none = storeWith(100, 0);
    IdleLanes parted;
    EXPECT_FALSE(parted.newListPays(full, 1e3));
    EXPECT_FALSE(parted.newListPays(none, 1e3));
    ContactStore bridged = storeWith(100, 8);
    for (BlockState& state : bridged.states) state = {.listed = 0xff, .touching = 1, .bridged = 0xfe};
    IdleLanes wet;
    EXPECT_FALSE(wet.newListPays(full, 1e3));
    EXPECT_FALSE(wet.newListPays(bridged, 1e3));
}

}  // namespace
}  // namespace pendular::idleLanesTest
