#include "Drivers/Shared/SettledGrains.h"

#include <gtest/gtest.h>

#include "SelfTests/Support/Refusal.h"

namespace pendular::settledGrainsTest {
namespace {

// No grains never come to rest: the bed was stepped for ever.
TEST(SettledGrains, endWhereNothingComesToRest) {
    const std::string sentence = support::refusal([] {
        (void)scenes::settle({{{0, 0, 0}, {0.01, 0.01, infinity}}, {}}, 1);
    });
    EXPECT_TRUE(support::isOneSentence(sentence)) << sentence;
    EXPECT_TRUE(support::contains(sentence, "are not at rest after")) << sentence;
}

}  // namespace
}  // namespace pendular::settledGrainsTest
