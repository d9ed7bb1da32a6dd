#include <gtest/gtest.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Scenes/ShearedCloud.h"

// Scenes of the kernel alone, which the thread sanitizer runs; those of the benchmark:
// Restart/BenchmarkTest.cpp.

namespace pendular::threadsTest {
namespace {

using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
using Smooth = LinearViscoelasticSpecies;

std::uint64_t hashOf(Scene& scene) {
    scene.initialise();
    while (scene.contacts().rebuildCount() < 3 || scene.contacts().counts().touching < 20) scene.step();
    return stateHash(scene.particleHandler.store());
}

/// 160 grains of two sizes fall into a box of planes, until many touch.
template <class S>
std::uint64_t hashOfBox(int threads) {
    scenes::SettlingBox<S> scene(10);
    scene.setNumberOfThreads(threads);
    return hashOf(scene);
}
template <class S>
std::uint64_t hashOfShear(int threads) {
    scenes::ShearedCloud<S> scene(200.0);
    scene.setNumberOfThreads(threads);
    return hashOf(scene);
}

/// Rods of three grains that fall onto a floor.
std::uint64_t hashOfRods(int threads) {
    Simulation<Wet> scene;
    const Wet* const species = scene.speciesHandler.copyAndAddObject(scenes::boxMaterial<Wet>(0));
    Clump rod{ClumpTemplate({{{0, 0, 0}, 7e-4}, {{7e-4, 0, 0}, 7e-4}, {{14e-4, 0, 0}, 7e-4}})};
    rod.setSpecies(species);
    for (int k = 0; k < 100; ++k) {
        rod.setPosition({3e-3 * (k % 5), 1.6e-3 * (k / 5 % 5), 0.9e-3 + 1.6e-3 * (k / 25)});
        rod.setVelocity({0.1 * (k % 5) - 0.2, 0.1 * (k % 3) - 0.1, -0.5});
        scene.bodyHandler.copyAndAddObject(rod);
    }
    InfiniteWall floor;
    floor.set({0, 0, -1}, {0, 0, 0});
    floor.setSpecies(species);
    scene.wallHandler.copyAndAddObject(floor);
    scene.setGravity({0, 0, -9.81});
    scene.setTimeStep(0x1p-18);
    scene.setNumberOfThreads(threads);
    return hashOf(scene);
}

class ThreadsInScenes : public testing::TestWithParam<int> {};

TEST_P(ThreadsInScenes, boxOfWetGrains) { EXPECT_EQ(hashOfBox<Wet>(GetParam()), hashOfBox<Wet>(1)); }
TEST_P(ThreadsInScenes, boxOfSmoothGrains) { EXPECT_EQ(hashOfBox<Smooth>(GetParam()), hashOfBox<Smooth>(1)); }
TEST_P(ThreadsInScenes, boxOfRods) { EXPECT_EQ(hashOfRods(GetParam()), hashOfRods(1)); }
TEST_P(ThreadsInScenes, shearOverFaces) { EXPECT_EQ(hashOfShear<Wet>(GetParam()), hashOfShear<Wet>(1)); }
INSTANTIATE_TEST_SUITE_P(Two, ThreadsInScenes, testing::Values(2, 3));

}  // namespace
}  // namespace pendular::threadsTest
