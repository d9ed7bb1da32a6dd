#pragma once

#include <fmt/format.h>

#include <filesystem>

#include "Kernel/Files/FileFault.h"
#include "Tools/Studies/BulkComparison/PeerFiles.h"
#include "Tools/Studies/BulkComparison/PeerScene.h"

// The drum and the hopper of the comparison with any number of grains, which flow already: what
// benchmark-scenes times.

namespace pendular::bulk {

inline constexpr std::array<std::string_view, 2> flowSceneNames{"flowing-drum", "flowing-hopper"};
inline bool isFlowScene(std::string_view name) {
    return std::find(flowSceneNames.begin(), flowSceneNames.end(), name) != flowSceneNames.end();
}

/// s: what users of the peers take.
inline double flowStep() { return 0.2 * PeerMaterial::rayleighTime(); }

/// The grains that the scene has in the comparison, without those that are held.
inline std::size_t ownFlowGrains(std::string_view name) { return name == "flowing-drum" ? 1040 : 1500; }

/// The scene before its grains move.
/// @param grains about so many; the drum has as many as find room below its middle
inline BulkScene flowSceneOf(std::string_view name, std::size_t grains) {
    const double times = static_cast<double>(grains) / static_cast<double>(ownFlowGrains(name));
    UniformRandom random(1);
    return name == "flowing-drum" ? detail::drum(random, times) : detail::hopper(random, times);
}

/// Runs a scene for a time (s), and gives its grains as they are then.
inline std::vector<PeerGrain> grainsAfter(const BulkScene& scene, double seconds, bool isClosed,
                                          int threads) {
    PeerScene running(scene, isClosed);
    running.setQuiet();
    running.setTimeStep(flowStep());
    running.acceptUnstableTimeStep();
    running.setNumberOfThreads(threads);
    running.initialise();
    running.step(static_cast<std::size_t>(seconds / running.getTimeStep()));
    return running.grainsNow(scene);
}

/// Half a second of the drum from its fall; the hopper 0.06 s after it has been opened, when its grains had
/// come to rest.
inline BulkScene flowStart(std::string_view name, std::size_t grains, int threads) {
    BulkScene scene = flowSceneOf(name, grains);
    if (!scene.settles) {
        scene.grains = grainsAfter(scene, 0.5, false, threads);
        return scene;
    }
    scene.grains = grainsAfter(scene, 0.5 * std::sqrt(scene.highest.z() / 0.15), true, threads);
    for (PeerGrain& grain : scene.grains) grain.velocity = Vec3D::Zero();
    scene.grains = grainsAfter(scene, 0.06, false, threads);
    return scene;
}

/// The same, kept in a folder of initial states as a file that LIGGGHTS and LAMMPS read (PeerFiles.h).
/// Without a folder nothing is read or kept.
inline BulkScene keptFlowStart(std::string_view name, std::size_t grains, const std::filesystem::path& folder,
                               int threads) {
    if (folder.empty()) return flowStart(name, grains, threads);
    const std::filesystem::path file = folder / fmt::format("{}-{}.data", name, grains);
    if (!isThere(file)) {
        makeFolder(folder);
        writePeerData(file.string(), flowStart(name, grains, threads));
    }
    BulkScene scene = flowSceneOf(name, grains);
    readPeerData(file.string(), scene);
    return scene;
}

}  // namespace pendular::bulk
