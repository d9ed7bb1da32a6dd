#include "Kernel/Parts/FluxPlanePart.h"

#include "Kernel/Contacts/ContactSystem.h"

namespace pendular {

Features FluxPlanePart::features(const StepContext& /*scene*/) const {
    return planes.isEmpty() ? Features{} : Features{Feature::FluxPlanes};
}

void FluxPlanePart::begin(StepContext& scene, bool /*isRestarted*/) { planes.begin(scene.box); }

void FluxPlanePart::beforeMotion(StepContext& step) { planes.beforeMotion(step.grains()); }

void FluxPlanePart::moveSurroundings(StepContext& step) {
    planes.afterMotion(step.particles, step.length, [&](std::uint32_t place) {
        return step.particles.films().of(step.grains(), place) + step.contacts.liquidAt(step.grains(), place);
    });
}

void FluxPlanePart::takeBack(StepContext& /*step*/) { planes.takeBack(); }

void FluxPlanePart::visitState(StateArchive& archive, StepContext& /*scene*/) { planes.visitState(archive); }

}  // namespace pendular
