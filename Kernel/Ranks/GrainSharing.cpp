#include "Kernel/Ranks/GrainSharing.h"

#include <algorithm>
#include <numeric>

#include "Kernel/Ranks/GrainExtents.h"

namespace pendular {

namespace {

void addRow(Message& message, ParticleStore& grains, std::size_t at) {
    message.add(grains.identity[at]);
    grains.visitRow(at, [&](const auto& value) { message.add(value); });
}

void takeRow(Message& message, ParticleStore& grains, std::size_t at) {
    grains.visitRow(at, [&](auto& value) { message.take(value); });
}

}  // namespace

void GrainSharing::distribute(ParticleStore& grains, const PeriodicBox& box, double reach,
                              const Luggage& luggage) {
    if (!isDistributed || options.cutsWander || areImbalanced(grains, luggage)) cutAnew(grains, box, luggage);
    migrate(grains, box, luggage);
    isDistributed = true;
    findGhosts(grains, box, reach);
    ++done.lists;
    done.ghosts += grains.size() - grains.ownSize();
}

bool GrainSharing::areImbalanced(const ParticleStore& grains, const Luggage& luggage) {
    constexpr double worthIt = 1000;  // grains and contacts of a rank
    done.load = 0;
    for (std::uint32_t k = 0; k < grains.ownSize(); ++k)
        if (!grains.isGap(k)) done.load += luggage.weightOf(k);
    const std::vector<double> loads = exchange.ofAll(done.load);
    const double mean = std::accumulate(loads.begin(), loads.end(), 0.0) / static_cast<double>(loads.size());
    return mean > worthIt && std::ranges::max(loads) > 1.1 * mean;
}

/// Where all ranks have all grains, each gives its share of the points.
void GrainSharing::cutAnew(const ParticleStore& grains, const PeriodicBox& box, const Luggage& luggage) {
    const std::size_t first = isDistributed ? 0 : exchange.rank(),
                      step = isDistributed ? 1 : exchange.count();
    std::vector<Bisection::Point> points;
    for (std::size_t k = first; k < grains.ownSize(); k += step)
        if (!grains.isGap(k))
            points.push_back(
                {box.wrap(grains.translation[k].position), luggage.weightOf(static_cast<std::uint32_t>(k))});
    std::vector<double> shares(exchange.count(), 1);
    if (options.cutsWander)
        for (std::size_t q = 0; q < shares.size(); ++q)
            shares[q] += 0.5 * static_cast<double>((7 * done.lists + 3 * q) % 5);
    cuts.cut(exchange, points, shares);
}

void GrainSharing::migrate(ParticleStore& grains, const PeriodicBox& box, const Luggage& luggage) {
    const std::size_t self = exchange.rank(), before = grains.ownSize();
    std::vector<std::size_t> owners(before);
    std::vector<std::uint32_t> staying, leaving;
    for (std::uint32_t k = 0; k < before; ++k) {
        if (grains.isGap(k)) continue;
        owners[k] = cuts.ownerOf(box.wrap(grains.translation[k].position));
        (owners[k] == self ? staying : leaving).push_back(k);
    }
    if (!isDistributed) return grains.keepOnly(staying);
    std::vector<Message> toEach(exchange.count());
    std::vector<std::uint32_t> numbers(exchange.count());
    for (const std::uint32_t k : leaving) ++numbers[owners[k]];
    for (std::size_t q = 0; q < exchange.count(); ++q) toEach[q].add(numbers[q]);
    for (const std::uint32_t k : leaving) addRow(toEach[owners[k]], grains, k);
    luggage.pack(owners, toEach);
    done.migrated += leaving.size();
    grains.keepOnly(staying);
    for (Message& message : exchange.swap(std::move(toEach))) takeGrains(message, grains, luggage);
}

void GrainSharing::takeGrains(Message& message, ParticleStore& grains, const Luggage& luggage) {
    for (auto left = message.take<std::uint32_t>(); left > 0; --left)
        takeRow(message, grains, grains.addPlace(message.take<std::uint32_t>()));
    luggage.unpack(message);
}

void GrainSharing::gather(ParticleStore& grains, const Luggage& luggage) {
    std::vector<std::uint32_t> own;
    for (std::uint32_t k = 0; k < grains.ownSize(); ++k)
        if (!grains.isGap(k)) own.push_back(k);
    Message message;
    message.add(static_cast<std::uint32_t>(own.size()));
    for (const std::uint32_t k : own) addRow(message, grains, k);
    luggage.packAll(message);
    std::vector<Message> toEach(exchange.count(), message);
    toEach[exchange.rank()] = {};  // it has them
    grains.keepOnly(own);
    isDistributed = false;
    std::vector<Message> fromEach = exchange.swap(std::move(toEach));
    for (std::size_t q = 0; q < exchange.count(); ++q)
        if (q != exchange.rank()) takeGrains(fromEach[q], grains, luggage);
}

void GrainSharing::findGhosts(ParticleStore& grains, const PeriodicBox& box, double reach) {
    double largestHere = 0;
    for (const TranslationRecord& grain : grains.translation)
        largestHere = std::max(largestHere, grain.radius);
    const double largestOfAll = largest(largestHere);
    GrainExtents own;
    for (const TranslationRecord& grain : grains.translation)
        own.add(box.wrap(grain.position), grain.radius, largestOfAll);
    const std::vector<GrainExtents> extents = exchange.ofAll(own);
    const std::vector<Vector<double>> images = imageOffsets(box);
    std::vector<Message> toEach(exchange.count());
    sent.assign(exchange.count(), {});
    got.assign(exchange.count(), {});
    for (std::size_t q = 0; q < exchange.count(); ++q) {
        if (q == exchange.rank() || extents[q].areEmpty()) continue;
        for (std::size_t k = 0; k < grains.size(); ++k) {
            const TranslationRecord& grain = grains.translation[k];
            const Vector<double> inside = box.wrap(grain.position);
            if (std::ranges::none_of(images, [&](const Vector<double>& offset) {
                    return extents[q].areNear(inside + offset, grain.radius, reach);
                }))
                continue;
            addRow(toEach[q], grains, k);
            sent[q].push_back(grains.identity[k]);
        }
    }
    std::vector<Message> fromEach = exchange.swap(std::move(toEach));
    for (std::size_t q = 0; q < exchange.count(); ++q)
        while (!fromEach[q].isTaken()) {
            got[q].push_back(fromEach[q].take<std::uint32_t>());
            takeRow(fromEach[q], grains, grains.addGhostPlace(got[q].back()));
        }
}

void GrainSharing::findPlaces(const ParticleStore& grains) {
    const auto placesOf = [&](const std::vector<std::vector<std::uint32_t>>& identities) {
        std::vector<std::vector<std::uint32_t>> places(identities.size());
        for (std::size_t q = 0; q < identities.size(); ++q)
            for (const std::uint32_t identity : identities[q]) places[q].push_back(grains.placeOf(identity));
        return places;
    };
    sentPlaces = placesOf(sent);
    gotPlaces = placesOf(got);
}

/// What exchangeMotion() sends of one.
static std::size_t bytesOfGhost(const ParticleStore& grains, bool withAccelerations) {
    const std::size_t vectors = grains.hasSpin ? 3 : 2, accelerations = grains.hasSpin ? 2 : 1;
    return (vectors + (withAccelerations ? accelerations : 0)) * sizeof(Vector<double>);
}

void GrainSharing::exchangeMotion(ParticleStore& grains, bool withAccelerations) {
    if (!isDistributed) return;
    const auto forEachPart = [&](std::uint32_t place, auto&& use) {
        use(grains.translation[place].position), use(grains.translation[place].velocity);
        if (grains.hasSpin) use(grains.rotation[place].spin);
        if (!withAccelerations) return;
        use(grains.acceleration[place]);
        if (grains.hasSpin) use(grains.rotation[place].angularAcceleration);
    };
    std::vector<Message> toEach(exchange.count());
    for (std::size_t q = 0; q < exchange.count(); ++q)
        for (const std::uint32_t place : sentPlaces[q])
            forEachPart(place, [&](const Vector<double>& part) { toEach[q].add(part); });
    std::vector<std::size_t> bytesFromEach;
    for (const std::vector<std::uint32_t>& places : gotPlaces)
        bytesFromEach.push_back(places.size() * bytesOfGhost(grains, withAccelerations));
    std::vector<Message> fromEach = exchange.swapWithNeighbours(std::move(toEach), bytesFromEach);
    for (std::size_t q = 0; q < exchange.count(); ++q)
        for (const std::uint32_t place : gotPlaces[q])
            forEachPart(place, [&](Vector<double>& part) { fromEach[q].take(part); });
}

}  // namespace pendular
