#pragma once

#include <fmt/format.h>

#include <filesystem>

#include "Kernel/Foundation/Files/FileFault.h"
#include "Tools/Studies/BulkComparison/MixerScene.h"
#include "Tools/Studies/BulkComparison/PeerFiles.h"
#include "Tools/Studies/BulkComparison/PeerScene.h"

// Drum, hopper and mixer with any number of grains, dry or wet, which flow already: what benchmark-scenes
// times, and what other codes are timed beside.

namespace pendular::bulk {

inline constexpr std::array<std::string_view, 6> flowSceneNames{"flowing-drum",       "flowing-hopper",
                                                                "flowing-mixer",      "wet-flowing-drum",
                                                                "wet-flowing-hopper", "wet-flowing-mixer"};
inline bool isFlowScene(std::string_view name) {
    return std::find(flowSceneNames.begin(), flowSceneNames.end(), name) != flowSceneNames.end();
}
inline bool isWetScene(std::string_view name) { return name.starts_with("wet-"); }

/// s: what users of the peers take.
inline double flowStep() { return 0.2 * PeerMaterial::rayleighTime(); }

/// Of the smaller radius: a screw presses some of the soft grains more than the 5 % that a scene accepts.
inline constexpr double largestFlowOverlap = 0.2;

/// Of more grains than this, scenes are copies of one of `grainsOfCopies`, side by side along the periodic
/// axis: to fill them would take hours.
inline constexpr std::size_t mostGrainsWithoutCopies = 100'000, grainsOfCopies = 30'000;

/// The grains that the scene has in the comparison, without those that are held.
inline std::size_t ownFlowGrains(std::string_view name) { return name.ends_with("hopper") ? 1500 : 1040; }

/// The scene before its grains move.
/// @param grains about so many; drum and mixer have as many as find room below their middle
inline BulkScene flowSceneOf(std::string_view name, std::size_t grains) {
    const double times = static_cast<double>(grains) / static_cast<double>(ownFlowGrains(name));
    UniformRandom random(1);
    if (name.ends_with("hopper")) return detail::hopper(random, times);
    return name.ends_with("mixer") ? detail::mixer(random, times) : detail::drum(random, times);
}

inline std::size_t flowSteps(double seconds) { return static_cast<std::size_t>(seconds / flowStep()); }

/// The meshes as they have turned after a time (s), in whole steps.
inline void turnMeshes(BulkScene& scene, double seconds) {
    for (PeerMesh& mesh : scene.meshes) {
        const double angle = mesh.spin * flowStep() * static_cast<double>(flowSteps(seconds));
        const double c = std::cos(angle), s = std::sin(angle);
        for (Triangle& triangle : mesh.triangles)
            for (Vector<double>& at : triangle) at = {c * at.x - s * at.y, s * at.x + c * at.y, at.z};
    }
}

/// Runs a scene for a time (s): its grains and meshes are as they are then.
template <class SceneType>
void runFor(BulkScene& scene, double seconds, bool isClosed, int threads) {
    SceneType running(scene, isClosed);
    running.setQuiet();
    running.setTimeStep(flowStep());
    running.acceptUnstableTimeStep();
    running.acceptOverlaps(largestFlowOverlap);
    running.setNumberOfThreads(threads);
    running.initialise();
    running.step(flowSteps(seconds));
    scene.grains = running.grainsNow(scene);
    turnMeshes(scene, seconds);
}

inline constexpr double fallSeconds = 0.5, drainSeconds = 0.06;
/// s, of a wet flow from the start of the dry one: bridges form and rupture, until their flow is its own.
inline double wetSeconds(const BulkScene& scene) { return scene.drains ? 0.03 : 0.2; }

/// Half a second of the drum or the mixer from the fall of their grains; the hopper 0.06 s after it has been
/// opened, when its grains had come to rest.
inline BulkScene flowStart(std::string_view name, std::size_t grains, int threads) {
    BulkScene scene = flowSceneOf(name, grains);
    if (!scene.settles) {
        runFor<PeerScene>(scene, fallSeconds, false, threads);
        return scene;
    }
    runFor<PeerScene>(scene, fallSeconds * std::sqrt(scene.highest.z() / 0.15), true, threads);
    for (PeerGrain& grain : scene.grains) grain.velocity = Vec3D::Zero();
    runFor<PeerScene>(scene, drainSeconds, false, threads);
    return scene;
}

/// A flow at its start, which is kept in a folder of initial states as a file that LIGGGHTS and LAMMPS read
/// (PeerFiles.h). Without a folder nothing is read or kept.
inline BulkScene keptFlowStart(std::string_view name, std::size_t grains, const std::filesystem::path& folder,
                               int threads) {
    constexpr std::string_view wet = "wet-";
    const auto made = [&] {
        if (!isWetScene(name)) return flowStart(name, grains, threads);
        BulkScene scene = keptFlowStart(name.substr(wet.size()), grains, folder, threads);
        runFor<WetPeerScene>(scene, wetSeconds(scene), false, threads);
        return scene;
    };
    if (folder.empty()) return made();
    const std::filesystem::path file = folder / fmt::format("{}-{}.data", name, grains);
    if (!isThere(file)) {
        makeFolder(folder);
        writePeerData(file.string(), made());
    }
    BulkScene scene = flowSceneOf(name, grains);
    readPeerData(file.string(), scene);
    if (!scene.settles) turnMeshes(scene, fallSeconds);
    if (isWetScene(name)) turnMeshes(scene, wetSeconds(scene));
    return scene;
}

/// Copies of a scene side by side along its periodic axis.
inline BulkScene copiesOf(const BulkScene& one, std::size_t copies) {
    const int axis = one.periodic[2] ? 2 : 1;
    const double period = one.highest[axis] - one.lowest[axis];
    BulkScene all = one;
    all.highest[axis] = one.lowest[axis] + period * static_cast<double>(copies);
    for (std::size_t k = 1; k < copies; ++k) {
        const auto number = static_cast<double>(k);
        Vec3D shift = Vec3D::Zero();
        shift[axis] = period * number;
        for (PeerGrain grain : one.grains) {
            grain.position += shift;
            all.grains.push_back(grain);
        }
        for (std::size_t m = 0; m < one.meshes.size(); ++m)
            for (Triangle triangle : one.meshes[m].triangles) {
                // A corner of the last row has the same coordinates as the next copy's first one.
                for (Vector<double>& corner : triangle) corner.z = period * (number + corner.z / period);
                all.meshes[m].triangles.push_back(triangle);
            }
    }
    return all;
}

/// A flow of any number of grains.
inline BulkScene flowOf(std::string_view name, std::size_t grains, const std::filesystem::path& folder,
                        int threads) {
    if (grains <= mostGrainsWithoutCopies) return keptFlowStart(name, grains, folder, threads);
    const std::size_t copies = (grains + grainsOfCopies / 2) / grainsOfCopies;
    return copiesOf(keptFlowStart(name, grainsOfCopies, folder, threads), copies);
}

}  // namespace pendular::bulk
