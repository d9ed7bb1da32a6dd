#pragma once

#include <cstdint>
#include <span>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Features/Insertion/Region.h"
#include "Kernel/Features/SizeDistributions/SizeDistribution.h"

namespace pendular {

class BodyHandler;
class GrainShapes;
class WallHandler;

/// How much is to be inserted.
class Amount {
public:
    enum class Kind { Grains, Mass, SolidFraction };

    static Amount grains(std::size_t number);
    /// kg: as many whole grains as do not exceed it
    static Amount mass(double mass);
    /// Volume of the grains that are inserted over that of the region; those that are there do not count.
    static Amount solidFraction(double fraction);

    [[nodiscard]] Kind kind() const { return what; }
    [[nodiscard]] double value() const { return much; }
    /// kg. @param mean of a grain or body; @param full of a region without voids
    [[nodiscard]] double massOf(double mean, double full) const;

private:
    Amount(Kind kind, double value) : what(kind), much(value) {}
    Kind what;
    double much;
};

/// How sizes are drawn: so that the sample has the distribution as exactly as its count allows
/// (exactRadii()), or each by itself.
enum class Sample { Exact, Random };

struct InsertOptions {
    Sample sample = Sample::Exact;
    bool wholeGrains = true;  ///< in the region; else only their centres
    std::uint64_t seed = 1;
    std::uint32_t tries = 10000;  ///< random places for each grain, up to looseFraction
    /// In shear and strain each velocity gets that of the flow at its place (shearFlowAt()) as well, also
    /// where grains are inserted before the first step. Else it is as given, at the place inside the periodic
    /// box: a grain without velocity is at rest there.
    bool withFlow = false;
};

/// The result of an insertion.
struct Inserted {
    std::size_t number = 0, wanted = 0;
    double mass = 0, wantedMass = 0;  // kg; wanted: the amount asked for
    double solidFraction = 0;         // of the region
    double firstLeftOut = 0;          // m, radius of the first grain that found no room; 0: all did
    double orientationOrder = 0;      // S of the clumps that were inserted (OrientationOrder.h)
};

/// Up to this solid fraction grains are placed one after the other, at random points that are free, the
/// largest first; above it by denseStart(). (Equal spheres placed so end at 0.384; at 0.2 a grain finds room
/// after some 20 points.)
inline constexpr double looseFraction = 0.2;

/// The scene into which grains come.
struct InsertionScene {
    ParticleHandler& particles;
    BodyHandler& bodies;
    const WallHandler& walls;
    const PeriodicBox& periodic;
    int threads = 1;
    GrainShapes* shapes = nullptr;  // null: it takes no superquadrics
};

/// Radii (m), the largest first; none where the first random grain is heavier than the amount. @param density
/// kg/m^3; @param volume m^3, of the region. Throws InputError where the amount is less than the mean grain,
/// or more than a scene can have.
std::vector<double> radiiOf(const Amount& amount, const SizeDistribution& sizes, double density,
                            double volume, const InsertOptions& options);

/// Throws InputError where a sphere of the smaller radius (m) is behind a wall, or in it, at each of a
/// thousand random points of a region, or one of the larger radius cannot be in it at all.
/// @param way m, by which the region has gone: straight, so that there must be no wall across it either
void refuseWithoutRoom(std::string_view owner, const Region& region, const WallHandler& walls,
                       const PeriodicBox& periodic, double smallest, double largest, bool wholeGrains,
                       const Vector<double>& way = {0, 0, 0});

/// Finds room for spheres that overlap nothing: no grain, no wall, none of their images. Up to looseFraction
/// one after the other, the largest first: one that finds no room is left out, and all smaller ones are
/// tried; above it by denseStart(). Throws InputError if the solid fraction cannot be reached: with that
/// which can.
/// @param radii m, the largest first; @param fraction of the region that they fill
/// @return m, their centres inside the periodic box; not a number where there was no room
std::vector<Vector<double>> placesOfSpheres(const InsertionScene& scene, std::span<const double> radii,
                                            const Region& region, const Amount& amount, double fraction,
                                            const InsertOptions& options, double& firstLeftOut);

}  // namespace pendular
