#include "Kernel/Features/Membranes/MembranePart.h"

#include <fmt/format.h>

#include "Kernel/Features/MovingWalls/DrivePart.h"

namespace pendular {

Features MembranePart::features(const StepContext& scene) const {
    Features found;
    for (const auto& [number, wall] : scene.walls.present())
        if (wall->membrane()) found.add(Feature::Membranes, fmt::format("wall {}", number));
    return found;
}

void MembranePart::prepare(StepContext& step) {
    MembraneMotion::renewForces(step.walls, step.contacts, step.grains(), step.gravity, step.threads);
    motion.forget();
}

void MembranePart::moveSurroundings(StepContext& step) {
    if (step.length > 0) motion.begin(step.walls, DrivePart::stepOf(step));
}

void MembranePart::afterForces(StepContext& step) {
    motion.finish(step.walls, step.contacts, step.grains(), DrivePart::stepOf(step), step.ledger != nullptr);
}

void MembranePart::takeBack(StepContext& step) { motion.takeBack(step.walls); }

}  // namespace pendular
