#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Features/EnergyLedger/ContactAccount.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Features/Wear/WornWall.h"

namespace pendular {

/// The mean motion of the grain at a place in the step, whose motion at the start is remembered.
inline BodyMotion meanMotion(const ParticleStore& grains, std::size_t place) {
    const MotionAtStart& then = grains.atStart[place];
    const TranslationRecord& grain = grains.translation[place];
    const Vector<double> spin = grains.hasSpin ? grains.rotation[place].spin : Vector<double>{0, 0, 0};
    return {0.5 * (then.velocity + grain.velocity), 0.5 * (then.spin + spin), grain.radius,
            grain.inverseMass == 0};
}

/// What a contact of a grain with a wall wears off in a step.
struct WearOfContact {
    std::uint32_t identity = 0;  // of the grain
    int wall = 0;
    std::uint32_t part = 0;
    Vector<double> point{0, 0, 0};  // m
    ContactWear done;
};

/// The walls of a scene that wear, and what contacts do to them in a step.
class WearOfStep {
public:
    explicit WearOfStep(const WallHandler& ofScene) : walls(wornWalls(ofScene)) {
        for (const NumberedWornWall& worn : walls) worn.wall->forgetStep();
    }
    [[nodiscard]] bool any() const { return !walls.empty(); }
    [[nodiscard]] bool wears(int wall) const { return wall >= 0 && find(wall) != walls.end(); }

    /// Whether a contact with a wall slides or begins in the step.
    static bool isWorn(const EnergyRecord& record, double slidingWork) {
        return slidingWork != 0 || (record.now.touching > 0 && !(record.last.touching > 0));
    }
    /// Before takeNowAsLast(). @param grain its mean motion in the step; @param slidingWork J
    static WearOfContact of(const ParticleStore& grains, const PeriodicBox& box, const Bucket& bucket,
                            const ContactBlock& block, std::size_t lane, const EnergyRecord& record,
                            const BodyMotion& grain, double slidingWork) {
        const std::uint32_t place = block.first[lane];
        const Vector<double> arm = depthOf(record, grain.radius);
        WearOfContact worn{grains.identity[place], bucket.wall, block.second[lane],
                           grains.translation[place].position + arm,
                           contactWear(record, slidingWork, grains.atStart[place].velocity,
                                       massAtContact(grains, box, place, arm))};
        worn.done.isImpact &= !grain.isHeld;  // it is pressed in, whatever its mass
        return worn;
    }

    void give(const WearOfContact& one) const {
        find(one.wall)->wall->takeWear(one.part, one.point, one.done);
    }
    /// The wear of all ranks, added up in the order of identities. @param own may be in any order
    void give(const std::vector<WearOfContact>& own, const AllRanks& ranks) const {
        if (!any()) return;
        std::vector<WearOfContact> all = ranks.gather(own);
        std::ranges::sort(
            all, {}, [](const WearOfContact& one) { return std::tuple(one.identity, one.wall, one.part); });
        for (const WearOfContact& one : all) give(one);
    }

private:
    [[nodiscard]] std::vector<NumberedWornWall>::const_iterator find(int wall) const {
        return std::ranges::find(walls, static_cast<std::size_t>(wall), &NumberedWornWall::number);
    }
    /// The vector (m) from the centre of a grain to the surface of the wall that it touches, or has just
    /// left.
    static Vector<double> depthOf(const EnergyRecord& record, double radius) {
        const ContactSample& sample = record.now.acts() ? record.now : record.last;
        if (sample.isShaped()) return sample.arm1 - sample.halfOverlap * sample.normal;
        return (radius - 2 * sample.halfOverlap) * sample.normal;
    }
    /// The mass (kg) that a wall feels at a contact with the grain at a place: of a rigid body, what its
    /// turning leaves of it. @param arm m, from the centre of the grain to the contact
    static double massAtContact(const ParticleStore& grains, const PeriodicBox& box, std::uint32_t place,
                                const Vector<double>& arm) {
        const TranslationRecord& grain = grains.translation[place];
        const std::uint32_t number = grains.bodies.bodyOf(grains.identity[place]);
        if (number == RigidBodies::none) return 1 / grain.inverseMass;
        const RigidBody& body = grains.bodies[grains.bodies.find(number)];
        const double mobility =
            mobilityOf(body, box.nearest(grain.position - body.position) + arm, (1 / norm(arm)) * arm,
                       grains.bodies.heldAxesOf(grains.bodies.find(number)));
        return 1 / std::max(mobility, 1e-9 / body.mass);
    }

    std::vector<NumberedWornWall> walls;
};

}  // namespace pendular
