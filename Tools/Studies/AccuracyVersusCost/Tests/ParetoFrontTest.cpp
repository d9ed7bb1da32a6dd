#include "Tools/Studies/AccuracyVersusCost/ParetoFront.h"

#include <gtest/gtest.h>

#include <limits>

#include "SelfTests/Support/Draw.h"

namespace pendular::paretoFrontTest {
namespace {

using Flags = std::vector<bool>;

TEST(ParetoFront, isWhatNothingBeatsInBothNumbers) {
    EXPECT_EQ(paretoFront({{1, 9}, {2, 3}, {3, 4}, {4, 1}}), (Flags{true, true, false, true}));
    EXPECT_EQ(paretoFront({{5, 5}}), Flags{true});
    EXPECT_EQ(paretoFront({}), Flags{});
}

TEST(ParetoFront, holdsAllOfTheSameBestChoice) {
    EXPECT_EQ(paretoFront({{1, 2}, {1, 2}, {1, 3}, {2, 2}}), (Flags{true, true, false, false}));
}

TEST(ParetoFront, leavesOutWhatIsNotANumber) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(paretoFront({{1, none}, {none, 1}, {2, 2}}), (Flags{false, false, true}));
}

// The definition in another form: in the order of costs, a choice is on the front if its error is below all
// before.
TEST(ParetoFront, ofRandomChoicesDescends) {
    support::Draw draw(5);
    std::vector<CostAndError> choices;
    for (int k = 0; k < 200; ++k) choices.push_back({draw.uniform(0, 1), draw.uniform(0, 1)});
    std::sort(choices.begin(), choices.end(), [](auto& one, auto& other) { return one.cost < other.cost; });
    const Flags onFront = paretoFront(choices);
    double best = 2;
    for (std::size_t k = 0; k < choices.size(); ++k) {
        EXPECT_EQ(onFront[k], choices[k].error < best);
        best = std::min(best, choices[k].error);
    }
}

}  // namespace
}  // namespace pendular::paretoFrontTest
