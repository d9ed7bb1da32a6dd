#include "Kernel/Core/Contacts/PrefetchChoice.h"

#include <gtest/gtest.h>

namespace pendular::prefetchChoiceTest {
namespace {

constexpr std::size_t cache = 16'000'000;  // bytes

/// Steps of a scene in which the forces take these times (s); every fifth step is held up.
void run(PrefetchChoice& choice, std::size_t steps, double without, double with,
         std::size_t bytes = cache / 2) {
    for (std::size_t k = 0; k < steps; ++k) {
        choice.begin(bytes, cache);
        const double heldUp = k % 5 == 0 ? 100e-6 : 0;
        if (choice.isMeasured()) choice.end((choice.asks() ? with : without) + heldUp);
    }
}

TEST(PrefetchChoice, ofScenesBelowAndAboveBothBoundsNeedsNoMeasurement) {
    PrefetchChoice choice;
    for (const std::size_t bytes : {std::size_t{0}, cache / PrefetchChoice::smallPart, cache + 1}) {
        for (int k = 0; k < 50; ++k) {
            choice.begin(bytes, cache);
            EXPECT_EQ(choice.asks(), bytes > cache);
            EXPECT_FALSE(choice.isMeasured());
        }
    }
}

TEST(PrefetchChoice, isWhatIsFasterBetweenThem) {
    PrefetchChoice choice;
    run(choice, PrefetchChoice::stepsBetween, 10e-6, 9e-6);
    EXPECT_TRUE(choice.asks());
    run(choice, PrefetchChoice::stepsBetween, 10e-6, 10.5e-6);  // other programs have ended
    EXPECT_FALSE(choice.asks());
    run(choice, PrefetchChoice::stepsBetween, 10e-6, 5e-6);
    EXPECT_TRUE(choice.asks());
    run(choice, 1, 0, 0, 0);  // the scene has got small
    EXPECT_FALSE(choice.asks());
}

TEST(PrefetchChoice, staysWhereTheDifferenceIsNoise) {
    for (const bool asks : {false, true}) {
        PrefetchChoice choice;
        run(choice, PrefetchChoice::stepsBetween, 10e-6, asks ? 5e-6 : 20e-6);
        for (const double with : {9.95e-6, 10.05e-6}) {
            run(choice, PrefetchChoice::stepsBetween, 10e-6, with);
            EXPECT_EQ(choice.asks(), asks) << with;
        }
    }
}

TEST(PrefetchChoice, measuresFewSteps) {
    PrefetchChoice choice;
    std::size_t measured = 0, asked = 0;
    for (std::size_t k = 0; k < 4 * PrefetchChoice::stepsBetween; ++k) {
        choice.begin(cache / 2, cache);
        if (!choice.isMeasured()) continue;
        ++measured;
        asked += choice.asks() ? 1 : 0;
        choice.end(1e-5);
    }
    EXPECT_EQ(measured, 4 * PrefetchChoice::stepsOfTrial);
    EXPECT_EQ(asked, measured / 2);
}

}  // namespace
}  // namespace pendular::prefetchChoiceTest
