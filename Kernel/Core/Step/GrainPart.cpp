#include "Kernel/Core/Step/GrainPart.h"

#include <cmath>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Motion/TimeIntegration.h"
#include "Kernel/Core/Particles/GrainName.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/StepTimes.h"
#include "Kernel/Features/RigidBodies/RigidBodyMotion.h"

namespace pendular {

Features GrainPart::features(const StepContext& scene) const {
    Features found{Feature::Grains};
    const ParticleStore& grains = scene.grains();
    const HeldBits all(scene.particles.axesOfAllHeld());  // along these no flow goes: PlaneScene.h
    for (const std::uint32_t place : grains.place)
        if (grains.translation[place].inverseMass == 0 || grains.heldAt(place).without(all).areAlong()) {
            found.add(Feature::HeldGrains, nameOfGrain(grains, grains.identity[place]));
            break;
        }
    return found;
}

void GrainPart::moveGrains(StepContext& step) {
    ParticleStore& grains = step.grains();
    double farthest;  // m^2
    if (step.finishesLast) {
        step.times.enter(StepTimes::Part::Sum);
        farthest =
            TimeIntegration::finishAndBegin(grains, step.contacts.store(), step.gravity, step.unfinished,
                                            step.length, step.threads, *step.scheme, step.box);
    } else {
        step.times.enter(StepTimes::Part::Motion);
        farthest = TimeIntegration::begin(grains, step.length, step.threads, *step.scheme, step.box);
    }
    step.shifts.grains = std::sqrt(farthest);
    step.shifts.approach = 2 * step.shifts.grains;
}

void GrainPart::takeBack(StepContext& step) {
    if (step.grainsHaveMoved) TimeIntegration::takeBack(step.particles.store(), step.length, *step.scheme);
}

void GrainPart::finishLeftStep(const StepContext& step) {
    ParticleStore& grains = step.grains();
    TimeIntegration::finish(grains, step.contacts.store(), step.gravity, step.unfinished, step.threads,
                            *step.scheme);
    if (!grains.bodies.empty())
        RigidBodyMotion::finish(grains, step.contacts.store(), step.gravity, step.unfinished, step.threads,
                                contactScheme(step));
}

}  // namespace pendular
