#include "Kernel/Features/DomainDecomposition/GrainSharing.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

#include "Kernel/Features/DomainDecomposition/GrainExtents.h"

namespace pendular {

namespace {

void addRow(Message& message, ParticleStore& grains, std::size_t at) {
    message.add(grains.identity[at]);
    grains.visitRow(at, [&](const auto& value) { message.add(value); });
}

void takeRow(Message& message, ParticleStore& grains, std::size_t at) {
    grains.visitRow(at, [&](auto& value) { message.take(value); });
}

void addBodies(Message& message, const RigidBodies& bodies, std::span<const std::uint32_t> places) {
    message.add(static_cast<std::uint32_t>(places.size()));
    for (const std::uint32_t at : places) bodies.writeRow(at, [&](const auto& value) { message.add(value); });
}

void takeBodies(Message& message, RigidBodies& bodies, bool areGhosts) {
    for (auto left = message.take<std::uint32_t>(); left > 0; --left)
        bodies.takeRow([&](auto& value) { message.take(value); }, areGhosts);
}

}  // namespace

void GrainSharing::distribute(ParticleStore& grains, const PeriodicBox& box, double reach,
                              const Luggage& luggage) {
    times.beginList(exchange);
    if (!isDistributed) countInAll = grains.count();
    // After an output the cuts are those from before it: the first rank does not know what its own take.
    const bool isAfterOutput = !std::exchange(wereOwn, {}).empty();
    const double before = done.cutting;
    if (!isDistributed || options.cutsWander || (!isAfterOutput && areImbalanced(grains, luggage)))
        cutAnew(grains, box, luggage);
    done.listing -= done.cutting - before;  // which RankTimes counts
    migrate(grains, box, luggage);
    isDistributed = grains.isShared = true;
    findGhosts(grains, box, reach);
    ++done.lists;
    done.asked += grains.size() - grains.ownSize();
}

bool GrainSharing::areImbalanced(const ParticleStore& grains, const Luggage& luggage) {
    done.load = 0;
    for (std::uint32_t k = 0; k < grains.ownSize(); ++k)
        if (!grains.isGap(k)) done.load += luggage.weightOf(k);
    return times.areImbalanced(exchange, done.load, options.balanceAfter);
}

RankCounts GrainSharing::counts() const {
    RankCounts all = done;
    const RankTimes::Sums took = times.sums(exchange);
    all.working = took.working;
    all.waiting = took.waiting;
    all.listing += took.listing;
    return all;
}

/// Where all ranks have all grains, each gives its share of the points. A grain weighs as it takes time on
/// the rank that had it.
void GrainSharing::cutAnew(const ParticleStore& grains, const PeriodicBox& box, const Luggage& luggage) {
    const auto begin = std::chrono::steady_clock::now();
    const std::size_t first = isDistributed ? 0 : exchange.rank(),
                      step = isDistributed ? 1 : exchange.count();
    std::vector<Bisection::Point> points;
    for (std::size_t k = first; k < grains.ownSize(); k += step) {
        if (grains.isGap(k)) continue;
        const Vector<double> position = box.wrap(grains.translation[k].position);
        const double slowness = times.areMeasured() ? times.slownessOf(cuts.ownerOf(position)) : 1;
        points.push_back({position, slowness * luggage.weightOf(static_cast<std::uint32_t>(k))});
    }
    std::vector<double> shares(exchange.count(), 1);
    if (options.cutsWander)
        for (std::size_t q = 0; q < shares.size(); ++q)
            shares[q] += options.wanderBy * static_cast<double>((7 * done.lists + 3 * q) % 5);
    cuts.cut(exchange, points, shares);
    ++done.cuts;
    done.cutting += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void GrainSharing::migrate(ParticleStore& grains, const PeriodicBox& box, const Luggage& luggage) {
    const std::size_t self = exchange.rank();
    const std::vector<std::size_t> owners = findOwners(grains, box);
    std::vector<std::uint32_t> staying, leaving;
    for (std::uint32_t k = 0; k < owners.size(); ++k) {
        if (grains.isGap(k)) continue;
        if (owners[k] == self) staying.push_back(k);
        else if (grains.identity[k] < onAllFrom) leaving.push_back(k);
    }
    std::vector<Message> toEach(exchange.count());
    std::vector<std::uint32_t> numbers(exchange.count());
    for (const std::uint32_t k : leaving) ++numbers[owners[k]];
    for (std::size_t q = 0; q < exchange.count(); ++q) toEach[q].add(numbers[q]);
    for (const std::uint32_t k : leaving) addRow(toEach[owners[k]], grains, k);
    packBodies(grains.bodies, grains, owners, toEach);
    onAllFrom = ~std::uint32_t{0};
    if (!isDistributed) return grains.keepOnly(staying);  // the others have them
    luggage.pack(owners, toEach);
    done.migrated += leaving.size();
    grains.keepOnly(staying);
    for (Message& message : exchange.swap(std::move(toEach))) takeGrains(std::move(message), grains, luggage);
    grains.bodies.sort();
}

/// The message gives its memory back.
void GrainSharing::takeGrains(Message message, ParticleStore& grains, const Luggage& luggage) {
    for (auto left = message.take<std::uint32_t>(); left > 0; --left)
        takeRow(message, grains, grains.addPlace(message.take<std::uint32_t>()));
    takeBodies(message, grains.bodies, false);
    luggage.unpack(message);
}

void GrainSharing::gather(ParticleStore& grains, const PeriodicBox& box, const Luggage& luggage,
                          GatheredOn where) {
    if (where == GatheredOn::FirstRank) {
        times.beginList(exchange);  // the list that comes after the output
        if (areImbalanced(grains, luggage)) cutAnew(grains, box, luggage);
    }
    times.endSteps(exchange);
    const auto gets = [&](std::size_t q) { return where == GatheredOn::AllRanks || q == 0; };
    const std::size_t self = exchange.rank();
    std::vector<std::uint32_t> own, bodies(grains.bodies.size());
    for (std::uint32_t k = 0; k < grains.ownSize(); ++k)
        if (!grains.isGap(k)) own.push_back(k);
    std::iota(bodies.begin(), bodies.end(), 0u);
    Message message;
    message.add(static_cast<std::uint32_t>(own.size()));
    for (const std::uint32_t k : own) addRow(message, grains, k);
    addBodies(message, grains.bodies, bodies);
    luggage.packAll(message);
    std::vector<Message> toEach(exchange.count());
    for (std::size_t q = exchange.count(); q-- > 0;) {
        if (q == self || !gets(q)) continue;  // it has them, or does not want them
        if (where == GatheredOn::FirstRank) toEach[q] = std::move(message);
        else toEach[q] = message;
    }
    message = {};
    std::vector<Message> fromEach = exchange.swap(std::move(toEach));
    if (where == GatheredOn::FirstRank) {
        wereOwn.assign(std::size_t{grains.nextIdentity()} + 1, false);
        for (const std::uint32_t k : own) wereOwn[grains.identity[k]] = true;
    }
    if (!gets(self)) return;
    grains.keepOnly(own);
    grains.bodies.keepOnly(bodies);
    isDistributed = grains.isShared = false;
    for (std::size_t q = 0; q < exchange.count(); ++q)
        if (q != self) takeGrains(std::move(fromEach[q]), grains, luggage);
    grains.bodies.sort();
}

void GrainSharing::countAll(const ParticleStore& grains) {
    auto own = static_cast<std::int64_t>(grains.count());
    exchange.addUp({&own, 1});
    countInAll = static_cast<std::size_t>(own);
}

void GrainSharing::dropOthers(ParticleStore& grains) {
    countInAll = grains.count();
    std::vector<std::uint32_t> own, bodies;
    for (std::uint32_t k = 0; k < grains.ownSize(); ++k)
        if (!grains.isGap(k) && wereOwn[grains.identity[k]]) own.push_back(k);
    for (std::uint32_t k = 0; k < grains.bodies.size(); ++k)
        if (wereOwn[grains.bodies.membersOf(k).front().grain]) bodies.push_back(k);
    grains.keepOnly(own);
    grains.bodies.keepOnly(bodies);
    isDistributed = grains.isShared = true;
}

std::vector<std::size_t> GrainSharing::findOwners(const ParticleStore& grains, const PeriodicBox& box) const {
    std::vector<std::size_t> owners(grains.ownSize());
    for (std::uint32_t k = 0; k < owners.size(); ++k)
        if (!grains.isGap(k)) owners[k] = cuts.ownerOf(box.wrap(grains.translation[k].position));
    const RigidBodies& bodies = grains.bodies;
    for (std::size_t k = 0; k < bodies.size(); ++k)
        for (const BodyMember& member : bodies.membersOf(k))
            owners[grains.place[member.grain]] = cuts.ownerOf(box.wrap(bodies[k].position));
    return owners;
}

void GrainSharing::packBodies(RigidBodies& bodies, const ParticleStore& grains,
                              std::span<const std::size_t> owners, std::span<Message> toEach) const {
    std::vector<std::uint32_t> staying;
    OfEachRank leaving(exchange.count());
    for (std::uint32_t k = 0; k < bodies.size(); ++k) {
        const std::uint32_t first = bodies.membersOf(k).front().grain;
        const std::size_t owner = owners[grains.place[first]];
        if (owner == exchange.rank()) staying.push_back(k);
        else if (first < onAllFrom) leaving[owner].push_back(k);
    }
    for (std::size_t q = 0; q < exchange.count(); ++q) addBodies(toEach[q], bodies, leaving[q]);
    bodies.keepOnly(staying);
}

namespace {

/// What one rank needs of another's grains and rigid bodies.
struct Wanted {
    std::vector<std::uint32_t> grains, bodies;  // places
};

/// @param isNear (position inside the scene, radius) to what the other rank owns. Of a rigid body either none
/// or all of its grains are wanted.
template <class Function>
Wanted findWanted(const ParticleStore& grains, const PeriodicBox& box, Function&& isNear) {
    Wanted found;
    const auto isNearAt = [&](std::uint32_t place) {
        const TranslationRecord& grain = grains.translation[place];
        return isNear(box.wrap(grain.position), grain.radius);
    };
    const RigidBodies& bodies = grains.bodies;
    for (std::uint32_t place = 0; place < grains.size(); ++place)
        if (!bodies.contains(grains.identity[place]) && isNearAt(place)) found.grains.push_back(place);
    for (std::uint32_t k = 0; k < bodies.size(); ++k) {
        const std::span<const BodyMember> members = bodies.membersOf(k);
        if (std::ranges::none_of(members,
                                 [&](const BodyMember& one) { return isNearAt(grains.place[one.grain]); }))
            continue;
        found.bodies.push_back(k);
        for (const BodyMember& member : members) found.grains.push_back(grains.place[member.grain]);
    }
    return found;
}

}  // namespace

void GrainSharing::findGhosts(ParticleStore& grains, const PeriodicBox& box, double reach) {
    double largestHere = 0;
    for (const TranslationRecord& grain : grains.translation)
        largestHere = std::max(largestHere, grain.radius);
    const double largestOfAll = exchange.largest(largestHere);
    GrainExtents own;
    for (const TranslationRecord& grain : grains.translation)
        own.add(box.wrap(grain.position), grain.radius, largestOfAll);
    const std::vector<GrainExtents> extents = exchange.ofAll(own);
    const std::vector<Vector<double>> images = imageOffsets(box);
    std::vector<Message> toEach(exchange.count());
    for (OfEachRank* const of : {&sent, &got, &sentBodies, &gotBodies}) of->assign(exchange.count(), {});
    for (std::size_t q = 0; q < exchange.count(); ++q) {
        if (q == exchange.rank() || extents[q].areEmpty()) continue;
        const Wanted wanted = findWanted(grains, box, [&](const Vector<double>& inside, double radius) {
            return std::ranges::any_of(images, [&](const Vector<double>& offset) {
                return extents[q].areNear(inside + offset, radius, reach);
            });
        });
        addBodies(toEach[q], grains.bodies, wanted.bodies);
        for (const std::uint32_t at : wanted.bodies) sentBodies[q].push_back(grains.bodies.numberOf(at));
        for (const std::uint32_t place : wanted.grains) {
            addRow(toEach[q], grains, place);
            sent[q].push_back(grains.identity[place]);
        }
    }
    std::vector<Message> fromEach = exchange.swap(std::move(toEach));
    for (std::size_t q = 0; q < exchange.count(); ++q) {
        if (fromEach[q].isTaken()) continue;
        const std::size_t before = grains.bodies.sizeWithGhosts();
        takeBodies(fromEach[q], grains.bodies, true);
        for (std::size_t k = before; k < grains.bodies.sizeWithGhosts(); ++k)
            gotBodies[q].push_back(grains.bodies.numberOf(k));
        while (!fromEach[q].isTaken()) {
            got[q].push_back(fromEach[q].take<std::uint32_t>());
            takeRow(fromEach[q], grains, grains.addGhostPlace(got[q].back()));
        }
    }
    grains.bodies.sort();
}

/// A rank asks by boxes around its grains; what is near to a box need not be near to one of them.
void GrainSharing::keepGhosts(ParticleStore& grains, const std::vector<bool>& isListed) {
    std::vector<Message> toEach(exchange.count());
    for (std::size_t q = 0; q < exchange.count(); ++q)
        for (const std::uint32_t identity : std::exchange(got[q], {})) {
            const std::uint32_t place = grains.ghostPlace[identity];
            const bool stays = isListed[place] || grains.bodies.contains(identity);
            toEach[q].add(stays);
            if (stays) {
                got[q].push_back(identity);
                continue;
            }
            TranslationRecord& ghost = grains.translation[place];
            ghost.radius = ghost.inverseMass = 0;  // a gap
            ghost.velocity = {0, 0, 0};
        }
    std::vector<Message> fromEach = exchange.swap(std::move(toEach));
    for (std::size_t q = 0; q < exchange.count(); ++q) {
        done.ghosts += got[q].size();
        for (const std::uint32_t identity : std::exchange(sent[q], {}))
            if (fromEach[q].take<bool>()) sent[q].push_back(identity);
    }
    times.endList(exchange);
}

void GrainSharing::findPlaces(const ParticleStore& grains) {
    const auto ofEach = [](const OfEachRank& numbers, auto&& placeOf) {
        OfEachRank places(numbers.size());
        for (std::size_t q = 0; q < numbers.size(); ++q)
            for (const std::uint32_t number : numbers[q])
                if (const std::uint32_t place = placeOf(number); place != PlaceIndex::none)
                    places[q].push_back(place);
        return places;
    };
    const auto ofGrain = [&](std::uint32_t identity) {
        const std::uint32_t place = grains.placeOf(identity);
        return place == PlaceIndex::none || grains.isGap(place) ? PlaceIndex::none : place;
    };
    const auto ofBody = [&](std::uint32_t number) { return grains.bodies.find(number); };
    sentPlaces = ofEach(sent, ofGrain);
    gotPlaces = ofEach(got, ofGrain);
    sentBodiesPlaces = ofEach(sentBodies, ofBody);
    gotBodiesPlaces = ofEach(gotBodies, ofBody);
}

template <class GrainAt, class BodyAt, class TakeGrain, class TakeBody>
void GrainSharing::exchangeWithGhosts(GrainAt&& grainAt, BodyAt&& bodyAt, TakeGrain&& takeGrain,
                                      TakeBody&& takeBody) {
    if (!isDistributed) return;
    using OfGrain = std::invoke_result_t<GrainAt, std::uint32_t>;
    using OfBody = std::invoke_result_t<BodyAt, std::uint32_t>;
    std::vector<Message> toEach(exchange.count());
    std::vector<std::size_t> bytesFromEach;
    for (std::size_t q = 0; q < exchange.count(); ++q) {
        toEach[q].addEach<OfGrain>(sentPlaces[q].size(),
                                   [&](std::size_t k) { return grainAt(sentPlaces[q][k]); });
        toEach[q].addEach<OfBody>(sentBodiesPlaces[q].size(),
                                  [&](std::size_t k) { return bodyAt(sentBodiesPlaces[q][k]); });
        bytesFromEach.push_back(sizeof(OfGrain) * gotPlaces[q].size() +
                                sizeof(OfBody) * gotBodiesPlaces[q].size());
    }
    std::vector<Message> fromEach = exchange.swapWithNeighbours(std::move(toEach), bytesFromEach);
    for (std::size_t q = 0; q < exchange.count(); ++q) {
        for (const std::uint32_t place : gotPlaces[q]) takeGrain(place, fromEach[q].take<OfGrain>());
        for (const std::uint32_t at : gotBodiesPlaces[q]) takeBody(at, fromEach[q].take<OfBody>());
    }
}

void GrainSharing::tellGhosts(std::span<double> ofGrains, std::span<double> ofBodies) {
    const auto numberOf = [](std::span<double> numbers) {
        return [numbers](std::uint32_t at) { return numbers[at]; };
    };
    const auto takeOf = [](std::span<double> numbers) {
        return [numbers](std::uint32_t at, double number) { numbers[at] = number; };
    };
    exchangeWithGhosts(numberOf(ofGrains), numberOf(ofBodies), takeOf(ofGrains), takeOf(ofBodies));
}

template <bool spins, bool accelerates>
void GrainSharing::exchangeMotionOf(ParticleStore& grains) {
    using Vectors = std::array<Vector<double>, (spins ? 3 : 2) + (accelerates ? (spins ? 2 : 1) : 0)>;
    const auto forEachPart = [&](std::uint32_t place, auto&& use) {
        use(grains.translation[place].position), use(grains.translation[place].velocity);
        if constexpr (spins) use(grains.rotation[place].spin);
        if constexpr (accelerates) use(grains.acceleration[place]);
        if constexpr (accelerates && spins) use(grains.rotation[place].angularAcceleration);
    };
    exchangeWithGhosts(
        [&](std::uint32_t place) {
            Vectors parts;
            std::size_t k = 0;
            forEachPart(place, [&](const Vector<double>& part) { parts[k++] = part; });
            return parts;
        },
        [&](std::uint32_t at) { return grains.bodies[at]; },
        [&](std::uint32_t place, const Vectors& parts) {
            std::size_t k = 0;
            forEachPart(place, [&](Vector<double>& part) { part = parts[k++]; });
        },
        [&](std::uint32_t at, const RigidBody& body) { grains.bodies[at] = body; });
}

void GrainSharing::exchangeMotion(ParticleStore& grains, bool withAccelerations) {
    if (grains.hasSpin)
        withAccelerations ? exchangeMotionOf<true, true>(grains) : exchangeMotionOf<true, false>(grains);
    else withAccelerations ? exchangeMotionOf<false, true>(grains) : exchangeMotionOf<false, false>(grains);
}

/// Three numbers, whose maxima over all ranks give that of the first value, and whether the second is the
/// same on all ranks. A double has 52 bits of it: by chance two are taken for the same once in 4e15.
static Exchange::Three threeOf(double largest, std::uint64_t alike) {
    const auto number = static_cast<double>(alike >> 12);
    return {std::isnan(largest) ? infinity : largest, number, -number};
}
static GrainSharing::OfAll toldBy(const Exchange::Three& most) { return {most[0], most[1] == -most[2]}; }

GrainSharing::OfAll GrainSharing::exchangeStep(ParticleStore& grains, bool withAccelerations, double ownShift,
                                               std::uint64_t alike) {
    if (!isDistributed) return {ownShift, true};
    times.addStep();
    exchange.beginLargest(Reduction::Step, threeOf(ownShift, alike));
    exchangeMotion(grains, withAccelerations);
    return toldBy(exchange.endLargest());
}

GrainSharing::OfAll GrainSharing::agree(Reduction what, std::uint64_t alike, double own) {
    exchange.beginLargest(what, threeOf(own, alike));
    return toldBy(exchange.endLargest());
}

}  // namespace pendular
