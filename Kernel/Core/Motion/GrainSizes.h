#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Ranks/AllRanks.h"
#include "Kernel/Features/RigidBodies/BodySizes.h"

namespace pendular {

/// The two smallest and the two largest grains of one species, m; equal where there are two of a size.
struct SizeRange {
    std::size_t count = 0;
    double smallest = infinity, secondSmallest = infinity;
    double largest = 0, secondLargest = 0;

    void add(double radius) {
        ++count;
        secondSmallest = std::min(secondSmallest, std::max(smallest, radius));
        smallest = std::min(smallest, radius);
        secondLargest = std::max(secondLargest, std::min(largest, radius));
        largest = std::max(largest, radius);
    }
    /// Those of others as well.
    void add(const SizeRange& others) {
        count += others.count;
        secondSmallest =
            std::min(std::max(smallest, others.smallest), std::min(secondSmallest, others.secondSmallest));
        smallest = std::min(smallest, others.smallest);
        secondLargest =
            std::max(std::min(largest, others.largest), std::max(secondLargest, others.secondLargest));
        largest = std::max(largest, others.largest);
    }
    [[nodiscard]] bool empty() const { return count == 0; }
    /// Whether a grain of this radius is between others.
    [[nodiscard]] bool holds(double radius) const {
        return radius >= secondSmallest && radius <= secondLargest;
    }
    /// The radii of the extreme partners of a grain with this radius (m) out of these.
    [[nodiscard]] std::array<double, 2> partnersOf(double radius) const {
        return {radius == smallest ? secondSmallest : smallest, radius == largest ? secondLargest : largest};
    }
};

/// The sizes of the grains of each species: of all, of those that are free to move, and of those that are
/// held along all axes. A block's count as free spheres of a mass that is less than its contacts move; the
/// stability limit takes bodies as such (BodySizes.h).
struct GrainSizes {
    std::size_t count = 0;  // of grains
    std::vector<SizeRange> all, free, held;
    bool heldCarryWalls = true;    // whether contacts of held grains with walls that forces move are listed
    std::vector<SizeRange> alone;  // those of `free` that are in no body; empty without bodies
    std::vector<BodiesAlike> bodies;  // that are free
    bool hasBodies = false;
    /// Dashpots that follow from the mass are made for so many times it: held axes, see countHeldAlong().
    double heldDamping = 1;
    Vector<double> lowest{infinity, infinity, infinity};  // m, of the box around all grains
    Vector<double> highest{-infinity, -infinity, -infinity};

    GrainSizes() = default;
    /// @param ranks that share the grains; none: all are here
    GrainSizes(const ParticleStore& grains, std::size_t speciesCount, const AllRanks& ranks = {});
    /// The held grains on which a wall that forces move may rest.
    [[nodiscard]] std::span<const SizeRange> carriers() const {
        return heldCarryWalls ? std::span(held) : std::span<const SizeRange>();
    }
    /// Without the grains of free rigid bodies.
    [[nodiscard]] GrainSizes withoutBodies() const;
    /// m; infinite without grains
    [[nodiscard]] double smallest() const;
    /// The grains that a plane can touch, at most: a hexagonal layer of the smallest ones over the shadow of
    /// the box around all.
    [[nodiscard]] double fullLayer(const Vector<double>& normal) const;
    /// Whether a grain of this radius (m) is between others of its species that are free or held as it is.
    [[nodiscard]] bool hold(std::size_t species, double radius, bool isFree) const {
        return species < all.size() && all[species].holds(radius) &&
               (isFree ? free : held)[species].holds(radius);
    }

private:
    double smallestOfBodies = infinity;  // m, of grains that count as larger ones
    void addOfOthers(const AllRanks& ranks);
    void countHeldAlong(const ParticleStore& grains, const AllRanks& ranks);
};

}  // namespace pendular
