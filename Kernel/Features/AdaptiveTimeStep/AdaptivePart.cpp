#include "Kernel/Features/AdaptiveTimeStep/AdaptivePart.h"

#include <algorithm>

#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepTimes.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/Inlets/InletPart.h"
#include "Kernel/Features/ShearAndStrain/FlowPart.h"

namespace pendular {

Features AdaptivePart::features(const StepContext& /*scene*/) const {
    return adaptive.isSet() ? Features{Feature::AdaptiveStep} : Features{};
}

GrainSizes AdaptivePart::sizesOf(const StepContext& scene) const {
    return sizesOfScene(*scene.laws, scene.particles.store(), inlets, scene.contacts.getHeldContacts(),
                        scene.contacts.ranks());
}

double AdaptivePart::largestStepOf(const StepContext& scene, const GrainSizes& sizes) const {
    const double most = stepOfFastestPair(*scene.laws, sizes, scene.walls);
    return std::min(most < infinity ? most : scene.length,  // nothing can touch
                    shareOfServo * flow.shortestServoTime());
}

/// m, of a grain across itself where it is thinnest
static double smallestRadius(const StepContext& scene, const GrainSizes& sizes) {
    const GrainShapes* const shapes = scene.laws->shapes();
    if (!shapes) return sizes.smallest();  // of all ranks
    const ParticleStore& grains = scene.grains();
    double smallest = infinity;
    for (const std::uint32_t place : grains.place)
        smallest = std::min(smallest, shapes->thickness(grains, place));
    return scene.contacts.ranks().smallest(smallest);
}

/// Grains that have come shorten the step until the next choice; other changes ask for one.
void AdaptivePart::takeOver(StepContext& scene, const SceneChanges& changes) {
    if (!changes.areOnlyNewGrains()) return adaptive.chooseAnew();
    const GrainSizes sizes = sizesOf(scene);
    const double limit = sceneStabilityLimit(*scene.laws, sizes, scene.walls, contactScheme(scene));
    scene.length = std::min(scene.length, adaptive.shorten(scene.length, largestStepOf(scene, sizes), limit));
}

void AdaptivePart::prepare(StepContext& step) {
    if (!adaptive.isDue()) return;
    step.particles.finishStep();
    ParticleStore& grains = step.grains();
    step.contacts.renewGhosts(grains);
    const StepTimes::Within search(step.times, StepTimes::Part::Search);
    const GrainSizes sizes = sizesOf(step);
    const double most = largestStepOf(step, sizes);
    const AdaptiveStep::Outlook outlook =
        adaptive.lookAhead(grains, step.box, step.length, most, norm(step.gravity), step.largestReach,
                           smallestRadius(step, sizes), step.laws->shapes(), step.contacts.ranks());
    ContactBound bound;
    if (outlook.isKnown()) {
        step.contacts.listWithin(grains, outlook.contacts.reach);
        bound = bounds.find(step.contacts, step.walls, grains, contactScheme(step), outlook.contacts);
    }
    const double limit = outlook.isKnown()
                             ? infinity
                             : sceneStabilityLimit(*step.laws, sizes, step.walls, contactScheme(step));
    step.length = adaptive.choose(step.length, most, outlook, bound, limit);
    step.contacts.expectOverlaps(adaptive.supposedOverlap());
}

void AdaptivePart::afterMotion(StepContext& step) {
    adaptive.moved(step.shifts.grains, step.shifts.walls, step.length);
}

void AdaptivePart::afterForces(StepContext& step) {
    if (step.contacts.ranks().any(step.contacts.ownOverlaps().hasExceededExpected()))
        adaptive.noteDeeperOverlap();
}

void AdaptivePart::visitSetting(StateArchive& archive, StepContext& /*scene*/) {
    adaptive.visitState(archive);
}

void AdaptivePart::visitState(StateArchive& /*archive*/, StepContext& scene) {
    scene.contacts.expectOverlaps(adaptive.supposedOverlap());
}

void AdaptivePart::addTo(SummaryRows& rows) const {
    if (!adaptive.hasChosen()) return;
    rows.add("time step chosen anew", adaptive.choiceCount());
    rows.addNumber("smallest time step", adaptive.smallestStep(), "s");
    rows.addNumber("largest time step", adaptive.largestStep(), "s");
}

}  // namespace pendular
