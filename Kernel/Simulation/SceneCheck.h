#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/InputError.h"
#include "Kernel/Motion/StabilityLimit.h"
#include "Kernel/Particles/Resolution.h"
#include "Kernel/RunError.h"
#include "Kernel/Walls/Membrane.h"

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

/// The sizes of the grains of each species: of all, and of those that are free to move.
struct GrainSizes {
    std::size_t count = 0;  // of grains
    std::vector<SizeRange> all, free;
    BodyResponse response;  // of rigid bodies, which the stability limit counts with
    bool hasBodies = false;
    Vector<double> lowest{infinity, infinity, infinity};  // m, of the box around all grains
    Vector<double> highest{-infinity, -infinity, -infinity};

    GrainSizes() = default;
    GrainSizes(const ParticleStore& grains, std::size_t speciesCount)
        : count(grains.count()),
          all(speciesCount),
          free(speciesCount),
          response(grains.bodies.response(grains)),
          hasBodies(!grains.bodies.empty()) {
        for (std::size_t k = 0; k < grains.size(); ++k) {
            if (grains.isGap(k)) continue;
            const TranslationRecord& grain = grains.translation[k];
            all[grains.species[k]].add(grain.radius);
            const Vector<double>& at = grain.position;
            const double r = grain.radius;
            lowest = {std::min(lowest.x, at.x - r), std::min(lowest.y, at.y - r),
                      std::min(lowest.z, at.z - r)};
            highest = {std::max(highest.x, at.x + r), std::max(highest.y, at.y + r),
                       std::max(highest.z, at.z + r)};
            if (grain.inverseMass > 0) free[grains.species[k]].add(grain.radius);
        }
    }
    /// m; infinite without grains
    [[nodiscard]] double smallest() const {
        double radius = infinity;
        for (const SizeRange& range : all) radius = std::min(radius, range.smallest);
        return radius;
    }
    /// The grains that a plane can touch, at most: a hexagonal layer of the smallest ones over the shadow of
    /// the box around all.
    [[nodiscard]] double fullLayer(const Vector<double>& normal) const {
        if (!(smallest() < infinity)) return 0;
        const Vector<double> side = highest - lowest;
        if (!(side.x > 0)) return 0;  // none yet
        const double shadow = side.y * side.z * std::abs(normal.x) + side.x * side.z * std::abs(normal.y) +
                              side.x * side.y * std::abs(normal.z);
        const double inLayer = shadow / (2 * std::numbers::sqrt3 * smallest() * smallest());
        return std::clamp(inLayer, 1.0, static_cast<double>(count));
    }
    /// Whether a grain of this radius (m) is between others of its species.
    [[nodiscard]] bool hold(std::size_t species, double radius, bool isFree) const {
        return species < all.size() && all[species].holds(radius) && (!isFree || free[species].holds(radius));
    }
};

/// Which pairs of a scene are looked at: those of all sizes that there are, of which more grains may come, or
/// those of the grains that there are (a grain that is the only one of its size has no pair of two such).
enum class Pairs { OfSizes, OfGrains };

/// Calls function(laws, bodies, effective mass) for the extreme pairs of bodies of a scene: the smallest and
/// the largest grains of each two species, and of each species with each wall. (A grain that is held in place
/// counts as free.)
template <class Function>
void forEachExtremePair(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                        Function&& function, Pairs pairs = Pairs::OfSizes) {
    const std::vector<SizeRange>&free = grains.free, &sizes = grains.all;
    const auto mass = [&](std::size_t s, double radius) { return sphereMass(radius, species.density(s)); };
    const auto forBodies = [&](std::size_t a, std::size_t b, double r1, double r2) {
        function(PairLaws{species, static_cast<int>(a), static_cast<int>(b)}, Bodies{r1, r2},
                 1 / (1 / mass(a, r1) + 1 / mass(b, r2)));
    };
    for (std::size_t a = 0; a < free.size(); ++a) {
        if (free[a].empty()) continue;
        for (const double r1 : {free[a].smallest, free[a].largest}) {
            for (std::size_t b = 0; b < sizes.size(); ++b) {
                const bool withoutItself = a == b && pairs == Pairs::OfGrains;
                if (sizes[b].count < (withoutItself ? 2u : 1u)) continue;
                const auto partners = withoutItself
                                          ? sizes[b].partnersOf(r1)
                                          : std::array<double, 2>{sizes[b].smallest, sizes[b].largest};
                for (const double r2 : partners) forBodies(a, b, r1, r2);
            }
            for (std::size_t w = 0; w < walls.getSize(); ++w)
                if (!walls.isRemoved(w))
                    forBodies(a, static_cast<std::size_t>(walls.getObject(w).species), r1, infinity);
        }
    }
}

/// The contacts that a grain of the scene can have. A wall may touch it at up to three places (the corner of
/// a mesh).
inline std::size_t mostContacts(std::size_t grains, const WallHandler& walls) {
    return std::clamp<std::size_t>(grains + 3 * walls.getSize(), 2, contactsInDensestBed + 1) - 1;
}

/// The contacts for which the mass of a piston is checked: before its first step a guess, a full layer; then
/// the most that there have been, so that a run that goes on is checked as one that was not stopped.
inline double touchesOfPiston(const GrainSizes& grains, const Wall& wall) {
    const PlaneDrive& drive = *wall.drive();
    const double now = static_cast<double>(std::max(drive.touches, drive.mostTouches));
    return drive.steps > 0 ? now : std::max(grains.fullLayer(wall.drivenNormal()), now);
}

/// N/m, of the contacts of a wall with the grains.
inline SpringAndDashpot stiffestAt(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    SpringAndDashpot stiffest;
    for (std::size_t s = 0; s < grains.free.size(); ++s) {
        if (grains.free[s].empty()) continue;
        for (const double radius : {grains.free[s].smallest, grains.free[s].largest})
            stiffest = larger(stiffest, species
                                            .stiffness(static_cast<int>(s), wall.species, {radius, infinity},
                                                       sphereMass(radius, species.density(s)))
                                            .normal);
    }
    return stiffest;
}

/// Of a piston: n (k, c) / M for the n contacts that it can have, or has; zero of other walls.
inline SpringAndDashpot pistonRow(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    const PlaneDrive* const drive = wall.drive();
    if (!drive || !drive->isPiston()) return {};
    return (touchesOfPiston(grains, wall) / drive->asked.mass) * stiffestAt(species, grains, wall);
}

/// 1/m^2, the grains that may touch a membrane: a hexagonal layer of the smallest on each of its sides.
inline double mostTouchesOnArea(const GrainSizes& grains) {
    return 2 / (2 * std::sqrt(3.0) * grains.smallest() * grains.smallest());
}

/// The same of the vertices of a membrane: a contact's work, k (u - sum w v)^2 with weights w that sum to 1,
/// is at most k (1/m + 1/M) (m u^2 + M sum w v^2). So a vertex of mass M has the weights of its contacts, n:
/// those of a hexagonal layer of the smallest grains on each side of its share of the sheet, at least one on
/// each. (Grains that are held in place touch no walls.)
inline SpringAndDashpot membraneRow(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    const Membrane* const membrane = wall.membrane();
    if (!membrane || !(membrane->lightestVertex() < infinity) || grains.count == 0) return {};
    const double onMass = mostTouchesOnArea(grains) / membrane->massOfArea();  // 1/kg
    return std::max(2 / membrane->lightestVertex(), onMass) * stiffestAt(species, grains, wall);
}

/// The stability limit (s) of the vertices of a membrane: their net, and the grains that touch it, with their
/// side 1/m of a contact as well. Infinite of other walls.
inline double membraneLimit(const ContactLaws& species, const GrainSizes& grains, const Wall& wall,
                            const Integrator& integrator) {
    const Membrane* const membrane = wall.membrane();
    if (!membrane || !(membrane->lightestVertex() < infinity)) return infinity;
    SpringAndDashpot row{membrane->squaredFrequency(), membrane->getDamping()};
    row = row + membraneRow(species, grains, wall);
    for (std::size_t s = 0; s < grains.free.size(); ++s) {
        if (grains.free[s].empty()) continue;
        const double mass = sphereMass(grains.free[s].smallest, species.density(s));
        const double touches =
            std::max(2.0, mostTouchesOnArea(grains) * membrane->lightestVertex() / membrane->massOfArea());
        row = row + (touches / mass) * stiffestAt(species, grains, wall);
    }
    return stabilityMargin * SignChange(integrator).limit(row);
}

/// Throws InputError if the time step (s) is above this limit of a membrane.
inline void checkMembranes(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                           double timeStep, const Integrator& integrator) {
    for (std::size_t w = 0; w < walls.getSize(); ++w)
        if (const double limit = membraneLimit(species, grains, walls.getObject(w), integrator);
            timeStep > limit)
            throw InputError(fmt::format(
                "wall {}, a membrane: its springs and hinges (squared frequency up to {:.4g} 1/s^2) and the "
                "grains that touch its lightest vertex ({:.4g} kg) do not bear a time step of {:.6g} s; it "
                "must be at most {:.6g} s, or the net coarser, heavier or softer, unless "
                "acceptUnstableTimeStep() is called.",
                w, walls.getObject(w).membrane()->squaredFrequency(),
                walls.getObject(w).membrane()->lightestVertex(), timeStep, limit));
}

/// The sum of these rows of all walls: a grain may touch several.
inline SpringAndDashpot pistonRows(const ContactLaws& species, const GrainSizes& grains,
                                   const WallHandler& walls) {
    SpringAndDashpot sum;
    for (std::size_t w = 0; w < walls.getSize(); ++w)
        sum = sum + pistonRow(species, grains, walls.getObject(w));
    return sum;
}

/// What a scene makes of the default integrator: springsInStep where the friction of one of its pairs lacks
/// dashpots. (Not with rigid bodies, whose grains keep no accelerations.) Others stay what they are.
inline Integrator schemeOfScene(const ContactLaws& species, const GrainSizes& grains,
                                const WallHandler& walls, const Integrator& integrator) {
    if (!species.layout.hasTorque || grains.hasBodies ||
        !(integrator == integrators::predictedVelocityVerlet))
        return integrator;
    bool lacks = false;
    forEachExtremePair(species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        lacks = lacks || lacksDashpots(laws, bodies, mass, integrator, mostContacts(grains.count, walls));
    });
    return lacks ? integrators::springsInStep : integrator;
}

/// The smallest stability limit (s) of the contacts that the scene can have; infinite without grains.
/// @param ofPistons pistonRows()
inline double sceneStabilityLimit(const ContactLaws& species, const GrainSizes& grains,
                                  const WallHandler& walls, const Integrator& asked,
                                  const SpringAndDashpot& ofPistons) {
    const Integrator integrator = schemeOfScene(species, grains, walls, asked);
    const std::size_t contacts = mostContacts(grains.count, walls);
    double limit = infinity;
    SpringAndDashpot ofWalls = ofPistons;
    for (std::size_t w = 0; w < walls.getSize(); ++w) {
        limit = std::min(limit, membraneLimit(species, grains, walls.getObject(w), integrator));
        ofWalls = ofWalls + membraneRow(species, grains, walls.getObject(w));
    }
    forEachExtremePair(species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        limit = std::min(limit,
                         stabilityLimit(laws, bodies, mass, integrator, contacts, grains.response, ofWalls));
    });
    return limit;
}
inline double sceneStabilityLimit(const ContactLaws& species, const GrainSizes& grains,
                                  const WallHandler& walls,
                                  const Integrator& integrator = integrators::predictedVelocityVerlet) {
    return sceneStabilityLimit(species, grains, walls, integrator, pistonRows(species, grains, walls));
}

/// The largest share, up to 1, of what a time step (s) does not bear as a whole.
/// @param limitOf (share) the stability limit, s; that of 0 is above the step
template <class Limit>
double shareThatIsBorne(double timeStep, Limit&& limitOf) {
    double share = 1, tooMuch = 1;
    for (int halving = 0; halving < 50 && timeStep > limitOf(share); ++halving) tooMuch = share, share *= 0.5;
    for (int k = 0; k < 40; ++k) {
        const double middle = 0.5 * (share + tooMuch);
        (timeStep > limitOf(middle) ? tooMuch : share) = middle;
    }
    return share;
}

/// Throws InputError if a piston is so light that the time step (s), which the grains bear, is above the
/// stability limit: the lightest one, for its contacts, or all of them if the step does not bear the others
/// either.
inline void checkPistons(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                         double timeStep, const Integrator& integrator) {
    const auto limitOf = [&](const SpringAndDashpot& rows) {
        return sceneStabilityLimit(species, grains, walls, integrator, rows);
    };
    const SpringAndDashpot all = pistonRows(species, grains, walls);
    if (timeStep <= limitOf(all) || timeStep > limitOf({})) return;
    std::vector<std::size_t> pistons;
    for (std::size_t w = 0; w < walls.getSize(); ++w)
        if (const Wall& wall = walls.getObject(w); wall.drive() && wall.drive()->isPiston())
            pistons.push_back(w);
    const auto rowOf = [&](std::size_t w) { return pistonRow(species, grains, walls.getObject(w)); };
    const std::size_t lightest =
        *std::ranges::min_element(pistons, {}, [&](std::size_t w) { return limitOf(rowOf(w)); });
    SpringAndDashpot others;
    for (const std::size_t w : pistons)
        if (w != lightest) others = others + rowOf(w);
    const bool isOne = timeStep <= limitOf(others);
    const double share = shareThatIsBorne(
        timeStep, [&](double part) { return limitOf(isOne ? others + part * rowOf(lightest) : part * all); });
    if (isOne) pistons = {lightest};
    std::vector<std::string> masses, least;
    double touches = 0;
    for (const std::size_t w : pistons) {
        const double mass = walls.getObject(w).drive()->asked.mass;
        masses.push_back(fmt::format("wall {}: mass of the piston = {:.6g} kg", w, mass));
        least.push_back(fmt::format("{:.6g} kg", 1.001 * mass / share));
        touches = std::max(touches, touchesOfPiston(grains, walls.getObject(w)));
    }
    throw InputError(fmt::format(
        "{} {} too light for a time step of {:.6g} s with up to {:.0f} contacts; it must be at least {}, or "
        "the step at most {:.6g} s, unless acceptUnstableTimeStep() is called.",
        fmt::join(masses, ", "), isOne ? "is" : "are together", timeStep, touches, fmt::join(least, ", "),
        limitOf(all)));
}

/// Half a period (s) of the fastest oscillation that two bodies of the scene can have; infinite without
/// grains.
inline double shortestHalfPeriod(const ContactLaws& species, const GrainSizes& grains,
                                 const WallHandler& walls) {
    double shortest = infinity;
    forEachExtremePair(species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        shortest = std::min(shortest, halfPeriod(laws, bodies, mass));
    });
    return shortest;
}

/// Throws InputError if a law cannot serve bodies of the scene, or if the time step (s) is above the
/// stability limit.
inline void checkScene(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                       double timeStep, const Integrator& integrator) {
    for (std::size_t w = 0; w < walls.getSize(); ++w)
        if (!walls.isRemoved(w))
            static_cast<void>(
                species.density(static_cast<std::size_t>(walls.getObject(w).species)));  // throws if unknown
    forEachExtremePair(
        species, grains, walls,
        [](const PairLaws& laws, const Bodies& bodies, double) {
            if (const auto objection = laws.objection(bodies)) throw InputError(*objection);
        },
        Pairs::OfGrains);
    checkPistons(species, grains, walls, timeStep, integrator);
    checkMembranes(species, grains, walls, timeStep, integrator);
    const double limit = sceneStabilityLimit(species, grains, walls, integrator);
    if (timeStep > limit)
        throw InputError(
            fmt::format("Simulation: time step = {:.6g} s is above the stability limit of the stiffest "
                        "contacts in a dense "
                        "bed; it must be at most {:.6g} s (for accuracy {:.2g} s), unless "
                        "acceptUnstableTimeStep() is called.",
                        timeStep, limit, std::min(limit, 0.04 * shortestHalfPeriod(species, grains, walls))));
}

/// If the scene repeats itself so soon that a grain could meet two images of another: a contact knows the
/// nearest image only.
/// @param reach m, the largest distance of two centres that act on each other
inline std::optional<std::string> objectionToLengths(const PeriodicBox& box, double reach) {
    const std::array<std::pair<char, double>, 3> lengths{
        {{'x', box.length.x}, {'y', box.length.y}, {'z', box.length.z}}};
    for (const auto& [axis, length] : lengths)
        if (length > 0 && length < 2 * reach)
            return fmt::format(
                "periodic length along {} = {:.6g} m is too short; it must be at "
                "least {:.6g} m, twice the largest distance at which two grains of this scene act "
                "on each other.",
                axis, length, 2 * reach);
    return std::nullopt;
}

/// Throws InputError with that objection. Returns the largest distance (m) of two centres that act on each
/// other.
inline double checkPeriodicLengths(const ContactLaws& species, const GrainSizes& grains,
                                   const WallHandler& walls, const PeriodicBox& box) {
    for (std::size_t w = 0; w < walls.getSize(); ++w)
        if (box.any() && !box.imagesMove && walls.getObject(w).membrane())
            throw InputError(
                fmt::format("wall {}, a membrane: it has no images, so that in a scene which repeats itself "
                            "there can be none; leave setPeriodic() out.",
                            w));
    double reach = 0;
    forEachExtremePair(species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double) {
        if (bodies.radius2 < infinity)
            reach = std::max(reach, bodies.radius1 + bodies.radius2 + laws.range(bodies));
    });
    if (const auto objection = objectionToLengths(box, reach))
        throw InputError(fmt::format("Simulation: {}", *objection));
    return reach;
}

/// The share of the smaller radius beyond which two grains end a run: no contact law is made for more.
inline constexpr double largestOverlapInRun = 0.5;

/// Throws InputError if two bodies overlap by more than a share of the smaller radius (m).
inline void refuseOverlap(const ObservedContact& contact, double smallerRadius, double accepted) {
    const double share = -contact.separation / smallerRadius;
    if (!(share > accepted * (1 + 1e-9))) return;  // positions are rounded
    const std::string other = contact.wall < 0 ? fmt::format("particle {}", contact.particle2)
                                               : fmt::format("wall {}", contact.wall);
    throw InputError(fmt::format(
        "particle {} and {}: initial overlap = {:.6g} m is {:.3g} % of the smaller radius; it must be at "
        "most {:g} %{}.",
        contact.particle1, other, -contact.separation, 100 * share, 100 * accepted,
        accepted < largestOverlapInRun
            ? fmt::format(", unless acceptOverlaps() allows more (up to {:g} %)", 100 * largestOverlapInRun)
            : ""));
}

/// m, what the overlaps of a grain are held against.
inline double radiusOrThickness(const ContactLaws& laws, const ParticleStore& grains, std::uint32_t place) {
    return laws.shapes() ? laws.shapes()->thickness(grains, place) : grains.translation[place].radius;
}

/// Throws InputError if two bodies of a list overlap by more than the accepted share of the smaller radius.
/// @param isLookedAt (bucket, places of the grains): whether this contact is
template <class Function>
void refuseInitialOverlaps(const ContactSystem& contacts, const ParticleStore& grains, double accepted,
                           Function&& isLookedAt) {
    contacts.store().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        const ContactBlock& block = contacts.store().blocks[contact / Pack::lanes];
        const std::uint32_t first = block.first[contact % Pack::lanes];
        const std::uint32_t second = bucket.wall >= 0 ? first : block.second[contact % Pack::lanes];
        if (!isLookedAt(bucket, first, second)) return;
        const double smaller = std::min(radiusOrThickness(contacts.laws(), grains, first),
                                        radiusOrThickness(contacts.laws(), grains, second));
        refuseOverlap(contacts.observe(grains, bucket, contact), smaller, accepted);
    });
}

/// Ends a run in which two grains, at these places of the store, have come closer than any contact law is
/// made for: by half the smaller radius.
inline void refuseDeepOverlap(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                              const PeriodicBox& box, const ContactLaws& laws, double time) {
    constexpr double largestShare = largestOverlapInRun;
    const TranslationRecord &a = grains.translation[first], &b = grains.translation[second];
    const double smaller = std::min(radiusOrThickness(laws, grains, first),
                                    radiusOrThickness(laws, grains, second)),
                 nearest = a.radius + b.radius - largestShare * smaller;
    const Vector<double> shift = box.nearest(b.position - a.position);
    const double distance2 = squaredNorm(shift);
    if (!(distance2 < nearest * nearest)) return;
    double overlap = a.radius + b.radius - std::sqrt(distance2);
    if (laws.shapes()) {
        overlap = laws.shapes()->touch(grains, first, second, shift).depth;
        if (!(overlap > largestShare * smaller)) return;
    }
    throw RunError(
        fmt::format("At time {:.6g} s particles {} and {} overlap by {:.4g} m, {:.3g} % of the smaller "
                    "radius and more than {:g} %: "
                    "take stiffer grains, a smaller time step, or lower speeds and loads.",
                    time, grains.identity[first], grains.identity[second], overlap, 100 * overlap / smaller,
                    100 * largestShare));
}

/// The same for all pairs of a list that was just made. At walls, a grain that has gone half its way is
/// followed until its centre crosses the surface.
inline void refuseDeepOverlaps(const ContactStore& store, const ParticleStore& grains, const PeriodicBox& box,
                               const ContactLaws& laws, double time) {
    store.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        if (bucket.wall >= 0) return;
        const ContactBlock& block = store.blocks[contact / Pack::lanes];
        refuseDeepOverlap(grains, block.first[contact % Pack::lanes], block.second[contact % Pack::lanes],
                          box, laws, time);
    });
}

/// Throws InputError if a face of a scene that repeats itself is so far away that grains there are not
/// resolved.
/// @param smallestRadius m
inline void refuseFarFaces(const PeriodicBox& box, double smallestRadius) {
    for (const auto axis : {&Vector<double>::x, &Vector<double>::y, &Vector<double>::z})
        if (box.length.*axis > 0)
            for (const double face : {box.lowest.*axis, box.lowest.*axis + box.length.*axis}) {
                Vector<double> place{0, 0, 0};
                place.*axis = face;
                requireResolved("Simulation", "a periodic face", place, smallestRadius);
            }
}

/// A sentence, without a full stop, where grains are so far away that steps may be rounded; else empty.
inline std::string remarkOnFarGrains(const ParticleStore& grains) {
    const TranslationRecord* worst = nullptr;
    double largest = notedRounding;
    for (const TranslationRecord& grain : grains.translation)
        if (grain.radius > 0 && roundingOf(grain.position, grain.radius) > largest)
            worst = &grain, largest = roundingOf(grain.position, grain.radius);
    if (!worst) return {};
    return fmt::format(
        "particle {} is so far from the origin that its position is rounded to {:.1g} of its radius; a step "
        "should move grains by much more than that, or the scene be nearer to the origin",
        grains.identity[static_cast<std::size_t>(worst - grains.translation.data())], largest);
}

/// Ends a run in which a grain has gone so far away that it is not resolved any more.
inline void refuseFarGrains(const ParticleStore& grains, double time) {
    const auto isFar = [](const TranslationRecord& grain) {
        return !isResolved(grain.position, grain.radius) && grain.radius > 0;  // no gap
    };
    const auto far = std::ranges::find_if(grains.translation, isFar);
    if (far == grains.translation.end()) return;
    throw RunError(fmt::format(
        "At time {:.6g} s particle {}: position {}: remove grains that fly away, by an outlet or in a hook.",
        time, grains.identity[static_cast<std::size_t>(far - grains.translation.begin())],
        objectionToPlace(far->position, far->radius)));
}

/// The error that ends a run in which a grain has moved farther in a step than the smallest radius (m).
inline RunError runawayError(const ParticleStore& grains, double smallestRadius, double time, double step) {
    for (std::size_t k = 0; k < grains.size(); ++k) {
        const double speed = norm(grains.translation[k].velocity);
        if (speed * step <= smallestRadius) continue;
        if (!std::isfinite(speed))
            return RunError(
                fmt::format("At time {:.6g} s the speed of particle {} is {} m/s, which is not a number: "
                            "take a smaller time "
                            "step, or look at what the driver has set, spins too.",
                            time, grains.identity[k], std::abs(speed)));
        return RunError(
            fmt::format("At time {:.6g} s particle {} moves at {:.4g} m/s, farther in a step of {:.4g} s "
                        "than the smallest radius, {:.4g} m: "
                        "take a smaller time step, stiffer grains, or lower speeds.",
                        time, grains.identity[k], speed, step, smallestRadius));
    }
    return RunError(
        fmt::format("At time {:.6g} s a particle moved farther in a step than the smallest radius, {:.4g} m.",
                    time, smallestRadius));
}

}  // namespace pendular
