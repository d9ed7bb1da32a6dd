#pragma once

#include <mutex>
#include <vector>

#include "Kernel/Ranks/GrainSharing.h"
#include "Kernel/Ranks/VirtualRanks.h"
#include "Kernel/Simulation/Scene.h"
#include "Kernel/Simulation/StateHash.h"

namespace pendular::ranks {

/// Adds the grains of one store to another one, as a rank gets them.
inline void addGrains(ParticleStore& to, ParticleStore& from) {
    to.hasSpin = from.hasSpin;
    for (const std::uint32_t place : from.place) {
        Message row;
        from.visitRow(place, [&](const auto& value) { row.add(value); });
        to.visitRow(to.addPlace(from.identity[place]), [&](auto& value) { row.take(value); });
    }
}

/// What ranks have come to together.
struct Outcome {
    std::uint64_t hash = 0;                            // of the grains of all
    std::size_t grains = 0, fewest = ~std::size_t{0};  // of all ranks, and of one
    RankCounts counts;                                 // sums
};

/// Runs a scene on virtual ranks.
/// @param make (use) makes the scene and calls use(scene), on each rank
template <class Make>
Outcome runOnRanks(std::size_t ranks, const RankOptions& options, std::size_t steps, Make&& make) {
    ParticleStore all;
    Outcome outcome;
    std::mutex mutex;
    VirtualRanks(ranks).run([&](Exchange& exchange) {
        make([&](Scene& scene) {
            scene.setRanks(exchange, options);
            scene.initialise();
            scene.step(steps);
            ParticleStore own = scene.particleHandler.store();
            const std::lock_guard lock(mutex);
            addGrains(all, own);
            outcome.fewest = std::min(outcome.fewest, own.count());
            const RankCounts counts = scene.rankCounts();
            outcome.counts.lists = counts.lists;
            outcome.counts.migrated += counts.migrated;
            outcome.counts.ghosts += counts.ghosts;
            outcome.counts.heldTwice += counts.heldTwice;
            outcome.counts.unequal += counts.unequal;
        });
    });
    outcome.hash = stateHash(all);
    outcome.grains = all.count();
    return outcome;
}

}  // namespace pendular::ranks
