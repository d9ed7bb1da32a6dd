#pragma once

#include <cmath>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Particles/ParticleStore.h"

namespace pendular {

/// The two bodies of a contact, the smaller one first.
inline Bodies bodiesOf(const ContactStore& store, const Bucket& bucket, std::size_t contact,
                       const ParticleStore& grains) {
    const ContactBlock& places = store.blocks[contact / Pack::lanes];
    const std::size_t lane = contact % Pack::lanes;
    const double r1 = grains.translation[places.first[lane]].radius;
    const double r2 = bucket.wall >= 0 ? infinity : grains.translation[places.second[lane]].radius;
    return {std::min(r1, r2), std::max(r1, r2)};
}

/// Prepares the bridge of a contact again, where liquid moves for its preparedVolumeOf(), which a drying
/// bridge has had a while ago; it goes on with what it remembers of its motion.
/// @param before what its interaction was
inline void prepareAgain(ContactStore& store, const ContactLaws& laws, const Bucket& bucket,
                         std::size_t contact, const ParticleStore& grains, const double* before) {
    const std::size_t slot = store.slotOf(contact);
    const Bodies bodies = bodiesOf(store, bucket, contact, grains);
    ContactNumbers bridge{};
    if (laws.liquidRules(bucket.species1, bucket.species2))
        laws.prepareBridge(bucket.species1, bucket.species2, bodies,
                           std::abs(store.memory.preparedVolumeOf(slot)), bridge.data());
    else laws.prepareAdhesion(bucket.species1, bucket.species2, bodies, bridge.data());
    laws.takeBridgeState(bucket.species1, bucket.species2, bridge.data(), before);
    store.memory.interaction.set(slot, bridge.data());
}

/// Prepares the adhesion of these contacts of a block that has memory.
/// @param lanes the bits of the contacts
inline void prepareBlock(ContactStore& store, std::size_t block, unsigned lanes, const Bucket& bucket,
                         const ContactLaws& laws, const ParticleStore& grains) {
    Bodies last{-1, -1};
    ContactNumbers prepared{};  // zero beyond the numbers of the pair's own laws
    for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
        if (!store.bitOf(lanes, lane)) continue;
        const Bodies bodies = bodiesOf(store, bucket, block * Pack::lanes + lane, grains);
        if (bodies.radius1 != last.radius1 || bodies.radius2 != last.radius2) {
            last = bodies;
            laws.prepareAdhesion(bucket.species1, bucket.species2, bodies, prepared.data());
        }
        store.memory.interaction.set(store.slotOf(block * Pack::lanes + lane), prepared.data());
    }
}

/// Gives memory to a block that has none, with the adhesion of its contacts prepared.
inline void wakeBlock(ContactStore& store, std::size_t block, const Bucket& bucket, const ContactLaws& laws,
                      const ParticleStore& grains) {
    store.slots[block] = store.memory.add(block);
    if (laws.layout.interaction > 0)
        prepareBlock(store, block, store.states[block].listed, bucket, laws, grains);
}

}  // namespace pendular
