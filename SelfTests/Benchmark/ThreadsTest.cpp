#include <gtest/gtest.h>

#include "Drivers/Shared/BenchmarkScenes.h"
#include "Kernel/Simulation/StateHash.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular {
namespace {

using scenes::BenchmarkChoice;

/// The hash when the contacts have been listed anew a few times. The grains are given speeds first, so that
/// this is soon: along x, in turn to and fro.
std::uint64_t hashWith(const BenchmarkChoice& choice, int threads) {
    std::uint64_t hash = 0;
    scenes::withBenchmarkScene(choice, 1, [&](auto& scene) {
        scene.setNumberOfThreads(threads);
        for (std::size_t k = 0; k < scene.particleHandler.getSize(); ++k)
            scene.particleHandler.getObject(k).setVelocity({k % 2 == 0 ? 0.5 : -0.5, 0, 0});
        scene.initialise();
        while (scene.contacts().rebuildCount() < 4) scene.step();
        hash = stateHash(scene.particleHandler.store());
        std::size_t touching = 0;
        scene.contacts().store().forEachListed([&](const Bucket&, std::uint32_t contact) {
            touching += scene.contacts().store().touches(contact) ? 1 : 0;
        });
        EXPECT_TRUE(choice.scene == "gas" || touching > 20) << touching;
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
