#include "Kernel/Scene/SceneCheck.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Particles/GrainName.h"
#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

/// Two bodies that overlap at the start.
struct InitialOverlap {
    double share;                          // of the smaller radius
    std::uint32_t lower, higher;           // identities; at a wall twice that of the grain
    int wall;                              // -1: grain with grain
    double depth;                          // m
    double mostInRun = usualOverlapInRun;  // of the smaller radius; more ends a run of their laws

    /// Whether this one is told of first: the deepest, whatever the order of the list.
    [[nodiscard]] bool isBefore(const InitialOverlap& other) const {
        if (share != other.share) return share > other.share;
        return std::tie(lower, higher, wall) < std::tie(other.lower, other.higher, other.wall);
    }
};

}  // namespace

static InputError initialOverlapError(const ParticleStore& grains, const InitialOverlap& overlap,
                                      double accepted) {
    const std::string other =
        overlap.wall < 0 ? nameOfGrain(grains, overlap.higher) : fmt::format("wall {}", overlap.wall);
    const std::string advice =
        overlap.wall >= 0 && overlap.share > 1
            ? ": the grain's centre is behind the wall, whose normal must point away from the grains"
        : accepted < overlap.mostInRun
            ? fmt::format(", unless acceptOverlaps() allows more (up to {:g} %)", 100 * overlap.mostInRun)
            : "";
    return InputError(
        fmt::format("{} and {}: initial overlap = {:.6g} m is {:.3g} % of the smaller radius; it must be at "
                    "most {:g} %{}.",
                    nameOfGrain(grains, overlap.lower), other, overlap.depth, 100 * overlap.share,
                    100 * std::min(accepted, overlap.mostInRun), advice));
}

/// m, what the overlaps of a grain are held against.
static double radiusOrThickness(const ContactLaws& laws, const ParticleStore& grains, std::uint32_t place) {
    return laws.shapes() ? laws.shapes()->thickness(grains, place) : grains.translation[place].radius;
}

/// m, by how much two solids go through each other without a contact that tells of it; 0 at a wall.
static double hiddenOverlap(const ContactLaws& laws, const ParticleStore& grains, std::uint32_t first,
                            std::uint32_t second, const PeriodicBox& box) {
    if (!laws.shapes() || first == second) return 0;
    const Vector<double> shift =
        box.nearest(grains.translation[second].position - grains.translation[first].position);
    return laws.shapes()->hiddenOverlap(grains, first, second, shift);
}

static InputError hiddenOverlapError(const ParticleStore& grains, const InitialOverlap& overlap) {
    return InputError(fmt::format(
        "rigid bodies {} and {}, two blocks: they go through each other by {:.4g} m more than "
        "their edges are rounded; blocks may overlap no deeper than that at the start.",
        grains.bodies.bodyOf(overlap.lower), grains.bodies.bodyOf(overlap.higher), overlap.depth));
}

/// Bodies that are held may overlap as they like: nothing moves them apart.
static bool areHeld(const ParticleStore& grains, const Bucket& bucket, std::uint32_t first,
                    std::uint32_t second) {
    return grains.translation[first].inverseMass == 0 &&
           (bucket.wall >= 0 || grains.translation[second].inverseMass == 0);
}

std::string remarkOnHeldOverlaps(const ContactSystem& contacts, const ParticleStore& grains,
                                 double accepted) {
    std::optional<InitialOverlap> deepest;
    contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        const std::uint32_t first = contacts.firstOf(contact);
        const std::uint32_t second = bucket.wall >= 0 ? first : contacts.secondOf(contact);
        if (!areHeld(grains, bucket, first, second)) return;
        const auto [lower, higher] = std::minmax({grains.identity[first], grains.identity[second]});
        const double depth = contacts.observe(grains, bucket, contact).overlap(),
                     share = depth / std::min(radiusOrThickness(contacts.laws(), grains, first),
                                              radiusOrThickness(contacts.laws(), grains, second));
        const InitialOverlap one{share, lower, higher, bucket.wall, depth};
        if (share > accepted && (!deepest || one.isBefore(*deepest))) deepest = one;
    });
    if (!deepest) return {};
    return fmt::format(
        "{} and {} are held and overlap by {:.3g} % of the smaller radius: their contact has the force of "
        "that overlap, which counts where such contacts are asked for (forces on walls, heat, "
        "interactions()); setHeldContacts(HeldContacts::None) leaves them out",
        nameOfGrain(grains, deepest->lower),
        deepest->wall < 0 ? nameOfGrain(grains, deepest->higher) : fmt::format("wall {}", deepest->wall),
        100 * deepest->share);
}

void refuseInitialOverlaps(
    const ContactSystem& contacts, const ParticleStore& grains, double accepted,
    const std::function<bool(const Bucket&, std::uint32_t, std::uint32_t)>& isLookedAt) {
    std::optional<InitialOverlap> deepest, deepestHidden;
    const auto keep = [](std::optional<InitialOverlap>& kept, const InitialOverlap& one) {
        if (!kept || one.isBefore(*kept)) kept = one;
    };
    contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        const std::uint32_t first = contacts.firstOf(contact);
        const std::uint32_t second = bucket.wall >= 0 ? first : contacts.secondOf(contact);
        if (!isLookedAt(bucket, first, second) || areHeld(grains, bucket, first, second)) return;
        const double smaller = std::min(radiusOrThickness(contacts.laws(), grains, first),
                                        radiusOrThickness(contacts.laws(), grains, second));
        const auto [lower, higher] = std::minmax({grains.identity[first], grains.identity[second]});
        const double depth = contacts.observe(grains, bucket, contact).overlap();
        const double share = depth / smaller;
        const double most = contacts.laws().ofPair(bucket.species1, bucket.species2).largestOverlapInRun;
        if (share > std::min(accepted, most) * (1 + 1e-9))  // positions are rounded
            keep(deepest, {share, lower, higher, bucket.wall, depth, most});
        const double hidden = hiddenOverlap(contacts.laws(), grains, first, second, contacts.periodicBox());
        if (hidden > 0) keep(deepestHidden, {hidden / smaller, lower, higher, bucket.wall, hidden});
    });
    if (deepestHidden) throw hiddenOverlapError(grains, *deepestHidden);
    if (deepest) throw initialOverlapError(grains, *deepest, accepted);
}

/// Ends a run in which two grains, at these places of the store, have come closer than any contact law is
/// made for.
/// @param ofPair their laws
static void refuseDeepOverlap(const ParticleStore& grains, std::uint32_t first, std::uint32_t second,
                              const PeriodicBox& box, const ContactLaws& laws, const ContactLaws& ofPair,
                              double time) {
    const double largestShare = ofPair.largestOverlapInRun;  // of the smaller radius
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
    throw RunError(fmt::format(
        "At time {:.6g} s {} overlap by {:.4g} m, {:.3g} % of the smaller radius and more than {:g} %: {}.",
        time, namesOfGrains(grains, grains.identity[first], grains.identity[second]), overlap,
        100 * overlap / smaller, 100 * largestShare, ofPair.overlapAdvice));
}

/// The lanes of a block in which spheres overlap by more than a share of the smaller radius.
static unsigned lanesDeeperThan(double share, const ContactBlock& block, const ParticleStore& grains,
                                const PeriodicBox& box) {
    const auto* const base = reinterpret_cast<const double*>(grains.translation.data());
    const auto [x1, y1, z1, r1] = loadRecords<4>(base, 8, block.first.data());
    const auto [x2, y2, z2, r2] = loadRecords<4>(base, 8, block.second.data());
    const Pack nearest = r1 + r2 - Pack(share) * min(r1, r2);
    return bits(squaredNorm(box.nearest(Vector<Pack>{x2 - x1, y2 - y1, z2 - z1})) < nearest * nearest);
}

double leastDeepOverlap(const ContactStore& store, const ContactLaws& laws) {
    double least = infinity;
    for (const Bucket& bucket : store.buckets)
        if (bucket.wall < 0)
            least = std::min(least, laws.ofPair(bucket.species1, bucket.species2).largestOverlapInRun);
    return least;
}

void refuseDeepOverlaps(const ContactStore& store, const ParticleStore& grains, const PeriodicBox& box,
                        const ContactLaws& laws, double time) {
    for (const Bucket& bucket : store.buckets) {
        if (bucket.wall >= 0) continue;
        const ContactLaws& ofPair = laws.ofPair(bucket.species1, bucket.species2);
        for (std::uint32_t b = bucket.begin; b < bucket.end; ++b) {
            const ContactBlock& block = store.blocks[b];
            unsigned deep = store.states[b].listed;
            if (deep != 0 && !laws.shapes())
                deep &= lanesDeeperThan(ofPair.largestOverlapInRun, block, grains, box);
            for (std::size_t lane = 0; deep >> lane != 0; ++lane)
                if ((deep >> lane & 1) != 0 &&
                    !areHeld(grains, bucket, block.first[lane], block.second[lane]))
                    refuseDeepOverlap(grains, block.first[lane], block.second[lane], box, laws, ofPair, time);
        }
    }
}

void refuseFarFaces(const PeriodicBox& box, double smallestRadius) {
    for (const auto axis : vectorAxes)
        if (box.length.*axis > 0)
            for (const double face : {box.lowest.*axis, box.lowest.*axis + box.length.*axis}) {
                Vector<double> place{0, 0, 0};
                place.*axis = face;
                requireResolved("Simulation", "a periodic face", place, smallestRadius);
            }
}

std::string remarkOnFarGrains(const ParticleStore& grains) {
    const TranslationRecord* worst = nullptr;
    double largest = notedRounding;
    for (const TranslationRecord& grain : grains.translation)
        if (grain.radius > 0 && roundingOf(grain.position, grain.radius) > largest)
            worst = &grain, largest = roundingOf(grain.position, grain.radius);
    if (!worst) return {};
    return fmt::format(
        "{} is so far from the origin that its position is rounded to {:.1g} of its radius; a step "
        "should move grains by much more than that, or the scene be nearer to the origin",
        nameOfGrain(grains, grains.identity[static_cast<std::size_t>(worst - grains.translation.data())]),
        largest);
}

void refuseFarGrains(const ParticleStore& grains, double time) {
    const auto isFar = [](const TranslationRecord& grain) {
        return !isResolved(grain.position, grain.radius) && grain.radius > 0;  // no gap
    };
    const auto far = std::ranges::find_if(grains.translation, isFar);
    if (far == grains.translation.end()) return;
    throw RunError(fmt::format(
        "At time {:.6g} s {}: position {}: remove grains that fly away, by an outlet or in a hook.", time,
        nameOfGrain(grains, grains.identity[static_cast<std::size_t>(far - grains.translation.begin())]),
        objectionToPlace(far->position, far->radius)));
}

RunError runawayError(const ParticleStore& grains, double smallestRadius, double time, double step) {
    for (std::size_t k = 0; k < grains.size(); ++k) {
        const double speed = norm(grains.translation[k].velocity);
        if (speed * step <= smallestRadius) continue;
        if (!std::isfinite(speed))
            return RunError(
                fmt::format("At time {:.6g} s the speed of {} is {} m/s, which is not a number: "
                            "take a smaller time "
                            "step, or look at what the driver has set, spins too.",
                            time, nameOfGrain(grains, grains.identity[k]), std::abs(speed)));
        return RunError(
            fmt::format("At time {:.6g} s {} moves at {:.4g} m/s, farther in a step of {:.4g} s "
                        "than the smallest radius, {:.4g} m: "
                        "take a smaller time step, stiffer grains, or lower speeds.",
                        time, nameOfGrain(grains, grains.identity[k]), speed, step, smallestRadius));
    }
    return RunError(
        fmt::format("At time {:.6g} s a particle moved farther in a step than the smallest radius, {:.4g} m.",
                    time, smallestRadius));
}

}  // namespace pendular
