#include "Kernel/Scene/TimeStep/StabilityAdvice.h"

#include <fmt/format.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/GrainName.h"

namespace pendular {

std::string StabilityAdvice::text() const {
    if (!(step < infinity))
        return fmt::format(
            "No contacts act now, so that nothing bounds the step; with contacts the limit of {:.3g} s holds "
            "for the densest bed at overlaps of 5 %.",
            limit);
    const char* binding = byOverlap >= byNeighbours ? "overlaps of 5 % of the radius"
                                                    : "twelve neighbours of the stiffest pair";
    return fmt::format(
        "The stability limit of {:.3g} s supposes {}; the contacts that there are stand {:.3g} s. Overlaps: "
        "{:.2g} % at most, {:.2g} % in the mean (factor {:.3g}); {:.3g} contacts a grain (factor {:.3g}); "
        "{:.0f} % of them slide (if all did: factor {:.3g}). The step is bounded by {}, with "
        "{} contacts and an overlap of {:.2g} %.",
        limit, binding, step, 100 * largestOverlap, 100 * meanOverlap, byOverlap, contactsOfGrain,
        byNeighbours, 100 * slidingShare, byFriction,
        wall >= 0 ? fmt::format("wall {}, which forces move", wall)
                  : fmt::format("{} of species {}", nameOfGrain(grain, body), species),
        contactsOfThis, 100 * overlapOfThis);
}

double slidingShare(const ContactSystem& contacts, const ParticleStore& grains) {
    std::size_t touching = 0, sliding = 0;
    for (const Bucket& bucket : contacts.store().buckets) {
        const ContactLaws& laws = contacts.laws().ofPair(bucket.species1, bucket.species2);
        double coefficient = unset;
        for (const FieldValue& field : laws.fields(bucket.species1, bucket.species2))
            if (field.name == "slidingFrictionCoefficient") coefficient = field.value;
        if (!isSet(coefficient)) continue;
        for (std::uint32_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c) {
            if (!contacts.touches(c)) continue;
            const ObservedContact seen = contacts.observe(grains, bucket, c);
            ++touching;
            const double limit = coefficient * std::max(seen.normalForce, 0.0);
            sliding += norm(seen.tangentialForce()) >= (1 - 1e-6) * limit ? 1 : 0;
        }
    }
    return touching == 0 ? 0 : static_cast<double>(sliding) / static_cast<double>(touching);
}

}  // namespace pendular
