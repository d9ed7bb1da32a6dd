#include "Kernel/Features/Inlets/InletPart.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/RigidBodies/SphereGroups.h"
#include "Kernel/Foundation/Base/Logger.h"

namespace pendular {

Features InletPart::features(const StepContext& /*scene*/) const {
    return inlets.isEmpty() ? Features{} : Features{Feature::Inlets};
}

InsertionScene InletPart::placesOf(const StepContext& scene) {
    return {scene.particles, scene.bodies,  scene.walls,
            scene.box,       scene.threads, scene.laws ? scene.laws->shapes() : nullptr};
}

void InletPart::begin(StepContext& scene, bool isRestarted) {
    inlets.begin(placesOf(scene), scene.boxAtSetUp, isRestarted);
    for (std::size_t k = 0; k < inlets.getSize(); ++k)
        for (const BodyKind& kind : inlets.bodiesOf(k))
            if (kind.clump())
                if (const auto gap = gapInClump(kind.clump()->getTemplate().getSpheres()))
                    scene.logger(LogLevel::Warn, "inlet {}: clumps: {}.", k, *gap);
}

void InletPart::prepare(StepContext& step) {
    inlets.requireLiquid(step.particles, step.contacts.ranks(), step.time + step.length);
}

void InletPart::atEnd(StepContext& step) {
    inlets.letIn(placesOf(step), step.contacts, step.time + step.length,
                 [&](const std::string& sentence) { step.logger(LogLevel::Warn, "{}", sentence); });
}

void InletPart::compareSetUp(StateArchive& archive, StepContext& /*scene*/) { inlets.compareSetUp(archive); }

void InletPart::visitState(StateArchive& archive, StepContext& /*scene*/) { inlets.visitState(archive); }

GrainSizes sizesOfScene(const ContactLaws& laws, const ParticleStore& grains, const InletHandler& inlets,
                        HeldContacts heldContacts, const AllRanks& ranks) {
    inlets.expectShapes(laws.shapes());
    GrainSizes sizes(grains, laws.speciesCount(), ranks);
    sizes.heldCarryWalls = heldContacts != HeldContacts::None;
    for (const InletHandler::Sizes& toCome : inlets.sizes(laws)) {
        // Twice, so that of all sizes between them any number may come; the count is that of a dense bed.
        const auto species = static_cast<std::size_t>(toCome.species);
        if (toCome.bodies && !sizes.hasBodies) sizes.alone = sizes.free, sizes.hasBodies = true;
        for (const double radius : {toCome.smallest, toCome.smallest, toCome.largest, toCome.largest})
            for (auto* ranges : {&sizes.all, &sizes.free}) ranges->at(species).add(radius);
        if (!toCome.bodies && sizes.hasBodies)
            for (const double radius : {toCome.smallest, toCome.smallest, toCome.largest, toCome.largest})
                sizes.alone[species].add(radius);
        sizes.count += contactsInDensestBed + 1;
        if (toCome.bodies) addTo(sizes.bodies, *toCome.bodies);
    }
    return sizes;
}

void InletPart::addTo(SummaryRows& rows) const {
    for (std::size_t k = 0; k < inlets.getSize(); ++k) {
        const InletCount& count = inlets.countOf(k);
        rows.add(fmt::format("inlet {}: {} that have come", k,
                             inlets.bodiesOf(k).hasBodies() ? "grains and bodies" : "grains"),
                 count.number);
        rows.addNumber(fmt::format("inlet {}: mass that has come", k), count.mass, "kg");
    }
}

}  // namespace pendular
