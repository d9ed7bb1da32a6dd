#include "Kernel/Base/SilentRank.h"
#include "Kernel/Particles/GrainSums.h"
#include "Kernel/Simulation/SceneInside.h"

// A scene that several ranks share.

namespace pendular {

void Scene::Inside::gather() {
    if (!isDistributed()) return;
    scene.particleHandler.finishStep();
    if (scene.hasBegun()) takeOverChanges();
    contacts.gather(scene.particleHandler.store());
}

void Scene::Inside::onFirstRank(const std::function<void()>& write) {
    if (!isDistributed()) {
        if (!isSilentRank()) write();
        return;
    }
    scene.particleHandler.finishStep();
    if (scene.hasBegun()) takeOverChanges();
    contacts.withAllOnFirst(scene.particleHandler.store(), write);
}

RunNumbers Scene::Inside::numbersOfAll() {
    const ParticleStore& grains = scene.particleHandler.store();
    RunNumbers own{grains.count(), 0, kineticEnergy(grains)};
    // A contact of two ranks counts where its first body is.
    contacts.forEachActing(grains, [&](const Bucket&, std::uint32_t) { ++own.contacts; });
    RunNumbers all;
    for (const RunNumbers& one : sharing->ofAll(own)) {
        all.grains += one.grains;
        all.contacts += one.contacts;
        all.kineticEnergy += one.kineticEnergy;
    }
    return all;
}

}  // namespace pendular
