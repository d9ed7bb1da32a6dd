#include <gtest/gtest.h>

#include "Drivers/Shared/BenchmarkScenes.h"
#include "Kernel/Simulation/StateHash.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular {
namespace {

using scenes::BenchmarkChoice;

/// The hash after some steps, which begin with the first list. Few of them: with more threads than cores,
/// these spend their time waiting for each other.
std::uint64_t hashWith(const BenchmarkChoice& choice, int threads) {
    std::uint64_t hash = 0;
    scenes::withBenchmarkScene(choice, 1, [&](auto& scene) {
        scene.setNumberOfThreads(threads);
        scene.initialise();
        for (int k = 0; k < 50; ++k) scene.step();
        hash = stateHash(scene.particleHandler.store());
    });
    return hash;
}

class HeavyBenchmarkScene : public testing::TestWithParam<const char*> {};

TEST_P(HeavyBenchmarkScene, hasTheSameBitsForAnyNumberOfThreads) {
    const support::TemporaryFolder folder;
    BenchmarkChoice choice;
    choice.scene = GetParam();
    choice.particles = 400;
    choice.states = folder.path();
    const std::uint64_t one = hashWith(choice, 1);
    for (const int threads : {2, 3, 8}) EXPECT_EQ(hashWith(choice, threads), one) << threads << " threads";
}
INSTANTIATE_TEST_SUITE_P(All, HeavyBenchmarkScene,
                         testing::Values("bed", "wet-bed", "drum", "penetration", "gas", "polydisperse"),
                         [](const auto& info) {
                             std::string name = info.param;
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace pendular
