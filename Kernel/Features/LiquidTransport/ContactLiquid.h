#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Features/ContactEvents/ContactEvents.h"
#include "Kernel/Features/LiquidTransport/Evaporation.h"
#include "Kernel/Features/LiquidTransport/GrainFilms.h"
#include "Kernel/Features/LiquidTransport/LiquidLedger.h"
#include "Kernel/Features/LiquidTransport/LiquidOfRanks.h"
#include "Kernel/Features/LiquidTransport/LiquidStep.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {

/// Two bodies that have not touched, whose films meet.
struct FilmContact {
    std::uint32_t contact;
    double gap, start;  // m, now, and where they met: the gap before the last drift at most
};

/// The liquid of a scene on which LiquidStep works: films of grains by their places, bridges of contacts by
/// their numbers in the list. It is made for a moment in which neither changes.
struct ListedLiquid {
    using Number = std::uint32_t;

    ContactStore& store;
    ParticleStore& grains;
    GrainFilms& films;
    const std::vector<QuantisedRules>& rulesOfBuckets;
    std::vector<double>& walls;    // m^3, the account of each
    std::vector<Number>& formed;   // contacts whose bridges have formed
    std::vector<Number>& changed;  // contacts whose volumes have changed
    const std::vector<FilmContact>& filmContacts;
    LiquidOfRanks others;

    [[nodiscard]] bool isOwn(Number grain) const { return others.isOwn(grain); }
    /// What other ranks offer to contacts of own grains. (Offers as LiquidStep has them.)
    template <class Offers>
    void addOffersOfOthers(Offers& offers) const {
        if (!others.ranks.areSeveral()) return;
        std::vector<LiquidOfRanks::Told> own;
        for (const auto& offer : offers)
            if (const auto told = others.of(*this, offer.contact, offer.volume); told.from != told.to)
                own.push_back(told);
        others.exchange(*this, own, [&](Number contact, const LiquidOfRanks::Told& told) {
            const Number side = grains.identity[grainOf(contact, 0)] == told.from ? 0 : 1;
            offers.push_back({contact, side, told.volume});
        });
    }
    /// Contacts of own grains that draw from films because of the other grain.
    void addDrawingOfOthers(std::vector<Number>& drawing) const {
        if (!others.ranks.areSeveral()) return;
        others.exchange(*this, toldOf(drawing, [](Number, Number) { return Quanta{0}; }),
                        [&](Number contact, const LiquidOfRanks::Told&) { drawing.push_back(contact); });
    }
    /// The part that the ghost of each of these contacts offers; 0 of a contact without one.
    /// @param drawing sorted; @param partOf (grain, contact) what a grain offers to one of them
    template <class Function>
    [[nodiscard]] std::vector<Quanta> partsOfOthers(const std::vector<Number>& drawing,
                                                    Function&& partOf) const {
        std::vector<Quanta> parts(drawing.size());
        if (!others.ranks.areSeveral()) return parts;
        others.exchange(*this, toldOf(drawing, partOf), [&](Number contact, const LiquidOfRanks::Told& told) {
            const auto found = std::ranges::lower_bound(drawing, contact);
            if (found != drawing.end() && *found == contact)
                parts[static_cast<std::size_t>(found - drawing.begin())] = told.volume;
        });
        return parts;
    }

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
    /// Or their films do, where that makes a bridge.
    [[nodiscard]] bool touches(Number contact) const {
        return store.touches(contact) || findFilmContact(contact) != nullptr;
    }
    /// Null if their films do not meet at a gap, or no bridge forms there.
    [[nodiscard]] const FilmContact* findFilmContact(Number contact) const {
        if (filmContacts.empty()) return nullptr;
        const auto found = std::ranges::lower_bound(filmContacts, contact, {}, &FilmContact::contact);
        return found != filmContacts.end() && found->contact == contact ? &*found : nullptr;
    }
    [[nodiscard]] bool isAtWall(Number contact) const {
        return contact / Pack::lanes >= store.firstWallBlock();
    }
    [[nodiscard]] Number grainOf(Number contact, Number which) const {
        const ContactBlock& block = store.blocks[contact / Pack::lanes];
        return (which == 0 ? block.first : block.second)[contact % Pack::lanes];
    }
    /// Contacts of pairs whose liquid does not move are left out: nothing can form there.
    template <class Function>
    void forEachContactOf(Number grain, Function&& function) const {
        if (grain >= store.sides.grainCount()) return;
        for (const std::uint32_t side : store.sidesOf(grain)) {
            const std::uint32_t contact = store.contactAt(side / 2);
            if ((store.acts(contact) || findFilmContact(contact)) && moves(contact)) function(contact);
        }
    }
    [[nodiscard]] bool moves(Number contact) const;

private:
    [[nodiscard]] const Bucket& bucketOf(Number contact) const {
        return store.bucketOf(contact / Pack::lanes);
    }
    template <class Function>
    [[nodiscard]] std::vector<LiquidOfRanks::Told> toldOf(const std::vector<Number>& contacts,
                                                          Function&& volumeOf) const {
        std::vector<LiquidOfRanks::Told> all;
        for (const Number contact : contacts) {
            LiquidOfRanks::Told told = others.of(*this, contact, 0);
            if (told.from == told.to) continue;
            const Number first = grainOf(contact, 0);
            told.volume = volumeOf(isOwn(first) ? first : grainOf(contact, 1), contact);
            all.push_back(told);
        }
        return all;
    }
};

/// The energy (J) that the liquid of a scene has given to its bridges in a step, by coming to them or going
/// from them.
struct LiquidEnergy {
    double migration = 0, evaporation = 0;
};

/// Liquid that moves between films and bridges of a scene (LiquidStep has the model), from the touches and
/// ruptures of a step. One thread does it: few contacts change in a step.
class ContactLiquid {
public:
    /// @param films null: no liquid moves in this scene
    void prepare(GrainFilms* films, const WallHandler& wallHandler, const PeriodicBox& box);
    /// Ranks share the grains.
    void share(const AllRanks& with) { ranks = with; }
    /// How the liquid dries, from now on.
    void setEvaporation(const Evaporation& law) { drying = law; }
    [[nodiscard]] const Evaporation& evaporation() const { return drying; }
    [[nodiscard]] bool moves() const { return filmsOfGrains != nullptr; }
    /// Contacts have been listed again.
    void listed(const ContactStore& store, const LiquidLaws& laws);
    /// Prepares again, before the forces of a step, the bridges whose volumes have changed since the last
    /// one; where they have dried only, when the volume has changed by 0.1 % since the last preparation. (d
    /// ln F / d ln V is 0 to 1, and the rupture distance goes as V^(1/3).) Until then observers see the
    /// forces that were.
    void prepareChanged(ContactStore& store, const ContactLaws& laws, const ParticleStore& grains);
    /// Whether bridges of the scene form where films meet, and the largest gap (m) at which those of these
    /// grains can.
    [[nodiscard]] bool formsAtFilms(const ContactLaws& laws) const;
    [[nodiscard]] double largestFilmContact(const ParticleStore& grains) const;  // of all ranks
    [[nodiscard]] double largestFilmContactHere(const ParticleStore& grains) const;
    /// Called at the end of a step (s), before move(): the contacts without a bridge whose films meet, in the
    /// order of the list. They need memory for move().
    /// @param approached m, that bodies can have approached since they were listed
    const std::vector<FilmContact>& findFilmContacts(const ContactStore& store, const LiquidLaws& laws,
                                                     const ParticleStore& grains, double length,
                                                     double approached);
    /// Called at the end of a step: what has begun and ended in it moves liquid. Bridges that form are added
    /// to the events.
    void move(ContactStore& store, const LiquidLaws& laws, ParticleStore& grains, ContactEvents& events);
    /// Called at the end of a step (s) that ends at a time (s), after move(): films and bridges dry. A bridge
    /// that gets too small for its gap ruptures in the next step.
    void dry(ContactStore& store, const ContactLaws& laws, ParticleStore& grains, double time, double length);
    /// The energy that changes of volumes have given to bridges, on all ranks, since this was called last.
    [[nodiscard]] LiquidEnergy takeEnergy();
    /// Bridges that have dried to nothing.
    [[nodiscard]] std::uint64_t driedBridges() const { return driedOut; }
    /// A droplet (m^3, a multiple of the quantum) hits a wall. False if the wall is dry.
    [[nodiscard]] bool giveToWall(const ContactLaws& laws, std::size_t wall, double volume);
    /// Liquid of droplets (m^3, a multiple of the quantum) evaporates.
    void addEvaporated(double volume) { evaporated += volume; }
    /// A touch of the grain has begun or ended between two steps: in the next one its film may be drawn.
    void lookAt(std::uint32_t identity) { looked.push_back(identity); }
    /// A contact is about to end because a body is removed or changed.
    void release(ContactStore& store, ParticleStore& grains, std::uint32_t contact);
    /// Values of species have changed: what bridges hold above V_max goes to films.
    void clip(ContactStore& store, ParticleStore& grains);

    /// Of all ranks.
    [[nodiscard]] LiquidLedger ledger(const ContactStore& store, const ParticleStore& grains) const;
    /// m^3, what a wall has got back minus what it gave, on all ranks.
    [[nodiscard]] double ofWall(std::size_t wall) const {
        return sumOfRanks(wall < walls.size() ? walls[wall] : 0);
    }
    /// The accounts of each rank become those of all, until they share the grains again: from then on the
    /// first one goes on with them, and the others begin anew.
    void gather();
    void leaveToFirstRank();
    void visitState(StateArchive& archive);
    /// Called when contacts have been listed that were read: throws InputError unless their volumes are
    /// whole.
    void requireWhole(const StateArchive& archive, const ContactStore& store) const;

private:
    ListedLiquid of(ContactStore& store, ParticleStore& grains) {
        return {store, grains, *filmsOfGrains, rules, walls, formed, changed, filmContacts, {ranks, grains}};
    }
    void remember(const ParticleStore& grains);
    void sumRemovedWalls();
    /// Own grains among these, and those that others have looked at but own no more, are to be looked at.
    void look(const ParticleStore& grains, std::vector<std::uint32_t> identities);
    /// Whether it counts on this rank.
    [[nodiscard]] static bool countsHere(const ContactStore& store, const ParticleStore& grains,
                                         std::uint32_t contact) {
        return store.firstOf(contact) < grains.ownSize();
    }
    [[nodiscard]] double sumOfRanks(double own) const {
        ExactSum sum;
        sum.add(own);
        return ranks.sum(sum);
    }
    void dryFilms(ParticleStore& grains, double time);
    void dryBridges(ContactStore& store, const ContactLaws& laws, ParticleStore& grains, double time);
    [[nodiscard]] double leftOfBridge(const ContactStore& store, const ContactLaws& laws,
                                      const ParticleStore& grains, std::uint32_t contact, double time) const;
    [[nodiscard]] double lost(double volume, std::uint64_t whose, std::uint32_t purpose) const;
    [[nodiscard]] double separationOf(const ContactStore& store, const ContactLaws& laws,
                                      const ParticleStore& grains, std::uint32_t contact) const;
    void lookForFilms(const ContactStore& store, const LiquidLaws& laws, const ParticleStore& grains,
                      const Bucket& bucket, std::uint32_t contact, double length);
    void bookChange(ContactStore& store, const ContactLaws& laws, const ParticleStore& grains,
                    std::uint32_t contact, const double* before, bool byMigration);

    AllRanks ranks;
    GrainFilms* filmsOfGrains = nullptr;
    const WallHandler* shapes = nullptr;
    const PeriodicBox* periodic = nullptr;
    Evaporation drying;
    double sinceUpdate = 0;             // s, in which nothing has dried yet
    std::uint64_t stepsSince = 0;       // the steps of it
    std::uint64_t updates = 0;          // of volumes by drying
    std::uint64_t driedOut = 0;         // bridges
    double evaporated = 0;              // m^3
    ExactSum byMigration, byDrying;     // J, since takeEnergy()
    std::vector<QuantisedRules> rules;  // of each bucket
    bool anyWetWall = false;
    std::vector<double> walls;                // m^3, by number
    double givenByRemoved = 0;                // m^3, of these, by walls that were removed
    std::optional<std::size_t> removedWalls;  // so many, when that was summed
    std::vector<std::uint32_t> looked;        // identities of grains to be looked at in the next step
    bool anyAtFilms = false;
    std::vector<FilmContact> filmContacts;  // of this step
    std::vector<std::uint32_t> places, ruptured, formed;
    std::vector<std::uint32_t> changed;  // contacts in the list, to be prepared
    LiquidStep<ListedLiquid> step;
};

}  // namespace pendular
