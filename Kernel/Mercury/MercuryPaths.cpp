#include "Kernel/Mercury/MercuryPaths.h"

#include <fmt/format.h>

#include <utility>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

static void requireHeld(const GrainReference& grain) {
    if (!grain.isFixed())
        throw InputError(
            fmt::format("particle {}: it has a prescribed path and is not held; call fixParticle() first.",
                        grain.getId()));
}

Features MercuryPaths::features(const StepContext&) const {
    return paths.empty() ? Features{} : Features{Feature::OwnPart};
}

void MercuryPaths::setPosition(GrainReference grain, std::function<Vec3D(double)> path, double now) {
    requireHeld(grain);
    grain.setPosition(path(now));
    paths[grain.getId()] = {std::move(path), {}};
}

void MercuryPaths::setVelocity(const GrainReference& grain, std::function<Vec3D(double)> velocity) {
    requireHeld(grain);
    paths[grain.getId()] = {{}, std::move(velocity)};
}

void MercuryPaths::compareSetUp(StateArchive& archive, StepContext& scene) {
    // Those of grains that have gone are in no file.
    std::erase_if(paths, [&](const auto& path) { return !scene.particles.contains(path.first); });
    archive.same("count", static_cast<std::uint64_t>(paths.size()));
    for (const auto& [identity, path] : paths) {
        const auto& function = path.position ? path.position : path.velocity;
        const Vec3D first = function(0), last = function(scene.time);
        archive.sameValues(fmt::format("{}OfGrain{}", path.position ? "place" : "velocity", identity),
                           {first.x(), first.y(), first.z(), last.x(), last.y(), last.z()},
                           path.position ? "m" : "m/s");
    }
}

void MercuryPaths::prepare(StepContext& step) {
    std::erase_if(paths, [&](const auto& path) { return !step.particles.contains(path.first); });
    for (const auto& [identity, path] : paths) {
        GrainReference grain = step.particles.getObject(identity);
        if (!grain.isFixed() || !(step.length > 0)) continue;
        // The mean velocity of the step is the exact way over its length; of a velocity, that in its middle.
        if (path.position)
            // Where the scene repeats itself the grain is brought back, and its path is not.
            grain.setVelocity(
                toEigen(step.box.nearest(toVector(path.position(step.timeAfter) - grain.getPosition()))) /
                step.length);
        else grain.setVelocity(path.velocity(step.time + 0.5 * step.length));
    }
}

}  // namespace pendular
