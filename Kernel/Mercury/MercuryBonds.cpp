#include "Kernel/Mercury/MercuryBonds.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Adhesion/Bonded.h"

namespace pendular {

using Numbers = BondOfContact<double>;

static bool areBonded(const ContactLaws& laws, int a, int b) {
    return std::ranges::any_of(laws.fields(a, b),
                               [](const FieldValue& field) { return field.law == Bonded::name; });
}

void MercuryBonds::ask(const Pair& pair, double force) { waiting.push_back({pair, force}); }

/// Awake where a pair of species has the law, as hooks ask for bonds at any time.
Features MercuryBonds::features(const StepContext& scene) const {
    const auto species = static_cast<int>(scene.laws->speciesCount());
    for (int a = 0; a < species; ++a)
        for (int b = a; b < species; ++b)
            if (areBonded(*scene.laws, a, b)) return {Feature::OwnPart};
    return waiting.empty() ? Features{} : Features{Feature::OwnPart};
}

void MercuryBonds::give(StepContext& step) {
    for (const Asked& one : waiting) giveOne(step, one);
    waiting.clear();
}

void MercuryBonds::giveOne(StepContext& step, const Asked& asked) {
    const Pair& pair = asked.pair;
    const std::string owner = pair.wall >= 0
                                  ? fmt::format("bond of particle {} and wall {}", pair.first, pair.wall)
                                  : fmt::format("bond of particles {} and {}", pair.first, pair.second);
    const ParticleStore& grains = step.grains();
    bool isFound = false;
    const auto giveTo = [&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = step.contacts.observe(grains, bucket, contact);
        const bool isPair = pair.wall >= 0 ? seen.wall == pair.wall && seen.particle1 == pair.first
                                           : seen.wall < 0 && std::minmax(seen.particle1, seen.particle2) ==
                                                                  std::minmax(pair.first, pair.second);
        if (!isPair || !seen.touching) return;
        if (!areBonded(*step.laws, bucket.species1, bucket.species2))
            throw InputError(owner + ": their species have another adhesion law; it must be Bonded.");
        double& bond = step.contacts.adhesionNumberOf(seen, Numbers::bondNumber);
        bond =
            asked.force >= 0 ? asked.force : step.contacts.adhesionNumberOf(seen, Numbers::attractionNumber);
        step.contacts.adhesionNumberOf(seen, Numbers::askedNumber) = 1;
        isFound = true;
    };
    // Of this grain alone: a restart file may have as many bonds as contacts.
    if (const std::uint32_t place = grains.place[pair.first]; place != PlaceIndex::none)
        step.contacts.forEachActingOf(place, giveTo);
    if (!isFound) throw InputError(owner + ": they must overlap.");
}

/// At the start of a run contacts are there when the first forces are found: these are found anew.
void MercuryBonds::afterForces(StepContext& step) {
    if (step.length > 0 || waiting.empty()) return;
    give(step);
    step.contacts.computeForces(step.grains(), 0, contactScheme(step).contacts);
}

void MercuryBonds::visitState(StateArchive& archive, StepContext& /*scene*/) {
    std::vector<Pair> pairs;
    std::vector<double> forces;
    for (const Asked& one : waiting) pairs.push_back(one.pair), forces.push_back(one.force);
    archive.column<std::uint32_t>("waiting", pairs);
    archive.column<double>("forces", forces);
    if (!archive.isReading()) return;
    archive.require(pairs.size() == forces.size(), "waiting", "does not fit the forces");
    waiting.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k) waiting.push_back({pairs[k], forces[k]});
}

}  // namespace pendular
