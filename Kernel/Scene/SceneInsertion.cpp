#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Scene/SceneInside.h"

// Fixed amounts of grains and bodies that are inserted into a scene.

namespace pendular {

/// Why less than the amount was inserted, and what helps.
static std::array<std::string, 2> reasonOfShortfall(const Inserted& made) {
    if (made.wanted == 0)
        return {
            fmt::format("insert(): no grain came, because the first random one is heavier than the amount "
                        "of {:.6g} kg",
                        made.wantedMass),
            "take a larger amount, another seed, or Sample::Exact"};
    return {fmt::format("insert(): {} of {} grains found room, {:.6g} kg of {:.6g} kg, a solid fraction of "
                        "{:.3g} of the region; the first left out has a radius of {:.6g} m",
                        made.number, made.wanted, made.mass, made.wantedMass, made.solidFraction,
                        made.firstLeftOut),
            "take a smaller amount, a larger region, or more tries"};
}

Inserted Scene::Inside::reportShortfall(const Inserted& made) {
    if (made.number == made.wanted && made.wanted > 0) return made;
    const auto [what, advice] = reasonOfShortfall(made);
    if (!scene.hasBegun()) throw InputError(fmt::format("{}; {}.", what, advice));
    if (!std::exchange(noRoomWasTold, true)) scene.logger(LogLevel::Warn, "{}.", what);
    return made;
}

/// Adds the sizes of a mixture; returns how wide (m) its widest body is.
static double addTo(GrainSizes& sizes, const BodyMixture& mixture) {
    double widest = 0;
    for (const BodyKind& kind : mixture) {
        if (!kind.grain()) widest = std::max(widest, 2 * kind.reach(0.5 * kind.sizes.largest()));
        const auto species = static_cast<std::size_t>(kind.species());
        const bool isFree = !kind.grain() || !kind.grain()->isFixed();
        for (const double radius : {kind.smallestSphere(0.5 * kind.sizes.smallest()),
                                    kind.largestSphere(0.5 * kind.sizes.largest())}) {
            sizes.all[species].add(radius);
            if (isFree) sizes.free[species].add(radius);
        }
    }
    return widest;
}

/// Whether there is a wall that is not repeated, but may be.
static bool mayRepeat(const WallHandler& walls) {
    return std::ranges::any_of(walls.present(), [](const PresentWall& wall) {
        const auto* const repeated = dynamic_cast<const RepeatedWall*>(wall.object.get());
        return repeated && repeated->canBeRepeated() && !repeated->isRepeated();
    });
}

ImagesForNow Scene::Inside::imagesFor(const BodyMixture& mixture) {
    const WallHandler& walls = scene.wallHandler;
    const auto isOfThisScene = [&](const BodyKind& kind) {
        return kind.species() >= 0 && kind.species() < static_cast<int>(laws().speciesCount());
    };
    if (!box.any() || box.imagesMove || !mayRepeat(walls) || !std::ranges::all_of(mixture, isOfThisScene))
        return {};
    if (laws().layout.interaction > 0) mixChangedLaws();
    const bool wasLookedAt = scene.hasBegun() && !walls.hasChanges();
    GrainSizes sizes = wasLookedAt ? checkedSizes : sizesOf(scene.particleHandler.store());
    const double known = wasLookedAt
                             ? bodies.widest()
                             : std::max(scene.bodyHandler.refuseTooWide(), scene.inletHandler.widestBody()),
                 widest = std::max(known, addTo(sizes, mixture));
    if (wasLookedAt && periodicWalls.areKnownFor(walls, laws(), sizes, widest)) return {};
    return {PeriodicWalls::wallsToRepeat(walls, box, laws(), sizes, widest,
                                         std::min(context.smallestRadius, sizes.smallest())),
            box.length};
}

Inserted Scene::insert(const SizeDistribution& sizes, const Region& region, const Amount& amount,
                       const SphericalParticle& like, const InsertOptions& options) {
    BodyMixture mixture;
    mixture.add(like, sizes);
    return insert(mixture, region, amount, options);
}

Inserted Scene::insert(const SizeDistribution& sizes, const Region& region, const Amount& amount,
                       const Clump& like, const InsertOptions& options) {
    BodyMixture mixture;
    mixture.add(like, sizes);
    return insert(mixture, region, amount, options);
}

Inserted Scene::insert(const SizeDistribution& sizes, const Region& region, const Amount& amount,
                       const SuperquadricGrain& like, const InsertOptions& options) {
    BodyMixture mixture;
    mixture.add(like, sizes);
    return insert(mixture, region, amount, options);
}

Inserted Scene::insert(const BodyMixture& mixture, const Region& region, const Amount& amount,
                       const InsertOptions& options) {
    if (laws().grainsAreDiscs())
        throw InputError(
            "insert(): it counts by the volume of spheres, and grains are discs (setGrainsAreDiscs(), "
            "setParticleDimensions(2)); add them one by one.");
    const ImagesForNow images = inside->imagesFor(mixture);
    const std::size_t before = particleHandler.store().bodies.size();
    const Inserted made =
        insertBodies(InletPart::placesOf(inside->context), mixture, region, amount, options);
    if (hasBegun()) BodyPart::warnOfGaps(inside->context, before);
    else if (mixture.hasBodies() && made.number > 1)
        logger(LogLevel::Info,
               "insert(): {} grains and bodies, a solid fraction of {:.4g}; orientation order {:.3g}.",
               made.number, made.solidFraction, made.orientationOrder);
    return inside->reportShortfall(made);
}

}  // namespace pendular
