#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "Drivers/Shared/BenchmarkScenes.h"

namespace pendular::scenes {

/// The scenes of the benchmark as values of a test, and their names as names of a test.
inline auto benchmarkScenes() {
    return testing::Values("bed", "wet-bed", "wet-walls", "sprayed-bed", "drum", "penetration", "gas",
                           "polydisperse");
}
inline std::string benchmarkTestName(const testing::TestParamInfo<const char*>& info) {
    std::string name = info.param;
    std::erase(name, '-');
    return name;
}

/// A scene of some 400 grains, whose initial state is made in the folder.
inline BenchmarkChoice smallBenchmark(const char* scene, const std::filesystem::path& folder) {
    BenchmarkChoice choice;
    choice.scene = scene;
    choice.particles = 400;
    choice.states = folder;
    return choice;
}

/// Calls function(scene) with grains that were given speeds, so that contacts are soon listed again: along x,
/// in turn to and fro.
template <class Function>
void withMovingBenchmark(const BenchmarkChoice& choice, int threads, Function&& function) {
    withBenchmarkScene(choice, 1, [&](auto& scene) {
        scene.setNumberOfThreads(threads);
        for (std::size_t k = 0; k < scene.particleHandler.getSize(); ++k)
            scene.particleHandler.getObject(k).setVelocity({k % 2 == 0 ? 0.5 : -0.5, 0, 0});
        function(scene);
    });
}

}  // namespace pendular::scenes
