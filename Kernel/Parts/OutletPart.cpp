#include "Kernel/Parts/OutletPart.h"

#include "Kernel/Contacts/ContactSystem.h"

namespace pendular {

Features OutletPart::features(const StepContext& /*scene*/) const {
    return outlets.isEmpty() ? Features{} : Features{Feature::Outlets};
}

void OutletPart::begin(StepContext& scene, bool /*isRestarted*/) {
    outlets.begin(scene.box, scene.particles.store(), scene.time);
}

void OutletPart::atEnd(StepContext& step) {
    outlets.letOut(step.particles, step.bodies, step.time + step.length, step.threads);
    step.contacts.sumLostForces(step.grains());
}

void OutletPart::visitState(StateArchive& archive, StepContext& /*scene*/) { outlets.visitState(archive); }

}  // namespace pendular
