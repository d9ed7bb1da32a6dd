#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

#include "Kernel/Core/Particles/PlaceIndex.h"

namespace pendular::placeIndexTest {
namespace {

TEST(PlaceIndex, isAMapFromIdentitiesToPlaces) {
    std::mt19937 engine(1);
    PlaceIndex index;
    std::map<std::uint32_t, std::uint32_t> expected;
    for (int k = 0; k < 20000; ++k) {
        const std::uint32_t identity = engine() % 6000, place = engine() % 100000;
        if (engine() % 3 == 0) {
            index.erase(identity);
            expected.erase(identity);
        } else {
            index.set(identity, place);
            expected[identity] = place;
        }
    }
    ASSERT_EQ(index.size(), expected.size());
    for (std::uint32_t identity = 0; identity < 7000; ++identity) {
        const auto found = expected.find(identity);
        EXPECT_EQ(index[identity], found == expected.end() ? PlaceIndex::none : found->second);
    }
    std::vector<std::uint32_t> places;
    for (const auto& [identity, place] : expected) places.push_back(place);
    EXPECT_EQ(std::vector<std::uint32_t>(index.begin(), index.end()), places);
}

// It keeps, of a million grains that come and go, a hundred at a time, some pages of a thousand numbers and a
// few bytes for each page that is gone.
TEST(PlaceIndex, doesNotGrowAsGrainsComeAndGo) {
    PlaceIndex index;
    for (std::uint32_t identity = 0; identity < 1000000; ++identity) {
        index.set(identity, identity % 100);
        if (identity >= 100) index.erase(identity - 100);
    }
    EXPECT_EQ(index.size(), 100u);
    EXPECT_LT(index.bytes(), 2 * 4096u + 1000000 / 1024 * 2 * 28u);
    EXPECT_EQ(*index.begin(), 0u);
}

TEST(PlaceIndex, mayBeEmpty) {
    PlaceIndex index;
    EXPECT_EQ(index.begin(), index.end());
    index.set(5000, 1);
    index.erase(5000);
    index.erase(7);
    EXPECT_TRUE(index.empty());
    EXPECT_EQ(index.begin(), index.end());
    EXPECT_EQ(index[5000], PlaceIndex::none);
}

}  // namespace
}  // namespace pendular::placeIndexTest
