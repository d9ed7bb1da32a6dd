#include "Kernel/Insertion/ClumpInsertion.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "Kernel/Base/InputError.h"
#include "Kernel/Insertion/SphereGrid.h"
#include "Kernel/Insertion/WallGap.h"
#include "Kernel/Math/ApartTexts.h"

namespace pendular {

namespace {

constexpr std::string_view owner = "insert()";
constexpr std::uint32_t purposeOfPlaces = 0x1257110, purposeOfTurns = 0x1257120;

/// The spheres of clumps, and whether there is room for another clump beside them.
class Room {
public:
    Room(const InsertionScene& of, const Region& in, bool wholeGrains, double largest)
        : scene(of),
          region(in),
          isWhole(wholeGrains),
          grid(of.particles.store(), of.periodic, in.bounds(), largest) {}

    [[nodiscard]] bool has(const Clump& clump) const {
        for (const SphericalParticle& sphere : clump.getSpheres()) {
            const Vector<double> centre = toVector(sphere.getPosition());
            const double radius = sphere.getRadius();
            if ((isWhole && !region.contains(centre, radius)) ||
                touchesWall(scene.walls, scene.periodic, centre, radius) || !grid.isFree(centre, radius))
                return false;
        }
        return true;
    }
    void take(const Clump& clump) {
        for (const SphericalParticle& sphere : clump.getSpheres())
            grid.add(toVector(sphere.getPosition()), sphere.getRadius());
    }

private:
    const InsertionScene& scene;
    const Region& region;
    bool isWhole;
    SphereGrid grid;
};

}  // namespace

namespace {

/// Its velocity is that at its place inside the periodic box.
void bringIntoFlow(Clump& clump, const PeriodicBox& periodic, const Vector<double>& place,
                   const Vector<double>& velocity, const InsertOptions& options) {
    if (!periodic.imagesMove) return;
    const Vector<double> inside = periodic.wrap(place);
    clump.setPosition(toEigen(inside));
    if (options.withFlow) clump.setVelocity(toEigen(velocity + periodic.flowAt(inside)));
}

}  // namespace

Eigen::Quaterniond evenTurn(double a, double b, double c) {
    const double low = std::sqrt(1 - a), high = std::sqrt(a);
    const double first = 2 * std::numbers::pi * b, second = 2 * std::numbers::pi * c;
    return {high * std::cos(second), low * std::sin(first), low * std::cos(first), high * std::sin(second)};
}

Inserted insertClumps(const InsertionScene& scene, BodyHandler& bodies, const SizeDistribution& sizes,
                      const Region& given, const Amount& amount, const Clump& like,
                      const InsertOptions& options) {
    if (like.getSpeciesIndex() < 0)
        throw InputError(
            fmt::format("{}: the clump has no species; call setSpecies() with one of this scene.", owner));
    const auto region = given.in(scene.periodic);
    const ClumpTemplate& shape = like.getTemplate();
    // Sizes are those of spheres of the same volume, and of the same mean density.
    const double own = scene.particles.massOf(1, like.getSpeciesIndex()) / sphereMass(1, 1);
    const double density = shape.massOf(own, 1).mass / shape.getVolume();
    const std::vector<double> radii = radiiOf(amount, sizes, density, region->volume(), options);
    Inserted result;
    result.wanted = radii.size();
    for (const double radius : radii) result.wantedMass += sphereMass(radius, density);
    if (radii.empty()) return result;
    const double full = density * region->volume();
    if (amount.kind() == Amount::Kind::SolidFraction &&
        amount.value() > looseFraction * (1 + roundOffOfLimits)) {
        const auto [wanted, most] = apartTexts(amount.value(), looseFraction);
        throw InputError(fmt::format(
            "{}: clumps at a solid fraction of {} of the region are asked for; a random start of clumps "
            "reaches {}; insert fewer, and let them fall or compress them.",
            owner, wanted, most));
    }
    const double scaleOfRadius = 2 / shape.getDiameter();
    Room room(scene, *region, options.wholeGrains, scaleOfRadius * radii.front() * shape.getReach());
    const CountedRandom random(options.seed);
    const std::uint64_t first = scene.particles.store().nextIdentity();
    Clump clump = like;
    for (std::size_t k = 0; k < radii.size(); ++k) {
        clump.setScale(scaleOfRadius * radii[k]);
        bool isPlaced = false;
        for (std::uint32_t attempt = 0; attempt < options.tries && !isPlaced; ++attempt) {
            const auto even = [&](std::uint32_t number) {
                return random.uniform(first + k, purposeOfTurns + number, attempt);
            };
            const Vector<double> place = candidateOf(*region, random, first + k, purposeOfPlaces, attempt, 0);
            if (!region->contains(place, 0)) continue;
            clump.setPosition(toEigen(place));
            clump.setOrientation(evenTurn(even(0), even(1), even(2)));
            isPlaced = room.has(clump);
            if (isPlaced) bringIntoFlow(clump, scene.periodic, place, toVector(like.getVelocity()), options);
        }
        if (!isPlaced) {
            if (result.firstLeftOut == 0) result.firstLeftOut = radii[k];
            continue;
        }
        room.take(clump);
        bodies.copyAndAddObject(clump);
        ++result.number;
        result.mass += sphereMass(radii[k], density);
    }
    result.solidFraction = result.mass / full;
    return result;
}

}  // namespace pendular
