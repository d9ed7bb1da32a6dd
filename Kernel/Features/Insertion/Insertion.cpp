#include "Kernel/Features/Insertion/Insertion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Features/Insertion/DenseRefusals.h"
#include "Kernel/Features/Insertion/DenseStart.h"
#include "Kernel/Features/Insertion/SphereGrid.h"
#include "Kernel/Features/Insertion/WallGap.h"
#include "Kernel/Features/SizeDistributions/SizeSample.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/ApartTexts.h"

namespace pendular {

namespace {

constexpr std::string_view ownerOfGrains = "insert()";
constexpr std::uint32_t purposeOfPlaces = 0x1257010, purposeOfProbes = 0x1257020;
constexpr double mostGrains = ParticleStore::largestIdentity;

InputError tooManyError(double number) {
    const auto [wanted, most] = apartTexts(number, mostGrains, 3);
    return InputError(
        fmt::format("{}: the amount is some {} grains; it must be at most {}.", ownerOfGrains, wanted, most));
}

std::size_t exactCount(const Amount& amount, double mean, double whole) {
    const double number =
        amount.kind() == Amount::Kind::Grains ? amount.value() : std::floor(whole / mean * (1 + 1e-12));
    if (number > mostGrains) throw tooManyError(number);
    if (number < 1)
        throw InputError(fmt::format("{}: the amount is {} of the mean grain; it must be one grain at least.",
                                     ownerOfGrains, apartTexts(whole / mean, 1, 3)[0]));
    return static_cast<std::size_t>(number);
}

}  // namespace

Amount Amount::grains(std::size_t number) {
    checkValue(ownerOfGrains, "number of grains", static_cast<double>(number), "", {1, mostGrains});
    return {Kind::Grains, static_cast<double>(number)};
}
Amount Amount::mass(double mass) {
    checkValue(ownerOfGrains, "mass", mass, "kg", positive);
    return {Kind::Mass, mass};
}
Amount Amount::solidFraction(double fraction) {
    checkValue(ownerOfGrains, "solid fraction", fraction, "", {0, 1, false, false});
    return {Kind::SolidFraction, fraction};
}
double Amount::massOf(double mean, double full) const {
    switch (what) {
        case Kind::Mass:
            return much;
        case Kind::SolidFraction:
            return much * full;
        default:
            return much * mean;
    }
}

std::vector<double> radiiOf(const Amount& amount, const SizeDistribution& sizes, double density,
                            double volume, const InsertOptions& options) {
    const double mean = density * std::numbers::pi / 6 * sizes.moment(3);  // kg
    const double whole = amount.massOf(mean, density * volume);
    const std::size_t count = exactCount(amount, mean, whole);
    if (options.sample == Sample::Exact) return exactRadii(sizes, count);
    if (amount.kind() == Amount::Kind::Grains) {
        std::vector<double> radii = randomRadii(sizes, count, options.seed);
        std::sort(radii.rbegin(), radii.rend());
        return radii;
    }
    std::vector<double> radii;
    const CountedRandom random(options.seed);
    for (double sum = 0;;) {
        askForInterruption();
        const double radius = sizes.drawRadius(random, radii.size());
        if ((sum += sphereMass(radius, density)) > whole) break;
        radii.push_back(radius);
        if (static_cast<double>(radii.size()) > mostGrains) throw tooManyError(whole / mean);
    }
    std::sort(radii.rbegin(), radii.rend());
    return radii;
}

void refuseWithoutRoom(std::string_view who, const Region& region, const WallHandler& walls,
                       const PeriodicBox& periodic, double smallest, double largest, bool wholeGrains,
                       const Vector<double>& way) {
    const Box box = region.bounds();
    for (const Vector<double>& corner : {box.lowest, box.highest, box.lowest + way, box.highest + way})
        requireResolved(who, "a corner of the region", corner, smallest);
    if (wholeGrains && !(largest <= region.largestSphere() * (1 + 1e-12))) {
        const auto [own, most] = apartTexts(largest, region.largestSphere(), 6);
        throw InputError(
            fmt::format("{}: the largest grain has a radius of {} m and does not fit the region; it must be "
                        "at most {} m.",
                        who, own, most));
    }
    constexpr std::uint32_t probes = 1000;
    const CountedRandom random(1);
    const double margin = wholeGrains ? smallest : 0;
    std::size_t met = 0, inRegion = 0;
    for (std::uint32_t k = 0; k < probes; ++k) {
        const Vector<double> point = candidateOf(region, random, k, purposeOfProbes, 0, margin);
        if (!region.contains(point, 0)) continue;
        ++inRegion;
        bool isFree = true;
        const auto meet = [&](std::size_t wall) {
            isFree = false;
            met = wall;
        };
        forEachWallNear(walls, periodic, point + way, smallest,
                        [&](const WallPoint&, std::size_t wall) { meet(wall); });
        if (way != Vector<double>{0, 0, 0})
            for (const PresentWall& wall : walls.present())
                if (wall.object->isCrossed(point, point + way)) meet(wall.number);
        if (isFree) return;
    }
    if (inRegion == 0) return;  // a thin mesh: insertion itself will tell
    throw InputError(
        fmt::format("{}: the region lies behind wall {}, or in it: a grain of radius {:.6g} m has room at "
                    "none of {} random "
                    "points of the region.",
                    who, met, smallest, inRegion));
}

namespace {

/// Places grains one after the other; not a number where there is no room.
std::vector<Vector<double>> placeOneByOne(const InsertionScene& scene, std::span<const double> radii,
                                          const Region& region, const InsertOptions& options,
                                          double& firstLeftOut) {
    SphereGrid grid(scene.particles.store(), scene.periodic, region.bounds(), radii.front());
    const CountedRandom random(options.seed);
    const std::uint64_t first = scene.particles.store().nextIdentity();
    std::vector<Vector<double>> centres(radii.size(), {unset, unset, unset});
    // Where a large grain has found no room after all its tries, an equal one will not look as long.
    double noRoomFor = infinity;
    for (std::size_t k = 0; k < radii.size(); ++k) {
        const double radius = radii[k], margin = options.wholeGrains ? radius : 0;
        const std::uint32_t tries = radius >= noRoomFor ? std::max(options.tries / 100, 1u) : options.tries;
        for (std::uint32_t attempt = 0; attempt < tries; ++attempt) {
            askForInterruption();
            const Vector<double> centre =
                candidateOf(region, random, first + k, purposeOfPlaces, attempt, margin);
            if (!region.contains(centre, margin) ||
                touchesWall(scene.walls, scene.periodic, centre, radius) || !grid.isFree(centre, radius))
                continue;
            grid.add(centre, radius);
            centres[k] = scene.periodic.wrap(centre);
            break;
        }
        if (!isSet(centres[k].x)) {
            if (firstLeftOut == 0) firstLeftOut = radius;
            noRoomFor = std::min(noRoomFor, radius);
        }
    }
    return centres;
}

std::vector<Vector<double>> placeDensely(const InsertionScene& scene, std::span<const double> radii,
                                         const Region& region, const InsertOptions& options,
                                         double fraction) {
    DenseStart found = denseStart(radii, options.wholeGrains, region, scene.particles.store(), scene.walls,
                                  scene.periodic, options.seed, scene.threads);
    if (found.shrink < 1) refuseLessDense(fraction, found.shrink, found.iterations);
    PeriodicBox fromRegion = scene.periodic;  // a region may go across a face
    fromRegion.lowest = region.bounds().lowest;
    for (std::size_t k = 0; k < radii.size(); ++k)
        if (!region.contains(fromRegion.wrap(found.centres[k]),
                             options.wholeGrains ? radii[k] * (1 - 1e-9) : 0))
            throw InputError(fmt::format(
                "{}: a grain of radius {:.6g} m was pushed out of the region; take a smaller amount.",
                ownerOfGrains, radii[k]));
    return std::move(found.centres);
}

}  // namespace

std::vector<Vector<double>> placesOfSpheres(const InsertionScene& scene, std::span<const double> radii,
                                            const Region& region, const Amount& amount, double fraction,
                                            const InsertOptions& options, double& firstLeftOut) {
    if (fraction <= looseFraction) return placeOneByOne(scene, radii, region, options, firstLeftOut);
    refuseTooDense("grains", amount, fraction);
    return placeDensely(scene, radii, region, options, fraction);
}

}  // namespace pendular
