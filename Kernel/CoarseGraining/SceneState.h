#pragma once

#include "Kernel/CoarseGraining/GrainState.h"
#include "Kernel/Output/PolyData.h"
#include "Kernel/Output/SceneFields.h"

namespace pendular {

/// The grains and contacts of a scene, as of the last step: all contacts that have a force.
/// @param state keeps its memory from one time to the next
template <class Scene>
void takeState(const Scene& scene, GrainState& state) {
    const ParticleStore& grains = scene.particleHandler.store();
    state.grains.clear(), state.contacts.clear();
    state.time = scene.getTime();
    state.periodic = scene.contacts().periodicBox();
    const GrainColumn* film = nullptr;
    for (const GrainColumn& column : grains.columns)
        if (column.name == "liquid_film") film = &column;
    std::vector<std::uint32_t> number(grains.size());  // of the grain at a place
    state.grains.reserve(grains.count());
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        number[place] = static_cast<std::uint32_t>(state.grains.size());
        state.grains.push_back({grain.position, grain.velocity, grain.radius,
                                massOf(grains, scene.laws(), place), film ? film->values[place] : 0,
                                grains.species[place]});
    }
    scene.contacts().forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = scene.contacts().observe(grains, bucket, contact);
        state.contacts.push_back(
            {number[grains.place[seen.particle1]],
             bucket.wall < 0 ? number[grains.place[seen.particle2]] : GrainState::Contact::wall, seen.shift,
             seen.force, seen.adhesiveForce, seen.bridgeVolume, seen.touching});
    });
}

template <class Scene>
GrainState stateOf(const Scene& scene) {
    GrainState state;
    takeState(scene, state);
    return state;
}

/// The same of a frame for ParaView: its grains and contacts. In periodic directions (a length above 0) a
/// contact leads to the nearest image. Throws InputError where a field is missing that is needed.
GrainState stateOf(const PolyData& grains, const PolyData& contacts, const PeriodicBox& periodic);

}  // namespace pendular
