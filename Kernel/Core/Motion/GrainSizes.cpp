#include "Kernel/Core/Motion/GrainSizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pendular {

namespace {

/// m, of the free sphere as which a grain counts: in a block, one of the mass that the block's contacts move,
/// which is minus its largestFreeMass.
double radiusInLimit(const ParticleStore& grains, std::size_t place) {
    const double radius = grains.translation[place].radius;
    const std::uint32_t number = grains.bodies.bodyOf(grains.identity[place]);
    if (number == RigidBodies::none) return radius;
    const std::size_t own = grains.bodies.find(number);
    const RigidBody& body = grains.bodies[own];
    if (body.largestFreeMass >= 0) return radius;
    return std::cbrt(-body.largestFreeMass / body.mass * grains.bodies.volumeOf(own) * 3 /
                     (4 * std::numbers::pi));
}

/// Whether a grain is in no body, or is one by itself.
bool isAlone(const ParticleStore& grains, std::size_t place) {
    const std::uint32_t number = grains.bodies.bodyOf(grains.identity[place]);
    return number == RigidBodies::none || grains.bodies.isSphere(grains, grains.bodies.find(number));
}

}  // namespace

GrainSizes::GrainSizes(const ParticleStore& grains, std::size_t speciesCount, const AllRanks& ranks)
    : count(grains.count()),
      all(speciesCount),
      free(speciesCount),
      held(speciesCount),
      bodies(bodiesOf(grains, ranks)),
      hasBodies(!grains.bodies.empty()) {
    if (hasBodies) alone.resize(speciesCount);
    for (std::size_t k = 0; k < grains.ownSize(); ++k) {
        if (grains.isGap(k)) continue;
        const TranslationRecord& grain = grains.translation[k];
        const double counted = radiusInLimit(grains, k);
        all[grains.species[k]].add(counted);
        if (counted < grain.radius) all[grains.species[k]].add(grain.radius);
        smallestOfBodies = std::min(smallestOfBodies, counted > grain.radius ? grain.radius : infinity);
        const Vector<double>& at = grain.position;
        const double r = grain.radius;
        lowest = {std::min(lowest.x, at.x - r), std::min(lowest.y, at.y - r), std::min(lowest.z, at.z - r)};
        highest = {std::max(highest.x, at.x + r), std::max(highest.y, at.y + r),
                   std::max(highest.z, at.z + r)};
        if (grain.inverseMass > 0) {
            free[grains.species[k]].add(counted);
            if (hasBodies && isAlone(grains, k)) alone[grains.species[k]].add(counted);
            continue;
        }
        held[grains.species[k]].add(counted);
        if (counted < grain.radius) held[grains.species[k]].add(grain.radius);
    }
    if (ranks.areSeveral()) addOfOthers(ranks);
    countHeldAlong(grains, ranks);
}

void GrainSizes::addOfOthers(const AllRanks& ranks) {
    count = ranks.sum(count);
    // Where this rank has no body, all of its free grains are alone.
    const bool isBodiless = !hasBodies;
    hasBodies = ranks.any(hasBodies);
    if (hasBodies && isBodiless) alone = free;
    for (std::vector<SizeRange>* const ranges : {&all, &free, &held, &alone}) {
        if (ranges == &alone && !hasBodies) continue;
        const std::vector<SizeRange> ofAll = ranks.gather(*ranges);
        const std::size_t species = ranges->size();
        ranges->assign(species, {});
        for (std::size_t k = 0; k < ofAll.size(); ++k) (*ranges)[k % species].add(ofAll[k]);
    }
    smallestOfBodies = ranks.smallest(smallestOfBodies);
    for (double* const low : {&lowest.x, &lowest.y, &lowest.z}) *low = ranks.smallest(*low);
    for (double* const high : {&highest.x, &highest.y, &highest.z}) *high = ranks.largest(*high);
}

/// A contact with one that is held along its normal has dashpots for the mass of the other one alone, or for
/// twice the mass (HeldMasses.h), which act across the normal, too.
void GrainSizes::countHeldAlong(const ParticleStore& grains, const AllRanks& ranks) {
    double least = infinity, largest = 0;  // m
    for (std::size_t k = 0; k < grains.held.size(); ++k)
        if (grains.held[k].areAlong()) least = std::min(least, grains.translation[k].radius);
    least = ranks.smallest(least);
    if (!(least < infinity)) return;
    for (const SizeRange& range : free) largest = std::max(largest, range.largest);
    const double ratio = largest / least;
    heldDamping = 1 + ratio * ratio * ratio;
}

GrainSizes GrainSizes::withoutBodies() const {
    if (!hasBodies) return *this;
    GrainSizes others = *this;
    others.free = others.all = alone;
    for (std::size_t s = 0; s < held.size(); ++s) others.all[s].add(held[s]);
    others.bodies.clear();
    return others;
}

double GrainSizes::smallest() const {
    double radius = smallestOfBodies;
    for (const SizeRange& range : all) radius = std::min(radius, range.smallest);
    return radius;
}

double GrainSizes::fullLayer(const Vector<double>& normal) const {
    if (!(smallest() < infinity)) return 0;
    const Vector<double> side = highest - lowest;
    if (!(side.x > 0)) return 0;  // none yet
    const double shadow = side.y * side.z * std::abs(normal.x) + side.x * side.z * std::abs(normal.y) +
                          side.x * side.y * std::abs(normal.z);
    const double inLayer = shadow / (2 * std::numbers::sqrt3 * smallest() * smallest());
    return std::clamp(inLayer, 1.0, static_cast<double>(count));
}

}  // namespace pendular
