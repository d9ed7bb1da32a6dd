#include <gtest/gtest.h>

#include "Tools/Studies/AccuracyVersusCost/SceneComparison.h"

namespace pendular::refusalTest {
namespace {

struct RefusedScene {
    std::string reason;
    void initialise() const { throw InputError(reason); }
};
struct TakenScene {
    void initialise() const {}
};

/// The bed, then the cell once for each of three seeds.
TEST(BridgeScenes, tellARefusalOnce) {
    LawInScenes law{.law = "Law"};
    EXPECT_FALSE(isRefused(TakenScene(), law));
    for (const std::string reason : {"no walls.", "too wet.", "too wet.", "too wet."})
        EXPECT_TRUE(isRefused(RefusedScene{reason}, law));
    EXPECT_EQ(law.refusals, (std::vector<std::string>{"no walls.", "too wet."}));
}

}  // namespace
}  // namespace pendular::refusalTest
