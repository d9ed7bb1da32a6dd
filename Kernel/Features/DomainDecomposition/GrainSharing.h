#pragma once

#include <functional>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Ranks/AllRanks.h"
#include "Kernel/Core/Ranks/Exchange.h"
#include "Kernel/Features/DomainDecomposition/Bisection.h"
#include "Kernel/Features/DomainDecomposition/RankTimes.h"

namespace pendular {

/// How a scene is shared by ranks.
struct RankOptions {
    /// Space is cut anew, and unevenly, at each list of contacts, so that many grains change their rank: for
    /// tests.
    bool cutsWander = false;
    double wanderBy = 0.5;  // how uneven these cuts are
    /// Space is cut anew by measured times, too: as often as ranks have worked for so long (s).
    double balanceAfter = 2;
};

/// What this rank has done so far.
struct RankCounts {
    std::size_t lists = 0;      // of contacts
    std::size_t migrated = 0;   // grains that went to another rank
    std::size_t asked = 0;      // copies of grains that others have sent for a list, sum over the lists
    std::size_t ghosts = 0;     // and of these, those that are in a contact or a rigid body
    std::size_t heldTwice = 0;  // contacts that came from two ranks, over the lists
    std::size_t unequal = 0;    // and of these, those that were not the same bit for bit
    double load = 0;            // of the own grains at the last list: see Luggage
    std::size_t cuts = 0;       // of space
    double cutting = 0;         // s, these have taken
    double listing = 0;         // s, lists have taken without that, and with waiting
    double working = 0;         // s, steps between lists, without waiting for others
    double waiting = 0;         // s, in these steps
};

/// Who has all grains after they have been gathered.
enum class GatheredOn { AllRanks, FirstRank };

/// What goes along with grains to other ranks.
struct Luggage {
    /// What the grain at a place, with its contacts, takes of the time of a step.
    std::function<double(std::uint32_t place)> weightOf;
    /// @param owners from now on, of each place of an own grain
    std::function<void(std::span<const std::size_t> owners, std::span<Message> toEach)> pack;
    /// With all own grains.
    std::function<void(Message& message)> packAll;
    std::function<void(Message&)> unpack;
};

/// Shares the grains of a scene with other ranks. Each grain is owned by one rank, which sums its forces and
/// moves it: the rank in whose part of space it is when contacts are listed. A rank has copies (ghosts) of
/// all grains that may touch one of its own until the next list, and computes all contacts that have an own
/// grain: those across ranks twice, with the same bits. So no force goes from rank to rank, and grains go
/// once in a step. A rigid body is owned as a whole, by where its centre is, and is a ghost as a whole.
class GrainSharing {
public:
    GrainSharing(Exchange& with, const RankOptions& how) : exchange(with), options(how) {}

    /// Before contacts are listed: grains that have left the part of this rank go to another one, and ghosts
    /// are found again. The first time all ranks have all grains.
    /// @param reach m, of surfaces between which contacts must be listed
    void distribute(ParticleStore& grains, const PeriodicBox& box, double reach, const Luggage& luggage);
    /// All ranks get all grains, as before the first list; or the first one alone does, and the others keep
    /// theirs, with their ghosts. What a rank has that got them is that of the scene: nothing is to be summed
    /// over ranks until the next list. Before the first one gets all, space is cut anew where that is due.
    void gather(ParticleStore& grains, const PeriodicBox& box, const Luggage& luggage, GatheredOn where);
    /// The first rank, which alone had got all grains, has its own ones again, and all ranks can share them.
    void dropOthers(ParticleStore& grains);
    /// The next time, all ranks have all grains whose identities begin at this one, as at first.
    void expectOnAll(std::uint32_t first) { onAllFrom = first; }
    /// After a list: copies that are in none of its contacts are gaps until the next one, and are not sent.
    /// @param isListed of each place
    void keepGhosts(ParticleStore& grains, const std::vector<bool>& isListed);
    /// After grains have been sorted, or have gone from all ranks.
    void findPlaces(const ParticleStore& grains);
    /// Ghosts get the motion of the grains that they stand for.
    /// @param withAccelerations contacts feel them
    void exchangeMotion(ParticleStore& grains, bool withAccelerations);
    /// The same for a step, and at the same time the largest of how far grains have moved on the ranks, and
    /// whether a number is the same on all of them.
    /// @param ownShift m; what is not a number counts as infinite
    struct OfAll {
        double shift;  // m
        bool areAlike;
    };
    [[nodiscard]] OfAll exchangeStep(ParticleStore& grains, bool withAccelerations, double ownShift,
                                     std::uint64_t alike);
    /// Whether all ranks give the same number; and the largest of another one.
    [[nodiscard]] OfAll agree(Reduction what, std::uint64_t alike, double own = 0);
    [[nodiscard]] std::vector<std::string> textsOfAll(const std::string& own) {
        return exchange.textsOfAll(own);
    }

    /// Ghosts get a number of the grains, or of the rigid bodies, that they stand for.
    /// @param ofGrains at each place; @param ofBodies at each place, ghosts included
    void tellGhosts(std::span<double> ofGrains, std::span<double> ofBodies);

    /// They know something together from the first list on: before it, each has all grains.
    [[nodiscard]] AllRanks allRanks() const { return {exchange, isDistributed}; }
    /// The largest of what the ranks give, also where each has all grains.
    [[nodiscard]] double largest(double own) { return exchange.largest(own); }
    [[nodiscard]] std::size_t rank() const { return exchange.rank(); }
    /// What each rank gives, in the order of ranks.
    template <class Value>
    [[nodiscard]] std::vector<Value> ofAll(const Value& own) {
        return exchange.ofAll(own);
    }
    /// How many grains all ranks have together, as of the last list or the last time that they were counted.
    [[nodiscard]] std::size_t countOfAll() const { return countInAll; }
    /// Counts them where grains have come or gone: all ranks call it.
    void countAll(const ParticleStore& grains);
    /// Whether each rank has its own grains only: from the first list on, until they are gathered.
    [[nodiscard]] bool areDistributed() const { return isDistributed; }
    [[nodiscard]] RankCounts counts() const;
    void countHeldTwice(std::size_t all, std::size_t unequal) {
        done.heldTwice += all, done.unequal += unequal;
    }

private:
    void cutAnew(const ParticleStore& grains, const PeriodicBox& box, const Luggage& luggage);
    /// Whether one rank has too much more to do than the mean, of a scene that is worth it.
    [[nodiscard]] bool areImbalanced(const ParticleStore& grains, const Luggage& luggage);
    void migrate(ParticleStore& grains, const PeriodicBox& box, const Luggage& luggage);
    static void takeGrains(Message message, ParticleStore& grains, const Luggage& luggage);
    /// Of the own grain at each place.
    [[nodiscard]] std::vector<std::size_t> findOwners(const ParticleStore& grains,
                                                      const PeriodicBox& box) const;
    /// Bodies go with their first grains. @param owners of these
    void packBodies(RigidBodies& bodies, const ParticleStore& grains, std::span<const std::size_t> owners,
                    std::span<Message> toEach) const;
    void findGhosts(ParticleStore& grains, const PeriodicBox& box, double reach);

    /// What is known of own grains and bodies goes to their ghosts: grainAt(place) and bodyAt(place), to
    /// takeGrain(place, this) and takeBody(place, this).
    template <class GrainAt, class BodyAt, class TakeGrain, class TakeBody>
    void exchangeWithGhosts(GrainAt&& grainAt, BodyAt&& bodyAt, TakeGrain&& takeGrain, TakeBody&& takeBody);
    template <bool spins, bool accelerates>
    void exchangeMotionOf(ParticleStore& grains);

    Exchange& exchange;
    RankOptions options;
    Bisection cuts;
    RankTimes times;
    bool isDistributed = false;
    std::uint32_t onAllFrom = ~std::uint32_t{0};
    std::vector<bool> wereOwn;  // of each identity, before the first rank got all grains; empty: it has not
    std::size_t countInAll = 0;
    RankCounts done;
    using OfEachRank = std::vector<std::vector<std::uint32_t>>;
    OfEachRank sent, got;                          // identities of ghosts, to and from each rank
    OfEachRank sentPlaces, gotPlaces;              // of these
    OfEachRank sentBodies, gotBodies;              // numbers of rigid bodies
    OfEachRank sentBodiesPlaces, gotBodiesPlaces;  // of these
};

}  // namespace pendular
