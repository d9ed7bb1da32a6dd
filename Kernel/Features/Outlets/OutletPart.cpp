#include "Kernel/Features/Outlets/OutletPart.h"

#include <fmt/format.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/EnergyLedger/EnergyAccount.h"

namespace pendular {

Features OutletPart::features(const StepContext& /*scene*/) const {
    return outlets.isEmpty() ? Features{} : Features{Feature::Outlets};
}

void OutletPart::begin(StepContext& scene, bool /*isRestarted*/) {
    outlets.begin(scene.boxAtSetUp, scene.particles.store(), scene.time);
}

void OutletPart::atEnd(StepContext& step) {
    const std::vector<double> stored = outlets.letOut(step.particles, step.bodies, step.contacts, step.box,
                                                      step.time + step.length, step.threads);
    if (step.account)
        for (const double energy : stored) step.account->endedBetweenSteps(energy);
    step.contacts.sumLostForces(step.grains());
}

void OutletPart::compareSetUp(StateArchive& archive, StepContext& /*scene*/) {
    outlets.compareSetUp(archive);
}

void OutletPart::visitState(StateArchive& archive, StepContext& /*scene*/) { outlets.visitState(archive); }

void OutletPart::addTo(SummaryRows& rows) const {
    for (std::size_t k = 0; k < outlets.getSize(); ++k) {
        const GrainTally::Entry gone = outlets.countOf(k).all();
        rows.add(fmt::format("outlet {}: grains and bodies that have gone", k), gone.number);
        rows.addNumber(fmt::format("outlet {}: mass that has gone", k), gone.mass, "kg");
    }
}

}  // namespace pendular
