#include "Kernel/Features/RigidBodies/BodyPart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Features/Inlets/Inlet.h"
#include "Kernel/Features/RigidBodies/BodyHandler.h"
#include "Kernel/Features/RigidBodies/RigidBodyMotion.h"
#include "Kernel/Features/RigidBodies/SphereGroups.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

Features BodyPart::features(const StepContext& scene) const {
    if (asksRanks) areThere = scene.contacts.ranks().any(!scene.grains().bodies.empty());
    return areThere || inlets.bringBodies() ? Features{Feature::RigidBodies} : Features{};
}

void BodyPart::check(const StepContext& scene) {
    inlets.refuseTooWide(scene.box);
    width = std::max(scene.bodies.refuseTooWide(), inlets.widestBody());
}

void BodyPart::begin(StepContext& scene, bool /*isRestarted*/) { warnOfGaps(scene, 0); }

void BodyPart::moveGrains(StepContext& step) {
    ParticleStore& grains = step.grains();
    const Integrator scheme = contactScheme(step);
    const double farthest =  // m^2
        step.finishesLast
            ? RigidBodyMotion::finishAndBegin(grains, step.contacts.store(), step.gravity, step.unfinished,
                                              step.length, step.threads, scheme, step.box)
            : RigidBodyMotion::begin(grains, step.length, step.threads, scheme, step.box);
    step.shifts.grains = std::max(step.shifts.grains, std::sqrt(farthest));
    step.shifts.approach = 2 * step.shifts.grains;
}

void BodyPart::afterMotion(StepContext& step) {
    if (!step.box.imagesMove || width <= 0.5 * step.box.shortestLength()) return;
    try {
        width = step.bodies.refuseTooWide();  // the widest may have been removed
    } catch (const InputError& refusal) {
        throw RunError(fmt::format("At time {:.6g} s {}", step.time, refusal.what()));
    }
}

void BodyPart::takeBack(StepContext& step) {
    if (step.grainsHaveMoved) RigidBodyMotion::takeBack(step.grains(), step.length, contactScheme(step));
}

void BodyPart::warnOfGaps(const StepContext& scene, std::size_t first) {
    const ParticleStore& grains = scene.grains();
    std::size_t count = 0;
    std::string one;
    for (std::size_t k = first; k < grains.bodies.size(); ++k) {
        const RigidBody& body = grains.bodies[k];
        std::vector<Ball> spheres;
        for (const BodyMember& member : grains.bodies.membersOf(k))
            spheres.push_back({toEigen(body.position + body.orientation.turn(member.arm)),
                               grains.translation[grains.place[member.grain]].radius});
        const std::optional<std::string> gap = gapInClump(spheres);
        if (gap && count++ == 0) one = fmt::format("rigid body {}: {}", grains.bodies.numberOf(k), *gap);
    }
    if (count > 0)
        scene.logger(LogLevel::Warn, "{}{}.", one,
                     count > 1 ? fmt::format("; so it is in {} bodies", count) : "");
}

}  // namespace pendular
