#pragma once

#include <vector>

#include "Kernel/Contacts/ContactEvents.h"
#include "Kernel/Contacts/LiquidLedger.h"
#include "Kernel/Contacts/LiquidStep.h"
#include "Kernel/Particles/GrainFilms.h"

namespace pendular {

/// The liquid of a scene on which LiquidStep works: films of grains by their places, bridges of contacts by
/// their numbers in the list. It is made for a moment in which neither changes.
struct ListedLiquid {
    using Number = std::uint32_t;

    ContactStore& store;
    const ContactLaws& laws;
    ParticleStore& grains;
    GrainFilms& films;
    const std::vector<QuantisedRules>& rulesOfBuckets;
    std::vector<double>& walls;    // m^3, the account of each
    std::vector<Number>& formed;   // contacts whose bridges have formed
    std::vector<Number>& changed;  // contacts whose volumes have changed

    [[nodiscard]] Quanta quantaOf(double volume) const {
        return static_cast<Quanta>(volume / films.quantum());  // exact
    }
    [[nodiscard]] double volumeOfQuanta(Quanta quanta) const {
        return static_cast<double>(quanta) * films.quantum();
    }
    [[nodiscard]] Quanta filmOf(Number grain) const { return quantaOf(films.of(grains, grain)); }
    void addToFilm(Number grain, Quanta volume) { films.add(grains, grain, volumeOfQuanta(volume)); }
    [[nodiscard]] Quanta volumeOf(Number contact) const {
        return quantaOf(store.memory.volumeOf(store.slotOf(contact)));
    }
    /// It acts from the next step on, for which the bridge is prepared again.
    void setVolume(Number contact, Quanta volume);
    void addToWall(Number contact, Quanta volume) {
        walls[static_cast<std::size_t>(bucketOf(contact).wall)] += volumeOfQuanta(volume);
    }
    [[nodiscard]] const QuantisedRules& rulesOf(Number contact) const {
        return rulesOfBuckets[static_cast<std::size_t>(&bucketOf(contact) - store.buckets.data())];
    }
    [[nodiscard]] bool touches(Number contact) const { return store.touches(contact); }
    [[nodiscard]] bool isAtWall(Number contact) const {
        return contact / Pack::lanes >= store.firstWallBlock();
    }
    [[nodiscard]] Number grainOf(Number contact, Number which) const {
        const ContactBlock& block = store.blocks[contact / Pack::lanes];
        return (which == 0 ? block.first : block.second)[contact % Pack::lanes];
    }
    /// Those of pairs whose liquid does not move are left out: nothing can form there.
    template <class Function>
    void forEachContactOf(Number grain, Function&& function) const {
        if (grain >= store.sides.grainCount()) return;
        for (const std::uint32_t side : store.sides.of(grain)) {
            const std::uint32_t contact = store.contactAt(side / 2);
            if (store.acts(contact) && moves(contact)) function(contact);
        }
    }
    [[nodiscard]] bool moves(Number contact) const;

private:
    [[nodiscard]] const Bucket& bucketOf(Number contact) const {
        return store.bucketOf(contact / Pack::lanes);
    }
};

/// Liquid that moves between films and bridges of a scene (LiquidStep has the model), from the touches and
/// ruptures of a step. One thread does it: few contacts change in a step.
class ContactLiquid {
public:
    /// @param films null: no liquid moves in this scene
    void prepare(GrainFilms* films, std::size_t wallCount) {
        filmsOfGrains = films;
        walls.resize(wallCount);
    }
    [[nodiscard]] bool moves() const { return filmsOfGrains != nullptr; }
    /// Contacts have been listed again.
    void listed(const ContactStore& store, const ContactLaws& laws, std::size_t wallCount);
    /// Before the forces of a step: bridges whose volumes have changed since the last one are prepared again.
    /// Until then observers see the forces that were.
    void prepareChanged(ContactStore& store, const ContactLaws& laws, const ParticleStore& grains);
    /// At the end of a step: what has begun and ended in it moves liquid. Bridges that form are added to the
    /// events.
    void move(ContactStore& store, const ContactLaws& laws, ParticleStore& grains, ContactEvents& events);
    /// A contact is about to end because a body is removed or changed.
    void release(ContactStore& store, const ContactLaws& laws, ParticleStore& grains, std::uint32_t contact);
    /// Values of species have changed: what bridges hold above V_max goes to films.
    void clip(ContactStore& store, const ContactLaws& laws, ParticleStore& grains);

    [[nodiscard]] LiquidLedger ledger(const ContactStore& store, const ParticleStore& grains) const;
    /// m^3, what a wall has got back minus what it gave.
    [[nodiscard]] double ofWall(std::size_t wall) const { return wall < walls.size() ? walls[wall] : 0; }
    void visitState(StateArchive& archive);
    /// When contacts have been listed that were read: throws InputError unless their volumes are whole.
    void requireWhole(const StateArchive& archive, const ContactStore& store) const;

private:
    ListedLiquid of(ContactStore& store, const ContactLaws& laws, ParticleStore& grains) {
        return {store, laws, grains, *filmsOfGrains, rules, walls, formed, changed};
    }
    void remember(const ParticleStore& grains);

    GrainFilms* filmsOfGrains = nullptr;
    std::vector<QuantisedRules> rules;  // of each bucket
    bool anyWetWall = false;
    std::vector<double> walls;          // m^3
    std::vector<std::uint32_t> looked;  // identities of grains to be looked at in the next step
    std::vector<std::uint32_t> places, ruptured, formed;
    std::vector<std::uint32_t> changed;  // contacts in the list, to be prepared
    LiquidStep<ListedLiquid> step;
};

}  // namespace pendular
