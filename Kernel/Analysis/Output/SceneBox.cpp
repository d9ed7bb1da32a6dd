#include "Kernel/Analysis/Output/SceneBox.h"

#include <algorithm>
#include <array>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Core/Walls/WallSurface.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/ListedContacts.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

namespace {

/// Around the centres of all particles, also those of other ranks.
Box boxOfCentres(const ParticleStore& grains, const AllRanks& ranks, double& largestRadius) {
    Box box;
    double radius = 0;
    for (const TranslationRecord& grain : grains.translation) {
        if (grain.radius == 0) continue;  // a gap
        box.include(grain.position);
        radius = std::max(radius, grain.radius);
    }
    largestRadius = ranks.largest(radius);
    for (const auto axis : vectorAxes) {
        box.lowest.*axis = ranks.smallest(box.lowest.*axis);
        box.highest.*axis = ranks.largest(box.highest.*axis);
    }
    return box;
}

/// Around what a driver has given a place in the scene, but for the particles.
Box boxOfSetUp(const Scene& scene) {
    Box box;
    for (const PresentWall& wall : scene.wallHandler.present()) {
        const WallSurface surface = wall.object->surface({{0, 0, 0}, 0});
        if (!surface.endless) box.include(boxAround(surface, wall.object->angularVelocity()));
    }
    if (scene.hasDomain()) box.include(toVector(scene.getMin())), box.include(toVector(scene.getMax()));
    for (std::size_t k = 0; k < scene.inletHandler.getSize(); ++k)
        box.include(scene.inletHandler.regionOf(k).bounds());
    return box;
}

/// Whether a box reaches farther than another one where no period bounds it.
bool exceeds(const Box& box, const Box& other, const PeriodicBox& periodic, double slack) {
    return std::ranges::any_of(vectorAxes, [&](auto axis) {
        return !(periodic.length.*axis > 0) && (box.lowest.*axis < other.lowest.*axis - slack ||
                                                box.highest.*axis > other.highest.*axis + slack);
    });
}

}  // namespace

void SceneBox::take(const Scene& scene) {
    double radius = 0;
    const Box grains = boxOfCentres(scene.particleHandler.store(), scene.contacts().ranks(), radius);
    const Box setUp = boxOfSetUp(scene);
    Box all = grains;
    all.include(setUp);
    Box reached = all;
    reached.include(taken);
    const PeriodicBox& periodic = boxOfContacts(scene);
    double longest = 0;
    for (const auto axis : vectorAxes)
        longest = std::max({longest, periodic.length.*axis, reached.highest.*axis - reached.lowest.*axis});
    const bool isFirst = isEmpty();
    const double slack = 1e-9 * longest;
    const auto isTooSmall = [&] {
        if (!exceeds(all, taken, periodic, slack)) return false;
        // Planes and cylinders have room within them, although no particle was there before.
        const std::array isPeriod{periodic.length.x > 0, periodic.length.y > 0, periodic.length.z > 0};
        return exceeds(all, boxOfDrawing(scene.wallHandler, taken, isPeriod), periodic, slack);
    };
    const bool isWidened = isFirst || isTooSmall();
    // Room to spread: a box that has become too small once is widened by more.
    const double share = isFirst ? 0.25 : 0.5;
    const Vector<double> gravity = toVector(scene.getGravity());
    const auto roomAlong = [&](auto axis, double direction) {
        const bool isUpwards = direction * gravity.*axis < -0.5 * norm(gravity);
        const double side = isUpwards ? reached.highest.*axis - reached.lowest.*axis : longest;
        return radius + std::max(radius, share * side);
    };
    const Box before = taken;
    for (const auto axis : vectorAxes) {
        double &low = taken.lowest.*axis, &high = taken.highest.*axis;
        if (periodic.length.*axis > 0) {
            low = periodic.lowest.*axis, high = low + periodic.length.*axis;
            continue;
        }
        if (!isWidened) continue;
        // Where the set-up reaches farther than the particles, it ends there, unless it has moved on.
        const bool isLowOfSetUp = setUp.lowest.*axis <= grains.lowest.*axis;
        if (!isLowOfSetUp || (!isFirst && low > setUp.lowest.*axis + slack))
            low = std::min(low, all.lowest.*axis - roomAlong(axis, -1));
        else low = std::min(low, setUp.lowest.*axis);
        const bool isHighOfSetUp = setUp.highest.*axis >= grains.highest.*axis;
        if (!isHighOfSetUp || (!isFirst && high < setUp.highest.*axis - slack))
            high = std::max(high, all.highest.*axis + roomAlong(axis, 1));
        else high = std::max(high, setUp.highest.*axis);
    }
    if (!(taken.lowest.x <= taken.highest.x && taken.lowest.y <= taken.highest.y &&
          taken.lowest.z <= taken.highest.z))
        taken = before;  // nothing is there but periods
}

void SceneBox::visitState(StateArchive& archive, std::string_view name) {
    if (archive.isReading() ? !archive.holds(name) : isEmpty()) return;
    archive.finite(name, taken);
    archive.require(
        std::ranges::all_of(vectorAxes, [&](auto axis) { return taken.lowest.*axis <= taken.highest.*axis; }),
        name, "has a lowest corner above its highest one");
}

}  // namespace pendular
