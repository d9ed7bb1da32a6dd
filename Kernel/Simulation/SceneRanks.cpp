#include "Kernel/Base/InputError.h"
#include "Kernel/Particles/GrainSums.h"
#include "Kernel/Simulation/SceneInside.h"

// A scene that several ranks share.

namespace pendular {

/// The accounts of energy and liquid, and the counts of events, are not yet right after grains were gathered.
void Scene::Inside::refuseToGather() const {
    if (laws().layout.liquid == 0 && !contacts.events().areListenedTo() && !account.isKept()) return;
    throw InputError(
        "Simulation: a scene on several ranks (setRanks()) in which liquid moves, the energy ledger is kept, "
        "a wall wears or events of contacts are listened to, has no outputs and restart files yet; run it on "
        "one rank.");
}

void Scene::Inside::gather() {
    if (!isDistributed()) return;
    refuseToGather();
    scene.particleHandler.finishStep();
    if (scene.hasBegun()) takeOverChanges();
    contacts.gather(scene.particleHandler.store());
}

RunNumbers Scene::Inside::numbersOfAll() {
    const ParticleStore& grains = scene.particleHandler.store();
    RunNumbers own{scene.particleHandler.getSize(), 0, kineticEnergy(grains)};
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
