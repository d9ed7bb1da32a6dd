#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Features/Insertion/Region.h"

namespace pendular {

class WallHandler;

/// The places of the grains of a dense start, and how they were found.
struct DenseStart {
    std::vector<Vector<double>> centres;  // m, of the radii that were given
    int iterations = 0;
    /// The factor by which all radii had to be multiplied for no two grains to overlap, and none to go
    /// through a border: 1 where nothing overlaps.
    double shrink = 1;
};

/// Spheres of equal size do not get denser than 0.64 at random. Near to it a relaxation has no end; up to
/// this fraction it takes some hundred iterations.
inline constexpr double densestRandomStart = 0.6;

/// Finds room for spheres at random in a region, among its walls and grains, up to a solid fraction of some
/// densestRandomStart (walls near to each other allow less). Points that cover the region evenly, each
/// displaced at random, are the centres of spheres that are larger than wanted; those push each other apart,
/// without friction and inertia, until spheres of the wanted sizes do not overlap at all.
///
/// Source of the idea: Jodrey and Tory (1985), Phys. Rev. A 32, 2347,
/// https://doi.org/10.1103/PhysRevA.32.2347; here with all pairs at once instead of the worst one. The result
/// does not depend on the threads.
/// @param radii m, the largest first; @param margin whether spheres, not only centres, are in the region
DenseStart denseStart(std::span<const double> radii, bool margin, const Region& region,
                      const ParticleStore& present, const WallHandler& walls, const PeriodicBox& periodic,
                      std::uint64_t seed, int threads);

}  // namespace pendular
