#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/HeldContacts.h"
#include "Kernel/Core/Contacts/ListLife.h"
#include "Kernel/Core/Contacts/NeighbourSearch.h"
#include "Kernel/Core/Contacts/PairOrder.h"

namespace pendular {

class RememberedContacts;
class WallHandler;

/// The largest range (m) that two bodies can have of which one is a grain of the scene and the other one too,
/// or a ghost; a law's range is taken to be monotonous in the radii.
[[nodiscard]] double largestRange(const ContactLaws& laws, const ParticleStore& grains);

/// Lists again the contacts that can act before two bodies have approached by the skin, and takes over the
/// memory of those that were listed before. A bridge that forms at contact only needs no search at its own
/// length: the pairs it joins are remembered, and all others must touch first.
class ContactList {
public:
    using Grains = ParticleStore;

    /// @param oldBridges bodies and laws are as they were when bridges were prepared; @param listReach m, at
    /// which bodies are listed where their range is shorter; @param filmsReach m, the same, but no farther
    /// than their range; @param ofHeld contacts of bodies that are held along all axes
    ContactList(const ContactLaws& contactLaws, const WallHandler& wallHandler, const PeriodicBox& box,
                double skinWidth, int threadCount, bool oldBridges = true, double listReach = 0,
                double filmsReach = 0, const ListedOfHeld& ofHeld = {})
        : laws(contactLaws),
          walls(wallHandler),
          periodic(box),
          skin(skinWidth),
          threads(threadCount),
          keepsBridges(oldBridges),
          reachOfAll(listReach),
          reachOfFilms(filmsReach),
          listsOfHeld(ofHeld) {}

    /// Sorts the grains in space and lists their contacts.
    /// @param old those that were taken or read when the grains were where they are, whose memory the store
    /// has
    /// @param keepsCells for takeSearch()
    /// @param apart m, about by how much bodies that touched in the last step can be apart now
    /// Returns how many of them are listed again.
    std::size_t rebuild(Grains& grains, ContactStore& store, const RememberedContacts& old, bool keepsCells,
                        double apart = infinity);
    /// Sorts pairs by the gaps that are expected after this time (s), if grains go on as they move now.
    void setHorizon(double time) { horizon = time; }
    /// Notes which grains are near a wall: by so much (m) farther than the skin.
    void noteGrainsNearWalls(double farther) {
        nearWalls.farther = farther;
        nearWalls.times = laws.formsAtContact ? 2 : 1;
    }
    [[nodiscard]] ListLife::NearWalls takeNearWalls() { return std::move(nearWalls); }
    /// The cells in which the list was made.
    [[nodiscard]] NeighbourSearch takeSearch() { return std::move(*found); }

private:
    struct Group {
        Bucket bucket;
        std::vector<ListedPair> contacts;
    };
    using Groups = std::vector<Group>;

    double rangeOf(int a, int b, const Bodies& bodies) const { return laws.range(a, b, bodies); }

    static Group& groupOf(Groups& all, int species1, int species2, int wall);

    /// Calls function(groups, begin, end) for ranges of all grains, each with groups of its own, and adds
    /// these up in the order of the ranges.
    template <class Function>
    void listInParts(std::size_t grainCount, Function&& function);

    /// @param pairsBefore of the last list, about
    void findPairs(const Grains& grains, const RememberedContacts& old, std::size_t pairsBefore,
                   bool keepsCells);

    bool nearEnough(const Grains& grains, std::uint32_t i, std::uint32_t j) const;

    /// Two ghosts are no pair of this rank.
    /// @param gap m, of the surfaces; @param closing m/s, the speed at which it closes
    void addPair(Groups& all, const Grains& grains, std::uint32_t i, std::uint32_t j, double gap,
                 double closing = 0) const;
    void findWallContacts(const Grains& grains, const RememberedContacts& old);

    void findWallContacts(const Grains& grains, const RememberedContacts& old, std::size_t w, std::uint32_t i,
                          Groups& all, std::vector<std::uint32_t>& parts);

    /// Sorts each stretch of the list by itself (PairOrder): stretches are short enough for the grains to
    /// stay in the cache.
    void sortPairs(Group& g) const;

    /// The gap of the surfaces (m).
    double gapOf(const Grains& grains, std::uint32_t i, std::uint32_t j) const;
    /// The gap (m) at which two grains begin to act: at a distance, or where their films meet.
    double actsFrom(const Grains& grains, std::uint32_t first, std::uint32_t second) const;

    /// Contacts that count on another rank, whose body 1 is a ghost, get groups of their own.
    void separateThoseOfOthers(const Grains& grains);
    /// Turns the groups into blocks.
    void fill(const Grains& grains, ContactStore& store);

    /// @param b of the group
    void fillBlock(const Group& g, std::size_t b, ContactStore& store) const;

    static constexpr std::size_t worthAThread = 128;  // grains or blocks
    const ContactLaws& laws;
    const WallHandler& walls;
    const PeriodicBox& periodic;
    double skin;
    int threads;
    bool keepsBridges;
    double reachOfAll, reachOfFilms;
    ListedOfHeld listsOfHeld;
    ListLife::NearWalls nearWalls;
    double horizon = 0;  // s
    std::optional<NeighbourSearch> found;
    std::vector<std::uint32_t> formerPlace;  // of the grain at each place
    Groups groups;
};

}  // namespace pendular
