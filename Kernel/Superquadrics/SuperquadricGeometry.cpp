#include "Kernel/Superquadrics/SuperquadricGeometry.h"

#include <bit>

#include "Kernel/Contacts/ContactStore.h"

namespace pendular {

namespace {

/// The columns of the last normal are behind those of the normal law.
LaneColumn* normalColumns(ContactMemory& memory, std::size_t block) {
    const std::size_t count = memory.normalHistory.count;
    return &memory.normalHistory.columns[block * count + count - 3];
}

Vector<Pack> load(const LaneColumn* from) {
    return {Pack::load(from[0].lane.data()), Pack::load(from[1].lane.data()),
            Pack::load(from[2].lane.data())};
}

}  // namespace

ContactAcceleration<Pack> SuperquadricGeometry::accelerations(const Vector<double>* acceleration,
                                                              Pack /*lever*/) const {
    const auto ofSurface = [&](const std::array<std::uint32_t, Pack::lanes>& grains,
                               const Vector<Pack>& arm) {
        auto [x, y, z] = loadRecords<3>(reinterpret_cast<const double*>(rotation) + 4, 8, grains.data());
        return gatherVectors(acceleration, grains.data()) + cross(Vector<Pack>{x, y, z}, arm);
    };
    Vector<Pack> own = ofSurface(contacts->first, arm1);
    if (!isAtWall) own = own - ofSurface(contacts->second, arm2);
    return {own, zero(), zero()};
}

void SuperquadricGeometry::takeLast(const ContactTask& task, std::size_t block) {
    rotation = task.rotation;
    contacts = &task.store.blocks[block];
    touched = Mask(false);
    normalBefore = zero();
    const std::uint32_t slot = task.store.slots[block];
    if (slot == ContactStore::asleep || slot == ContactStore::waking) return;
    touched = maskFromBits(task.store.states[block].touching);
    normalBefore = select(touched, load(normalColumns(task.store.memory, slot)), zero());
}

void SuperquadricGeometry::setRadius(const Pack& gauss, const Pack& around) {
    effectiveRadius = min(gauss, Pack(mostRadii) * around);
}

SuperquadricGeometry::SuperquadricGeometry(const ContactTask& task, std::size_t block,
                                           const EightSuperquadrics& first, const EightSuperquadrics& second,
                                           const Vector<Pack>& shift, const Vector<Pack>& imageVelocity,
                                           std::atomic<std::uint64_t>& fallbacks)
    : isAtWall(false), radius1(first.radius), radius2(second.radius), fallbackCount(&fallbacks) {
    takeLast(task, block);
    SuperquadricPair<Pack> pair{first.shape, second.shape, first.axes, second.axes, shift};
    const Pack sum = radius1 + radius2;
    const Mask isNear = maskFromBits(task.store.states[block].listed) & (squaredNorm(shift) < sum * sum);
    const Mask apart = none(isNear) ? Mask(true) : (!isNear) | boxesAreApart(pair);
    fellBack = Mask(false);
    normal = {Pack(1), Pack(0), Pack(0)};
    depth = Pack(-1);
    if (all(apart)) return;
    // Bodies that are apart are done at once.
    pair.shift = select(apart, {Pack(3) * sum, Pack(0), Pack(0)}, shift);
    const Vector<Pack> start = select(apart, normal, select(touched, normalBefore, firstNormal(pair)));
    const SuperquadricTouch<Pack> touch = findTouch(pair, start, true);
    normal = touch.normal;
    depth = select(apart, Pack(-1), touch.depth);
    fellBack = !touch.isFound;
    arm1 = touch.arm1;
    arm2 = arm1 - pair.shift;
    setRadius(touch.radius, radius1 * radius2 / sum);
    // Responses are those of the points of the surfaces, half the overlap from the middle: so they are those
    // of the sphere kernel for spheres.
    const Vector<Pack> half = (Pack(0.5) * depth) * normal, point1 = arm1 + half, point2 = arm2 - half;
    const TangentPlane<Pack> plane(normal);
    inverseMass = first.response(point1, normal) + second.response(point2, normal);
    response = Pack(0.5) * (first.response(point1, plane.u) + first.response(point1, plane.v) +
                            second.response(point2, plane.u) + second.response(point2, plane.v));
    velocity = first.velocity + cross(first.spin, arm1) - (second.velocity + cross(second.spin, arm2)) +
               imageVelocity;
    spinSum = first.spin + second.spin;
}

SuperquadricGeometry::SuperquadricGeometry(const ContactTask& task, std::size_t block,
                                           const EightSuperquadrics& first, const WallPointColumns& wall)
    : isAtWall(true), fellBack(false), radius1(first.radius), radius2(first.radius) {
    takeLast(task, block);
    normal = load(wall.normal.data());
    const Pack distance = Pack::load(wall.distance.lane.data());
    const SupportPoint<Pack> lowest = supportPoint(first.shape, first.axes.turnBack(normal));
    depth = lowest.height - distance;
    const TangentPlane<Pack> plane(normal);
    const Pack gauss =
        curvature(lowest, first.axes.turnBack(plane.u), first.axes.turnBack(plane.v)).determinant();
    setRadius(select(gauss > Pack(0), Pack(1) / sqrt(max(gauss, Pack(1e-300))), Pack(infinity)), radius1);
    const Vector<Pack> point = first.axes.turn(lowest.point);
    arm1 = point - (Pack(0.5) * depth) * normal;
    inverseMass = first.response(point, normal);
    response = Pack(0.5) * (first.response(point, plane.u) + first.response(point, plane.v));
    const Vector<Pack> spin{Pack(task.wallSpin.x), Pack(task.wallSpin.y), Pack(task.wallSpin.z)};
    // The wall's velocity is that of its point below the centre.
    const Vector<Pack> surface = load(wall.velocity.data()) + cross(spin, arm1 - distance * normal);
    velocity = first.velocity + cross(first.spin, arm1) - surface;
    spinSum = first.spin + spin;
}

SuperquadricGeometry::SuperquadricGeometry(const ContactTask& task, std::size_t block,
                                           const EightTouches& touches)
    : isAtWall(task.store.buckets[task.bucket].wall >= 0), fellBack(false) {
    takeLast(task, block);
    std::array<LaneColumn, EightTouches::numbers> columns;
    for (std::size_t k = 0; k < Pack::lanes; ++k) {
        const auto* const numbers = reinterpret_cast<const double*>(&touches.lanes[k]);
        for (std::size_t c = 0; c < columns.size(); ++c) columns[c].lane[k] = numbers[c];
    }
    const LaneColumn* at = columns.data();
    const auto number = [&] { return Pack::load((at++)->lane.data()); };
    const auto vector = [&] {
        const Vector<Pack> loaded = load(at);
        at += 3;
        return loaded;
    };
    normal = vector();
    depth = number(), effectiveRadius = number();
    radius1 = number(), radius2 = number();
    inverseMass = number(), response = number();
    arm1 = vector(), arm2 = vector(), velocity = vector(), spinSum = vector();
}

ContactGeometry<Pack> SuperquadricGeometry::complete() const {
    ContactGeometry<Pack> g;
    g.normal = normal;
    g.overlap = g.lever = depth;
    g.inverseDistance = Pack(0);
    g.effectiveRadius = effectiveRadius;
    g.inverseMass = inverseMass;
    g.effectiveMass = Pack(1) / inverseMass;
    g.velocity = velocity;
    g.spinSum = spinSum;
    g.spinLever = g.spinDifference = zero();
    g.asymmetry = g.rotationResponse = Pack(0);
    return g;
}

void SuperquadricGeometry::writeRecords(ContactMemory& memory, std::size_t block, const Pack& normalForce,
                                        const Vector<Pack>& tangential) const {
    // Where nothing touches, arms may be of no meaning, and forces are zero.
    const Mask touching = depth > Pack(0);
    const Vector<Pack> force = select(touching, fma(-normalForce, normal, tangential), zero());
    const Vector<Pack> torque1 = select(touching, cross(arm1, force), zero());
    Vector<Pack> leverless = cross(normal, force);
    if (!isAtWall)
        leverless =
            (Pack(1) / (radius1 + radius2)) * (torque1 - select(touching, cross(arm2, force), zero()));
    const Vector<Pack> own = torque1 - radius1 * leverless;
    storeRecords(reinterpret_cast<double*>(&memory.records[block * Pack::lanes]),
                 std::array<Pack, 8>{force.x, force.y, force.z, Pack(0), leverless.x, leverless.y,
                                     leverless.z, normalForce});
    storeRecords(reinterpret_cast<double*>(&memory.torques[block * Pack::lanes]),
                 std::array<Pack, 4>{own.x, own.y, own.z, Pack(0)});
    LaneColumn* const columns = normalColumns(memory, block);
    normal.x.store(columns[0].lane.data());
    normal.y.store(columns[1].lane.data());
    normal.z.store(columns[2].lane.data());
    if (const auto failed = bits(fellBack & touching); failed != 0)
        fallbackCount->fetch_add(static_cast<std::uint64_t>(std::popcount(failed)),
                                 std::memory_order_relaxed);
}

void SuperquadricGeometry::writeArms(ContactMemory& memory, std::size_t block) const {
    const auto laneOf = [](const Vector<Pack>& v, std::size_t k) {
        return Vector<double>{v.x[k], v.y[k], v.z[k]};
    };
    for (std::size_t k = 0; k < Pack::lanes; ++k) {
        ContactSample& sample = memory.energies[block * Pack::lanes + k].now;
        if (!sample.acts()) continue;
        sample.arm1 = laneOf(arm1, k);
        if (!isAtWall) sample.arm2 = laneOf(arm2, k);
    }
}

}  // namespace pendular
