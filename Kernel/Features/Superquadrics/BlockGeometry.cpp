#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Features/Superquadrics/SuperquadricHandler.h"

namespace pendular {

namespace {

/// A grain as its contact sees it.
struct GrainInTouch {
    const BlockPart& part;
    const TranslationRecord& grain;
    Vector<double> spin;  // rad/s

    /// 1/kg, by how much a force along a unit vector moves the point at an arm (m) from the grain's centre
    /// along it. Of spheres, which may be parts of clumps, as the kernel of spheres takes them.
    [[nodiscard]] double response(const Vector<double>& arm, const Vector<double>& along) const {
        if (!part.body) {
            const Vector<double> l = cross(arm, along);
            return grain.inverseMass * (1 + squaredNorm(l) / (0.4 * grain.radius * grain.radius));
        }
        if (part.isHeld) return 0;  // an infinite mass
        const Axes<double> axes(part.body->orientation);
        const Vector<double> l = cross(part.arm + axes.turnBack(arm), axes.turnBack(along)),
                             &inertia = part.body->inertia;
        return 1 / part.body->mass + (l.x * l.x / inertia.x + l.y * l.y / inertia.y + l.z * l.z / inertia.z);
    }
    /// As EightSuperquadrics::turningResponse().
    [[nodiscard]] double turningResponse() const {
        if (!part.body) return grain.inverseMass / (0.4 * grain.radius * grain.radius);
        if (part.isHeld) return 0;
        const Vector<double>& inertia = part.body->inertia;
        return (1 / inertia.x + 1 / inertia.y + 1 / inertia.z) / 3;
    }
    [[nodiscard]] Vector<double> velocityAt(const Vector<double>& arm) const {
        return grain.velocity + cross(spin, arm);
    }
};

/// Writes what follows of a touch: the sides' responses are added where there are two. Responses are those
/// of the points of the surfaces, as in SuperquadricGeometry.
void complete(EightTouches::Lane& lane, const BoxTouch& touch, const GrainInTouch& first) {
    const TangentPlane<double> plane(touch.normal);
    const Vector<double> point = touch.arm1 + (0.5 * touch.depth) * touch.normal;
    lane.normal = touch.normal;
    lane.depth = touch.depth;
    lane.effectiveRadius = touch.radius;
    lane.arm1 = touch.arm1;
    lane.inverseMass = first.response(point, touch.normal);
    lane.response = 0.5 * (first.response(point, plane.u) + first.response(point, plane.v));
    lane.velocity = first.velocityAt(touch.arm1);
    lane.spinSum = lane.spinDifference = first.spin;
    lane.turningResponse = first.turningResponse();
}

void addSecond(EightTouches::Lane& lane, const GrainInTouch& second, const Vector<double>& shift) {
    const TangentPlane<double> plane(lane.normal);
    lane.arm2 = lane.arm1 - shift;
    const Vector<double> point = lane.arm2 - (0.5 * lane.depth) * lane.normal;
    lane.inverseMass += second.response(point, lane.normal);
    lane.response += 0.5 * (second.response(point, plane.u) + second.response(point, plane.v));
    lane.velocity -= second.velocityAt(lane.arm2);
    lane.spinSum += second.spin;
    lane.spinDifference -= second.spin;
    lane.turningResponse += second.turningResponse();
}

BoxTouch touchOfWall(const WallPointColumns& points, std::size_t k, double radius) {
    const Vector<double> normal{points.normal[0].lane[k], points.normal[1].lane[k], points.normal[2].lane[k]};
    const double depth = radius - points.distance.lane[k];
    return {normal, depth, (radius - 0.5 * depth) * normal, radius};
}

}  // namespace

SuperquadricGeometry SuperquadricHandler::geometryOfBlocks(const ContactTask& task, std::size_t block) const {
    const ParticleStore& grains = ParticleHandler::Inside::grainsInStep(particles);
    const ContactBlock& contacts = task.store.blocks[block];
    const bool isAtWall = task.store.buckets[task.bucket].wall >= 0;
    const std::uint8_t listed = task.store.states[block].listed;
    const auto partAt = [&](std::uint32_t place) {
        return blocks.partOf(grains, place, grains.bodies.at(place));
    };
    EightTouches touches;
    for (std::size_t k = 0; k < Pack::lanes; ++k) {
        EightTouches::Lane& lane = touches.lanes[k];
        const std::uint32_t one = contacts.first[k], two = contacts.second[k];
        const TranslationRecord& grain1 = task.translation[one];
        lane.radius1 = lane.radius2 = 1;
        if ((listed >> k & 1) == 0) continue;  // of no meaning
        lane.radius1 = lane.radius2 = grain1.radius;
        const BlockPart part1 = partAt(one);
        const GrainInTouch first{part1, grain1, task.rotation[one].spin};
        if (isAtWall) {
            if (!Blocks::touchesWalls(part1)) continue;
            const WallPointColumns& points = task.store.wallPoints[block - task.store.firstWallBlock()];
            const BoxTouch touch = touchOfWall(points, k, grain1.radius);
            if (!(touch.depth > 0)) continue;
            complete(lane, touch, first);
            // The wall's velocity is that of its point below the centre.
            const double distance = points.distance.lane[k];
            const Vector<double> spin{task.wallSpin.x, task.wallSpin.y, task.wallSpin.z};
            lane.velocity -= Vector<double>{points.velocity[0].lane[k], points.velocity[1].lane[k],
                                            points.velocity[2].lane[k]} +
                             cross(spin, lane.arm1 - distance * lane.normal);
            lane.spinSum += spin;
            lane.spinDifference -= spin;
            continue;
        }
        const TranslationRecord& grain2 = task.translation[two];
        lane.radius2 = grain2.radius;
        const Vector<double> apart = grain2.position - grain1.position;
        const Vector<double> shift = task.box.any() ? task.box.nearest(apart) : apart;
        const double sum = grain1.radius + grain2.radius;
        if (!(squaredNorm(shift) < sum * sum)) continue;
        const BlockPart part2 = partAt(two);
        const BoxTouch touch = blocks.touch(part1, grain1.radius, part2, grain2.radius, shift);
        if (!(touch.depth > 0)) continue;
        complete(lane, touch, first);
        addSecond(lane, {part2, grain2, task.rotation[two].spin}, shift);
        if (task.box.imagesMove) lane.velocity += task.box.velocityBetweenImages(apart, shift);
    }
    return {task, block, touches};
}

}  // namespace pendular
