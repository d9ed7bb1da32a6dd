#include "Kernel/Features/Insertion/ClumpInsertion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "Kernel/Features/Insertion/DenseBodies.h"
#include "Kernel/Features/Insertion/DenseRefusals.h"
#include "Kernel/Features/Insertion/DenseStart.h"
#include "Kernel/Features/Insertion/SphereGrid.h"
#include "Kernel/Features/Insertion/WallGap.h"
#include "Kernel/Features/RigidBodies/BodyHandler.h"
#include "Kernel/Features/RigidBodies/OrientationOrder.h"
#include "Kernel/Features/SizeDistributions/SizeSample.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/ApartTexts.h"

namespace pendular {

namespace {

constexpr std::string_view ownerOfClumps = "insert()";
constexpr std::uint32_t purposeOfClumpPlaces = 0x1257110, purposeOfClumpTurns = 0x1257120;

/// The spheres of clumps, and whether there is room for another clump beside them.
class Room {
public:
    Room(const InsertionScene& of, const Region& in, bool wholeGrains, double largest)
        : scene(of),
          region(in),
          isWhole(wholeGrains),
          grid(of.particles.store(), of.periodic, in.bounds(), largest) {}

    [[nodiscard]] bool has(const std::vector<Ball>& spheres) const {
        for (const auto& [place, radius] : spheres) {
            const Vector<double> centre = toVector(place);
            if ((isWhole && !region.contains(centre, radius)) ||
                touchesWall(scene.walls, scene.periodic, centre, radius) || !grid.isFree(centre, radius))
                return false;
        }
        return true;
    }
    void take(const std::vector<Ball>& spheres) {
        for (const Ball& sphere : spheres) grid.add(toVector(sphere.centre), sphere.radius);
    }

private:
    const InsertionScene& scene;
    const Region& region;
    bool isWhole;
    SphereGrid grid;
};

/// kg/m^3
double densityOf(const InsertionScene& scene, const BodyKind& kind) {
    return kind.density(pendular::densityOf(scene.particles, kind.species()));
}
double massOf(const InsertionScene& scene, const PlacedBody& body) {
    return sphereMass(body.radius, densityOf(scene, *body.kind));
}

void refuseWithoutSpecies(const BodyMixture& mixture) {
    if (mixture.empty()) throw InputError("insert(): the mixture has no bodies; call add().");
    for (const BodyKind& kind : mixture)
        if (kind.species() < 0)
            throw InputError(
                fmt::format("{}: the {} has no species; call setSpecies() with one of this scene.",
                            ownerOfClumps, kind.word()));
}

/// How many bodies have the mass of the amount on average.
std::size_t countOf(const Amount& amount, double meanMass, double full) {
    if (amount.kind() == Amount::Kind::Grains) return static_cast<std::size_t>(amount.value());
    const double whole = amount.massOf(0, full),  // kg
        number = std::floor(whole / meanMass * (1 + 1e-12));
    constexpr double most = ParticleStore::largestIdentity;
    if (number < 1 || number > most)
        throw InputError(
            fmt::format("{}: the amount is {:.3g} mean bodies of the mixture; it must be 1 to {}.",
                        ownerOfClumps, whole / meanMass, most));
    return static_cast<std::size_t>(number);
}

/// Draws bodies of a mixture one by one, up to the amount.
std::vector<PlacedBody> drawBodies(const InsertionScene& scene, const BodyMixture& mixture,
                                   const Amount& amount, double full, const InsertOptions& options) {
    const std::size_t mean = countOf(amount, mixture.meanMass(scene.particles), full);
    const bool byNumber = amount.kind() == Amount::Kind::Grains;
    const double whole = amount.massOf(0, full);  // kg
    const CountedRandom random(options.seed);
    std::vector<PlacedBody> bodies;
    for (double sum = 0; !byNumber || bodies.size() < mean;) {
        askForInterruption();
        const BodyKind& kind = mixture[mixture.draw(random, bodies.size())];
        const PlacedBody next{&kind, kind.sizes.drawRadius(random, bodies.size())};
        if ((sum += massOf(scene, next)) > whole && !byNumber) break;
        bodies.push_back(next);
    }
    return bodies;
}

/// kg, of the bodies of a mixture that fill a volume (m^3) without voids.
double fullMassOf(const InsertionScene& scene, const BodyMixture& mixture, double volume) {
    if (mixture.size() == 1) return densityOf(scene, mixture[0]) * volume;
    double mean = 0;  // m^3
    for (std::size_t k = 0; k < mixture.size(); ++k)
        mean += mixture.shareOf(k) * std::numbers::pi / 6 * mixture[k].sizes.moment(3);
    return mixture.meanMass(scene.particles) / mean * volume;
}

/// Where even the smallest bodies would fill more than the region, none is drawn: it may be a number for
/// which there is no memory.
void refuseMoreThanTheRegion(const BodyMixture& mixture, const Amount& amount, double volume, double full) {
    double smallest = infinity, heaviest = 0;  // m^3, of bodies
    for (const BodyKind& kind : mixture) {
        smallest = std::min(smallest, sphereMass(0.5 * kind.sizes.smallest(), 1));
        heaviest = std::max(heaviest, sphereMass(0.5 * kind.sizes.largest(), 1));
    }
    const double least = amount.kind() == Amount::Kind::Grains
                             ? amount.value() * smallest / volume
                             : amount.massOf(0, full) / full - heaviest / volume;
    if (least > 1) refuseTooDense(mixture.hasBodies() ? "bodies" : "grains", amount, least);
}

/// The bodies of an amount, the largest first.
/// @param full kg, fullMassOf() the region: a fraction of volume is one of mass, at the mean density
std::vector<PlacedBody> bodiesOf(const InsertionScene& scene, const BodyMixture& mixture,
                                 const Amount& amount, double volume, double full,
                                 const InsertOptions& options) {
    std::vector<PlacedBody> bodies;
    if (mixture.size() == 1) {
        for (const double radius :
             radiiOf(amount, mixture[0].sizes, densityOf(scene, mixture[0]), volume, options))
            bodies.push_back({&mixture[0], radius});
        return bodies;
    }
    if (options.sample == Sample::Random) bodies = drawBodies(scene, mixture, amount, full, options);
    else {
        const std::vector<std::size_t> counts =
            mixture.counts(countOf(amount, mixture.meanMass(scene.particles), full));
        for (std::size_t k = 0; k < counts.size(); ++k)
            if (counts[k] > 0)
                for (const double radius : exactRadii(mixture[k].sizes, counts[k]))
                    bodies.push_back({&mixture[k], radius});
    }
    // Bodies of one kind and one size are alike. (stable_sort() does not align quaternions.)
    std::ranges::sort(bodies, [](const PlacedBody& a, const PlacedBody& b) {
        return a.radius != b.radius ? a.radius > b.radius : a.kind < b.kind;
    });
    return bodies;
}

/// Places bodies one after the other; returns those that found room.
std::vector<PlacedBody> placeOneByOne(const InsertionScene& scene, const std::vector<PlacedBody>& bodies,
                                      const Region& region, const InsertOptions& options,
                                      double& firstLeftOut) {
    double reach = 0;  // m
    for (const PlacedBody& body : bodies) reach = std::max(reach, body.kind->reach(body.radius));
    Room room(scene, region, options.wholeGrains, reach);
    const CountedRandom random(options.seed);
    const std::uint64_t first = scene.particles.store().nextIdentity();
    std::vector<PlacedBody> placed;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        PlacedBody body = bodies[k];
        std::vector<Ball> spheres;
        bool isPlaced = false;
        for (std::uint32_t attempt = 0; attempt < options.tries && !isPlaced; ++attempt) {
            askForInterruption();
            const auto even = [&](std::uint32_t number) {
                return random.uniform(first + k, purposeOfClumpTurns + number, attempt);
            };
            body.place = candidateOf(region, random, first + k, purposeOfClumpPlaces, attempt, 0);
            if (!region.contains(body.place, 0)) continue;
            body.turn = evenTurn(even(0), even(1), even(2));
            spheres = body.kind->spheres(body.radius, body.place, body.turn);
            isPlaced = room.has(spheres);
        }
        if (!isPlaced) {
            if (firstLeftOut == 0) firstLeftOut = body.radius;
            continue;
        }
        room.take(spheres);
        placed.push_back(body);
    }
    return placed;
}

void placeDensely(const InsertionScene& scene, std::vector<PlacedBody>& bodies, const Region& region,
                  const InsertOptions& options, double fraction) {
    const StandInSpheres standIns(bodies);
    double smallest = infinity, largest = 0;  // m, of spheres
    for (const PlacedBody& body : bodies)
        for (const Ball& sphere : standIns.of(body)) {
            smallest = std::min(smallest, sphere.radius);
            largest = std::max(largest, sphere.radius);
        }
    refuseWithoutRoom(ownerOfClumps, region, scene.walls, scene.periodic, smallest, largest,
                      options.wholeGrains);
    const DenseBodies found = denseBodies(bodies, standIns, scene, region, options);
    if (found.scale < 1) refuseLessDense(fraction, found.scale, found.iterations);
    PeriodicBox fromRegion = scene.periodic;  // a region may go across a face
    fromRegion.lowest = region.bounds().lowest;
    for (const PlacedBody& body : bodies)
        for (const auto& [place, radius] : standIns.of(body))
            if (!region.contains(fromRegion.wrap(options.wholeGrains ? toVector(place) : body.place),
                                 options.wholeGrains ? radius * (1 - 1e-9) : 0))
                throw InputError(fmt::format(
                    "{}: a {} of the size {:.6g} m was pushed out of the region; take a smaller amount.",
                    ownerOfClumps, body.kind->word(), 2 * body.radius));
}

/// Bodies find their places; those that find no room are left out. Grains of one kind, which need not turn,
/// have a faster way of their own.
/// @param fraction of the region that they fill
void placeSpheres(const InsertionScene& scene, std::vector<PlacedBody>& bodies, const Region& region,
                  const Amount& amount, double fraction, const InsertOptions& options, double& firstLeftOut) {
    std::vector<double> radii;
    for (const PlacedBody& body : bodies) radii.push_back(body.radius);
    const std::vector<Vector<double>> centres =
        placesOfSpheres(scene, radii, region, amount, fraction, options, firstLeftOut);
    for (std::size_t k = 0; k < bodies.size(); ++k) bodies[k].place = centres[k];
    std::erase_if(bodies, [](const PlacedBody& body) { return !isSet(body.place.x); });
}
void placeBodies(const InsertionScene& scene, std::vector<PlacedBody>& bodies, const Region& region,
                 const Amount& amount, const InsertOptions& options, double& firstLeftOut) {
    double volume = 0;  // m^3
    for (const PlacedBody& body : bodies) volume += sphereMass(body.radius, 1);
    const double fraction = volume / region.volume();
    if (fraction <= looseFraction * (1 + roundOffOfLimits))
        bodies = placeOneByOne(scene, bodies, region, options, firstLeftOut);
    else {
        refuseTooDense("bodies", amount, fraction);
        placeDensely(scene, bodies, region, options, fraction);
    }
    if (scene.periodic.imagesMove)
        for (PlacedBody& body : bodies) body.place = scene.periodic.wrap(body.place);
}

}  // namespace

Inserted insertBodies(const InsertionScene& scene, const BodyMixture& mixture, const Region& given,
                      const Amount& amount, const InsertOptions& options) {
    refuseWithoutSpecies(mixture);
    requireShapes(mixture, scene.shapes, ownerOfClumps);
    const auto region = given.in(scene.periodic);
    const bool areSpheres = mixture.size() == 1 && mixture[0].grain();
    if (areSpheres)
        refuseWithoutRoom(ownerOfClumps, *region, scene.walls, scene.periodic,
                          0.5 * mixture[0].sizes.smallest(), 0.5 * mixture[0].sizes.largest(),
                          options.wholeGrains);
    const double full = fullMassOf(scene, mixture, region->volume());
    refuseMoreThanTheRegion(mixture, amount, region->volume(), full);
    std::vector<PlacedBody> bodies = bodiesOf(scene, mixture, amount, region->volume(), full, options);
    Inserted result;
    result.wanted = bodies.size();
    double mass = 0;  // kg
    for (const PlacedBody& body : bodies) mass += massOf(scene, body);
    result.wantedMass = amount.kind() == Amount::Kind::Grains ? mass : amount.massOf(0, full);
    if (bodies.empty()) return result;
    if (areSpheres) placeSpheres(scene, bodies, *region, amount, mass / full, options, result.firstLeftOut);
    else placeBodies(scene, bodies, *region, amount, options, result.firstLeftOut);
    const std::size_t before = scene.particles.store().bodies.size();
    scene.particles.reserve(scene.particles.store().size() + bodies.size());
    for (const PlacedBody& body : bodies) {
        const Vector<double> flow =
            options.withFlow ? scene.periodic.flowAt(body.place) : Vector<double>{0, 0, 0};
        body.kind->addTo(scene, body.radius, body.place, body.turn, flow);
        ++result.number;
        result.mass += massOf(scene, body);
        result.solidFraction += sphereMass(body.radius, 1) / region->volume();
    }
    result.orientationOrder = orientationOrder(scene.particles.store().bodies, before).value;
    return result;
}

}  // namespace pendular
