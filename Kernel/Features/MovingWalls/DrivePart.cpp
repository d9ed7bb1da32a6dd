#include "Kernel/Features/MovingWalls/DrivePart.h"

#include <fmt/format.h>

#include <utility>

#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Features/MovingWalls/PlaneDrive.h"
#include "Kernel/Features/MovingWalls/WallBody.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

Features DrivePart::features(const StepContext& scene) const {
    Features found;
    for (const auto& [number, wall] : scene.walls.present()) {
        if (wall->isMovedByForces()) found.add(Feature::DrivenWalls, fmt::format("wall {}", number));
        if (const WallBody* const body = wall->body(); body && body->turns())
            found.add(Feature::TurnedWalls, fmt::format("wall {}", number));
    }
    return found;
}

static void checkPlane(const StepContext& scene, std::size_t number, const PlaneDrive& drive) {
    if (!PlaneMotion::canMove(scene.walls.getObject(number)))
        throw InputError(fmt::format(
            "wall {}: only a plane (InfiniteWall) can be moved by forces; give this wall no drive.", number));
    if (drive.isServo() && scene.length >= 2 * drive.asked.time)
        throw InputError(fmt::format(
            "wall {}: time of the target force = {:.6g} s; it must be more than half a time step of "
            "{:.6g} s, or the force would ring ever more.",
            number, drive.asked.time, scene.length));
    if (scene.particles.getSize() == 0 && !scene.hasInlets)
        throw InputError(
            fmt::format("wall {}: a piston or a target force needs grains, and there are none and no "
                        "inlet that brings any; call setPiston() or setTargetForce() in the run, when "
                        "they are there.",
                        number));
}

void DrivePart::check(const StepContext& scene) {
    for (const auto& [number, wall] : scene.walls.present())
        if (const PlaneDrive* const drive = wall->drive()) checkPlane(scene, number, *drive);
}

void DrivePart::prepare(StepContext& step) {
    const auto takeTouches = [](auto* moved) {
        if (!moved || moved->touches <= moved->mostTouches) return false;
        moved->mostTouches = moved->touches;
        return true;
    };
    bool areMore = false;
    for (const PresentWall& wall : step.walls.present()) {
        PlaneDrive* const drive = wall.object->drive();
        areMore = takeTouches(drive && drive->isPiston() ? drive : nullptr) || areMore;
        areMore = takeTouches(wall.object->body()) || areMore;
    }
    motion.forget();
    bodies.forget();
    if (!areMore) return;
    try {
        checkPistons(*step.laws, *step.checkedSizes, step.walls, step.acceptsUnstableStep ? 0 : step.length,
                     *step.scheme);
    } catch (const InputError& refusal) {
        throw RunError(fmt::format("At time {:.6g} s {}", step.time, refusal.what()));
    }
}

PlaneMotion::Step DrivePart::stepOf(const StepContext& step) {
    return {step.time,           step.length,    step.gravity, *step.scheme,
            step.smallestRadius, step.hasInlets, step.threads};
}

void DrivePart::moveSurroundings(StepContext& step) {
    if (!(step.length > 0)) return;
    motion.begin(step.walls, step.contacts, step.grains(), stepOf(step));
    bodies.begin(step.walls, stepOf(step));
}

void DrivePart::accelerate(StepContext& step) {
    if (!(step.length > 0)) return;
    PlaneMotion::finish(step.walls, stepOf(step));
    WallBodyMotion::finish(step.walls, stepOf(step));
}

void DrivePart::takeBack(StepContext& step) {
    bodies.takeBack(step.walls);
    motion.takeBack(step.walls);
}

void DrivePart::addTo(SummaryRows& rows) const {
    for (const PresentWall& wall : walls.present()) {
        const WallBody* const body = wall.object->body();
        if (!body) continue;
        const auto add = [&](std::string_view what, double value, std::string_view unit) {
            rows.addNumber(fmt::format("wall {}: {}", wall.number, what), value, unit);
        };
        if (body->isFree()) {
            add("speed of its centre of mass", norm(body->free.velocity), "m/s");
            add("angular velocity", norm(body->free.spin()), "rad/s");
        } else if (body->turns()) {
            add("angular velocity about its axis", body->speed, "rad/s");
            add("angle turned about its axis", body->way, "rad");
        } else {
            add("speed along its direction", body->speed, "m/s");
            add("way along its direction", body->way, "m");
        }
    }
}

void DrivePart::sumForcesOnNewDrives(const StepContext& scene) {
    const auto isNew = [](const auto* moved) { return moved != nullptr && moved->steps == 0; };
    for (const auto& [number, wall] : scene.walls.present())
        if (isNew(wall->drive()) || isNew(wall->body()))
            scene.contacts.sumForcesOn(scene.particles.store(), number);
}

}  // namespace pendular
