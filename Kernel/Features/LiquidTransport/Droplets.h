#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "Kernel/Core/Contacts/NeighbourSearch.h"

namespace pendular {

class Wall;
class WallHandler;

/// A droplet in flight.
struct Droplet {
    Vector<double> position, velocity;  // m, m/s
    double radius;                      // m
    double volume;                      // m^3, a multiple of the quantum
    double flown;                       // s
    double spray;                       // its number
};

/// A sphere that moves straight from one point to another, in a step.
struct Sweep {
    Vector<double> from, to;  // m
    double radius;            // m
    double time;              // s, that it takes
};

/// The first thing that a sweep meets.
struct SweepHit {
    double share = 2;            // of the way; above 1: nothing
    std::uint32_t grain = none;  // its place
    int wall = -1;

    static constexpr std::uint32_t none = ~std::uint32_t{0};
    [[nodiscard]] bool isHit() const { return share <= 1; }
};

/// The way of a sphere through a step as a grain sees it that moves straight, too.
struct Approach {
    Vector<double> start, way;  // m, of the sphere's centre against the grain's
    /// m/s, by which the sphere is faster than its image that the grain meets.
    Vector<double> imageVelocity{0, 0, 0};
};
[[nodiscard]] Approach approachTo(const TranslationRecord& grain, const Sweep& sweep, const PeriodicBox& box);

/// Finds the first grain or wall that a sphere meets on its way through a step. Grains move straight, too,
/// with the velocity that they have at its end; walls are where they are then. If several are met at the same
/// point of the way, the grain with the lowest identity is the first, then the wall with the lowest number.
class SweptSearch {
public:
    /// Grains have moved by so much at most (m) in a step; their order is new where contacts were listed
    /// again.
    void update(const ParticleStore& grains, const PeriodicBox& box, std::size_t lists, double shift,
                double smallestRadius);
    /// The first hit of a sweep, from any thread. Parts of walls are marched to by the distance that is free,
    /// up to 1e-4 of the sphere's radius.
    [[nodiscard]] SweepHit firstHit(const Sweep& sweep, const ParticleStore& grains, const PeriodicBox& box,
                                    const WallHandler& walls) const;

private:
    void meetGrains(const Sweep& sweep, const ParticleStore& grains, const PeriodicBox& box,
                    SweepHit& hit) const;
    static void meetWall(const Sweep& sweep, const Wall& wall, int number, SweepHit& hit);

    std::optional<NeighbourSearch> cells;
    double moved = 0;      // m, since the cells were filled
    double stepShift = 0;  // m, in the last step
    std::size_t listsThen = 0;
    std::uint32_t nextThen = 0;
};

}  // namespace pendular
