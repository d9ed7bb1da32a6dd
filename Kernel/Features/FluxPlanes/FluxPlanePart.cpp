#include "Kernel/Features/FluxPlanes/FluxPlanePart.h"

#include <fmt/format.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Step/SummaryRows.h"

namespace pendular {

Features FluxPlanePart::features(const StepContext& /*scene*/) const {
    return planes.isEmpty() ? Features{} : Features{Feature::FluxPlanes};
}

void FluxPlanePart::begin(StepContext& scene, bool /*isRestarted*/) { planes.begin(scene.box); }

void FluxPlanePart::beforeMotion(StepContext& step) { planes.beforeMotion(step.grains(), step.box); }

void FluxPlanePart::afterMotion(StepContext& step) {
    const auto liquidOf = [&](std::uint32_t place) {
        return step.particles.films().of(step.grains(), place) + step.contacts.liquidAt(step.grains(), place);
    };
    planes.afterMotion(step.particles, step.box, step.length, liquidOf, step.contacts.ranks());
}

void FluxPlanePart::takeBack(StepContext& /*step*/) { planes.takeBack(); }

void FluxPlanePart::compareSetUp(StateArchive& archive, StepContext& /*scene*/) {
    planes.compareSetUp(archive);
}

void FluxPlanePart::visitState(StateArchive& archive, StepContext& /*scene*/) { planes.visitState(archive); }

void FluxPlanePart::addTo(SummaryRows& rows) const {
    for (std::size_t k = 0; k < planes.getSize(); ++k) {
        const FluxCount& count = planes.countOf(k);
        rows.add(fmt::format("flux plane {}: net number along its normal", k), count.net());
        rows.addNumber(fmt::format("flux plane {}: net mass along its normal", k), count.netMass(), "kg");
    }
}

}  // namespace pendular
