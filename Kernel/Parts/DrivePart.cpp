#include "Kernel/Parts/DrivePart.h"

#include <fmt/format.h>

#include "Kernel/Base/InputError.h"
#include "Kernel/Base/RunError.h"
#include "Kernel/Motion/SceneLimits.h"
#include "Kernel/Particles/ParticleHandler.h"
#include "Kernel/Walls/PlaneDrive.h"

namespace pendular {

Features DrivePart::features(const StepContext& scene) const {
    Features found;
    for (std::size_t w = 0; w < scene.walls.getSize(); ++w)
        if (scene.walls.getObject(w).drive()) found.add(Feature::DrivenWalls, fmt::format("wall {}", w));
    return found;
}

void DrivePart::check(const StepContext& scene) {
    for (std::size_t w = 0; w < scene.walls.getSize(); ++w) {
        const Wall& wall = scene.walls.getObject(w);
        const PlaneDrive* const drive = wall.drive();
        if (!drive) continue;
        if (!PlaneMotion::canMove(wall))
            throw InputError(fmt::format(
                "wall {}: only a plane (InfiniteWall) can be moved by forces; give this wall no drive.", w));
        if (drive->isServo() && scene.length >= 2 * drive->asked.time)
            throw InputError(fmt::format(
                "wall {}: time of the target force = {:.6g} s; it must be more than half a time step of "
                "{:.6g} s, or the force would ring ever more.",
                w, drive->asked.time, scene.length));
        if (scene.particles.getSize() == 0 && !scene.hasInlets)
            throw InputError(
                fmt::format("wall {}: a piston or a target force needs grains, and there are none and no "
                            "inlet that brings any; call setPiston() or setTargetForce() in the run, when "
                            "they are there.",
                            w));
    }
}

void DrivePart::prepare(StepContext& step) {
    for (std::size_t w = 0; w < step.walls.getSize(); ++w) {
        PlaneDrive* const drive = step.walls.getObject(w).drive();
        if (!drive || !drive->isPiston() || drive->touches <= drive->mostTouches) continue;
        drive->mostTouches = drive->touches;
        try {
            checkPistons(*step.laws, *step.checkedSizes, step.walls,
                         step.acceptsUnstableStep ? 0 : step.length, *step.scheme);
        } catch (const InputError& refusal) {
            throw RunError(fmt::format("At time {:.6g} s {}", step.time, refusal.what()));
        }
    }
    motion.forget();
}

PlaneMotion::Step DrivePart::stepOf(const StepContext& step) {
    return {step.time, step.length, step.gravity, *step.scheme, step.smallestRadius, step.hasInlets};
}

void DrivePart::moveSurroundings(StepContext& step) {
    if (step.length > 0) motion.begin(step.walls, step.contacts, step.grains(), stepOf(step));
}

void DrivePart::afterForces(StepContext& step) {
    if (step.length > 0) PlaneMotion::finish(step.walls, stepOf(step));
}

void DrivePart::takeBack(StepContext& step) { motion.takeBack(step.walls); }

void DrivePart::sumForcesOnNewDrives(const StepContext& scene) {
    for (std::size_t w = 0; w < scene.walls.getSize(); ++w)
        if (const PlaneDrive* const drive = scene.walls.getObject(w).drive(); drive && drive->steps == 0)
            scene.contacts.sumForcesOn(scene.particles.store(), w);
}

}  // namespace pendular
