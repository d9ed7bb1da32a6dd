#include <gtest/gtest.h>

#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Simulation/StateHash.h"
#include "SelfTests/Scenes/MovingBenchmark.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::sceneTest {
namespace {

using scenes::BenchmarkChoice;

/// The hash when the contacts have been listed again a few times.
std::uint64_t hashWith(const BenchmarkChoice& choice, int threads) {
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

class HeavyBenchmarkScene : public testing::TestWithParam<const char*> {};

TEST_P(HeavyBenchmarkScene, hasTheSameBitsForAnyNumberOfThreads) {
    const support::TestFolder folder;
    const BenchmarkChoice choice = scenes::smallBenchmark(GetParam(), folder.path());
    const std::uint64_t one = hashWith(choice, 1);
    for (const int threads : {2, 3, 8}) EXPECT_EQ(hashWith(choice, threads), one) << threads << " threads";
}
INSTANTIATE_TEST_SUITE_P(All, HeavyBenchmarkScene, scenes::benchmarkScenes(), scenes::benchmarkTestName);

}  // namespace
}  // namespace pendular::sceneTest
