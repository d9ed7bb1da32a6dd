#pragma once

#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Particles/ParticleStore.h"

namespace pendular {

/// Gives memory to a block that has none, with the adhesion of its contacts prepared.
inline void wakeBlock(ContactStore& store, std::size_t block, const Bucket& bucket, const ContactLaws& laws,
                      const ParticleStore& grains) {
    const std::uint32_t slot = store.memory.add(block);
    store.slots[block] = slot;
    if (laws.layout.interaction == 0) return;
    const ContactBlock& places = store.blocks[block];
    Bodies last{-1, -1};
    ContactNumbers prepared{};  // zero beyond the numbers of the pair's own laws
    for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
        if (!store.bitOf(store.states[block].listed, lane)) continue;
        const double r1 = grains.translation[places.first[lane]].radius;
        const double r2 = bucket.wall >= 0 ? infinity : grains.translation[places.second[lane]].radius;
        const Bodies bodies{std::min(r1, r2), std::max(r1, r2)};
        if (bodies.radius1 != last.radius1 || bodies.radius2 != last.radius2) {
            last = bodies;
            laws.prepareBridge(bucket.species1, bucket.species2, bodies, prepared.data());
        }
        store.memory.interaction.set(std::size_t{slot} * Pack::lanes + lane, prepared.data());
    }
}

}  // namespace pendular
