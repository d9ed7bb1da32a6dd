#include <gtest/gtest.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/MovingBenchmark.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::benchmarkTest {
namespace {

class LongBenchmarkScene : public testing::TestWithParam<const char*> {};

/// The hash when the contacts have been listed again a few times.
std::uint64_t hashWith(const scenes::BenchmarkChoice& choice, int threads) {
    std::uint64_t hash = 0;
    scenes::withMovingBenchmark(choice, threads, [&](auto& scene) {
        scene.initialise();
        while (scene.contacts().rebuildCount() < 4) scene.step();
        hash = stateHash(scene.particleHandler.store());
        const std::size_t touching = scene.contacts().counts().touching;
        EXPECT_TRUE(choice.scene == "gas" || touching > 20) << touching;
    });
    return hash;
}

TEST_P(LongBenchmarkScene, hasTheSameBitsForAnyNumberOfThreads) {
    const support::TestFolder folder;
    const auto choice = scenes::smallBenchmark(GetParam(), folder.path());
    const std::uint64_t one = hashWith(choice, 1);
    for (const int threads : {2, 3, 8}) EXPECT_EQ(hashWith(choice, threads), one) << threads << " threads";
}
INSTANTIATE_TEST_SUITE_P(All, LongBenchmarkScene, scenes::benchmarkScenes(), scenes::benchmarkTestName);

class HeavyRestartedBenchmark : public testing::TestWithParam<const char*> {};

/// All steps in one go, and some, a restart, also with another number of threads, and the others. There are
/// rebuilds of the list of contacts before and after it.
TEST_P(HeavyRestartedBenchmark, isInTheSameState) {
    const support::TestFolder folder;
    const auto choice = scenes::smallBenchmark(GetParam(), folder.path());
    const auto half = folder.path() / "half.h5", whole = folder.path() / "whole.h5",
               restarted = folder.path() / "restarted.h5";
    std::size_t steps = 0;
    std::uint64_t hash = 0;
    scenes::withMovingBenchmark(choice, 1, [&](auto& scene) {
        scene.initialise();
        while (scene.contacts().rebuildCount() < 3) scene.step();
        const std::size_t middle = scene.getNumberOfTimeSteps();
        scene.writeRestart(half);
        while (scene.contacts().rebuildCount() < 5 || steps < middle) scene.step(), ++steps;
        scene.writeRestart(whole);
        hash = stateHash(scene.particleHandler.store());
    });
    for (const int threads : {1, 3})
        scenes::withMovingBenchmark(choice, threads, [&](auto& scene) {
            scene.restartFrom(half);
            scene.initialise();
            for (std::size_t k = 0; k < steps; ++k) scene.step();
            EXPECT_EQ(stateHash(scene.particleHandler.store()), hash) << threads << " threads";
            scene.writeRestart(restarted);
            support::expectSameState(whole, restarted);
        });
}
INSTANTIATE_TEST_SUITE_P(All, HeavyRestartedBenchmark, scenes::benchmarkScenes(), scenes::benchmarkTestName);

}  // namespace
}  // namespace pendular::benchmarkTest
