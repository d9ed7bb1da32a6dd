#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Laws/Concepts/DomainLimit.h"

namespace pendular {

/// A reason for which a scene is out of the domain of a law before anything moves: the farthest number of any
/// two bodies.
struct BrokenLimit {
    std::string_view law;
    DomainLimit limit;

    /// One sentence, without commas.
    [[nodiscard]] std::string text() const { return fmt::format("{}: {}", law, limit.text()); }
};

/// The limits that the extreme pairs of bodies of a scene break: one for each law, quantity, and side of its
/// range.
inline std::vector<BrokenLimit> brokenLimits(const ContactLaws& species, const GrainSizes& grains,
                                             const WallHandler& walls) {
    std::vector<BrokenLimit> broken;
    forEachExtremePair(
        species, grains, walls,
        [&](const PairLaws& laws, const Bodies& bodies, double) {
            for (const auto& [law, limit] : laws.laws.brokenLimits(laws.a, laws.b, bodies)) {
                const auto isLow = [](const DomainLimit& l) { return l.value < l.range.highest; };
                const auto same =
                    std::ranges::find_if(broken, [&, &law = law, &limit = limit](const BrokenLimit& b) {
                        return b.law == law && b.limit.quantity == limit.quantity &&
                               isLow(b.limit) == isLow(limit);
                    });
                if (same == broken.end()) broken.push_back({law, limit});
                else if (isLow(limit) == (limit.value < same->limit.value)) same->limit = limit;
            }
        },
        Pairs::OfGrains);
    return broken;
}

/// The fewest steps (infinite: never) in which the integrator doubles a motion of grains at rest, with
/// springs of friction whose dashpots cannot stop it.
inline double fewestStepsToDouble(const ContactLaws& species, const GrainSizes& grains,
                                  const WallHandler& walls, const Integrator& integrator, double step) {
    double fewest = infinity;
    if (species.layout.hasTorque)
        forEachExtremePair(
            species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
                fewest = std::min(fewest, stepsToDouble(laws, bodies, mass, integrator,
                                                        mostContacts(grains.count, walls), step));
            });
    return fewest;
}

/// How many bridges of a scene are out of the domain of their law.
inline std::size_t countBridgesOutOfDomain(const ContactSystem& contacts, const ContactLaws& species,
                                           const ParticleStore& grains) {
    std::size_t count = 0;
    contacts.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
        if (!contacts.isBridged(c)) return;
        Bodies bodies{grains.translation[contacts.firstOf(c)].radius};
        if (bucket.wall < 0) bodies.radius2 = grains.translation[contacts.secondOf(c)].radius;
        count += species.brokenLimits(bucket.species1, bucket.species2, bodies).empty() ? 0 : 1;
    });
    return count;
}

}  // namespace pendular
