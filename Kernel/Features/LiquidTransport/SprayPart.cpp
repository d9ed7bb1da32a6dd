#include "Kernel/Features/LiquidTransport/SprayPart.h"

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepTimes.h"
#include "Kernel/Core/Step/SummaryRows.h"

namespace pendular {

Features SprayPart::features(const StepContext& /*scene*/) const {
    return sprays.isEmpty() ? Features{} : Features{Feature::Sprays};
}

void SprayPart::begin(StepContext& scene, bool /*isRestarted*/) { imagesBefore = imagesNow = scene.box; }

void SprayPart::prepare(StepContext& step) {
    imagesBefore = step.box;
    sprays.emit(step.particles.films(), step.box, step.time + step.length);
}

void SprayPart::beforeMotion(StepContext& step) { imagesNow = step.box; }

void SprayPart::finish(StepContext& step) {
    const StepTimes::Within liquid(step.times, StepTimes::Part::Liquid);
    sprays.advance({step.grains(), step.particles.films(), step.contacts, step.walls, step.box, imagesBefore,
                    imagesNow, step.gravity, step.time + step.length, step.length, step.shifts.grains,
                    step.smallestRadius, step.threads});
}

void SprayPart::compareSetUp(StateArchive& archive, StepContext& /*scene*/) { sprays.compareSetUp(archive); }

void SprayPart::visitState(StateArchive& archive, StepContext& scene) {
    if (scene.particles.films().areKept()) sprays.visitState(archive, scene.particles.films());
}

void SprayPart::addTo(SummaryRows& rows) const { rows.add("droplets in flight", sprays.droplets().size()); }

}  // namespace pendular
