#include "Kernel/Features/SpeciesByName/SeveralSpeciesLaws.h"

#include <algorithm>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

namespace {

/// Adds a name to a list, "A + B", unless it is in it.
void join(std::string_view name, std::vector<std::string_view>& known, std::string& list) {
    if (name.empty() || std::ranges::find(known, name) != known.end()) return;
    known.push_back(name);
    list.append(list.empty() ? "" : " + ").append(name);
}

ContactLayout larger(const ContactLayout& a, const ContactLayout& b) {
    return {.history = std::max(a.history, b.history),
            .normalHistory = std::max(a.normalHistory, b.normalHistory),
            .interaction = std::max(a.interaction, b.interaction),
            .liquid = std::max(a.liquid, b.liquid),
            .named = 0,
            .hasTorque = a.hasTorque || b.hasTorque,
            .hasContactTorque = a.hasContactTorque || b.hasContactTorque};
}

}  // namespace

SeveralSpeciesLaws::SeveralSpeciesLaws(SeveralSpeciesHandler& speciesHandler) : species(speciesHandler) {
    layout.hasTorque = true;
    name = "Simulation";
}

const ContactLaws* SeveralSpeciesLaws::find(int a, int b) const {
    const std::size_t count = species.getSize();
    if (ofPairs.size() == count * count && std::max(a, b) < static_cast<int>(count))
        return ofPairs[static_cast<std::size_t>(a) * count + static_cast<std::size_t>(b)];
    LawsOfType* const found = species.lawsOf(a, b);
    return found ? &found->laws() : nullptr;
}

const ContactLaws& SeveralSpeciesLaws::ofPair(int a, int b) const {
    if (const ContactLaws* const found = find(a, b)) return *found;
    throw InputError(species.sentenceOfNone(a, b));
}

void SeveralSpeciesLaws::mixAll() {
    species.mixAll();
    layout = {};
    actsApart = formsAtContact = isPlastic = resistsMotion = hasBridges = false;
    hasLargestCapillaryNumber = false;
    overlapLimit = {};
    joinedName.clear(), joinedFriction.clear(), distinct.clear(), ofPairs.clear();
    std::vector<std::string_view> names, frictions;
    const auto count = static_cast<int>(species.getSize());
    std::vector<const ContactLaws*> all;
    for (int a = 0; a < count; ++a)
        for (int b = 0; b < count; ++b) {
            LawsOfType* const type = species.lawsOf(a, b);
            all.push_back(type ? &type->laws() : nullptr);
            if (!type) continue;
            ContactLaws& laws = type->laws();
            hasBridges |= laws.bridgeVolume(a, b).has_value();
            if (std::ranges::find(distinct, &laws) != distinct.end()) continue;
            distinct.push_back(&laws);
            layout = larger(layout, laws.layout);
            actsApart |= laws.actsApart;
            formsAtContact |= laws.formsAtContact;
            isPlastic |= laws.isPlastic;
            resistsMotion |= laws.resistsMotion;
            hasLargestCapillaryNumber |= laws.hasLargestCapillaryNumber;
            if (laws.overlapLimit.largest < overlapLimit.largest) overlapLimit = laws.overlapLimit;
            join(laws.name, names, joinedName);
            join(laws.friction, frictions, joinedFriction);
        }
    ofPairs.swap(all);
    name = joinedName;
    friction = joinedFriction;
}

double SeveralSpeciesLaws::range(int a, int b, const Bodies& bodies) const {
    const ContactLaws* const laws = find(a, b);
    return laws ? laws->range(a, b, bodies) : 0;
}

std::optional<double> SeveralSpeciesLaws::bridgeVolume(int a, int b) const {
    if (!hasBridges) return {};
    const ContactLaws* const laws = find(a, b);
    return laws ? laws->bridgeVolume(a, b).value_or(0) : 0;
}

void SeveralSpeciesLaws::prepare(const std::vector<Bucket>& buckets) {
    ofBuckets.clear();
    for (const Bucket& bucket : buckets) {
        const ContactLaws* const laws = find(bucket.species1, bucket.species2);
        // Only grains that were added in the run come here: those at its start are checked before it.
        if (!laws) throw RunError(species.sentenceOfNone(bucket.species1, bucket.species2));
        ofBuckets.push_back(laws);
    }
    for (ContactLaws* const laws : distinct) laws->prepare(buckets);
}

bool SeveralSpeciesLaws::compute(const ContactTask& task) const {
    return ofBuckets[task.bucket]->compute(task);
}

}  // namespace pendular
