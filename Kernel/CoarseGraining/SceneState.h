#pragma once

#include <algorithm>
#include <vector>

#include "Kernel/CoarseGraining/GrainState.h"
#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Output/PolyData.h"
#include "Kernel/Output/SceneFields.h"
#include "Kernel/Parallel.h"

namespace pendular {

/// Appends the contacts that have a force and are those of the grain at a place, as their first body, in the
/// order of its partners. Without a bridge between grains, what fields need is near at hand.
/// @param number of the grain at each place, in GrainState
inline void appendContacts(const ContactSystem& contacts, const ParticleStore& grains, std::uint32_t place,
                           const std::vector<std::uint32_t>& number,
                           std::vector<GrainState::Contact>& found) {
    const ContactStore& store = contacts.store();
    contacts.forEachActingOf(place, [&](const Bucket& bucket, std::uint32_t contact) {
        const ContactBlock& block = store.blocks[contact / Pack::lanes];
        const std::size_t lane = contact % Pack::lanes;
        if (block.first[lane] != place) return;
        const bool atWall = bucket.wall >= 0;
        const std::uint32_t second = atWall ? GrainState::Contact::wall : number[block.second[lane]];
        if (!atWall && (store.states[contact / Pack::lanes].bridged >> lane & 1) == 0) {
            const Vector<double> way =
                grains.translation[block.second[lane]].position - grains.translation[place].position;
            found.push_back({number[place], second, contacts.periodicBox().nearest(way),
                             store.forceOf(contact), 0, 0, store.touches(contact)});
            return;
        }
        const ObservedContact seen = contacts.observe(grains, bucket, contact);
        found.push_back({number[place], second, seen.shift, seen.force, seen.adhesiveForce, seen.bridgeVolume,
                         seen.touching});
    });
}

/// Velocities from now on against the flow with which the images of a scene move, so that all images have the
/// same.
inline void takeFlowAway(GrainState& state) {
    for (GrainState::Grain& grain : state.grains) grain.velocity -= state.periodic.flowAt(grain.position);
    state.periodic.imageVelocity = state.periodic.strainRate = {0, 0, 0};
}

/// Puts the rigid bodies of a scene in the place of their grains.
/// @param places of the grains, in the order of the state
void joinBodies(GrainState& state, const ParticleStore& grains, const std::vector<std::uint32_t>& places);

/// The grains and contacts of a scene, as of the last step: all contacts that have a force.
/// @param state keeps its memory from one time to the next
template <class Scene>
void takeState(const Scene& scene, GrainState& state, FieldContent content = FieldContent::All) {
    const ParticleStore& grains = scene.particleHandler.store();
    state.grains.clear(), state.contacts.clear(), state.branches.clear();
    state.time = scene.getTime();
    state.periodic = scene.contacts().periodicBox();
    const GrainColumn* film = nullptr;
    for (const GrainColumn& column : grains.columns)
        if (column.name == "liquid_film") film = &column;
    const int threads = scene.getNumberOfThreads();
    const GrainMasses masses(grains, scene.laws());
    std::vector<std::uint32_t> places(grains.place.begin(), grains.place.end());  // by identity
    std::vector<std::uint32_t> number(grains.size());                             // of the grain at a place
    state.grains.resize(places.size());
    inParts(
        places.size(), threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                const std::uint32_t place = places[k];
                const TranslationRecord& grain = grains.translation[place];
                number[place] = static_cast<std::uint32_t>(k);
                state.grains[k] = {grain.position,
                                   grain.velocity,
                                   grain.radius,
                                   masses(place),
                                   film ? film->values[place] : 0,
                                   grains.species[place]};
            }
        },
        1024);
    if (content == FieldContent::WithoutContacts) return joinBodies(state, grains, places);
    // Each thread takes the contacts whose first body is one of its grains; put together they are in the
    // order of identities.
    std::vector<std::vector<GrainState::Contact>> ofOthers(static_cast<std::size_t>(std::max(threads, 1)));
    inParts(
        places.size(), threads,
        [&](int part, std::size_t begin, std::size_t end) {
            auto& own = part == 0 ? state.contacts : ofOthers[static_cast<std::size_t>(part)];
            for (std::size_t k = begin; k < end; ++k)
                appendContacts(scene.contacts(), grains, places[k], number, own);
        },
        1024);
    for (const auto& own : ofOthers) state.contacts.insert(state.contacts.end(), own.begin(), own.end());
    joinBodies(state, grains, places);
}

template <class Scene>
GrainState stateOf(const Scene& scene, FieldContent content = FieldContent::All) {
    GrainState state;
    takeState(scene, state, content);
    return state;
}

/// The same of a frame for ParaView: its grains and contacts. In periodic directions (a length above 0) a
/// contact leads to the nearest image. Throws InputError where a field is missing that is needed: with rigid
/// bodies, those that tell where their grains are in them.
GrainState stateOf(const PolyData& grains, const PolyData& contacts, const PeriodicBox& periodic);

}  // namespace pendular
