#include "Kernel/Features/Superquadrics/SuperquadricGeometry.h"

#include <bit>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/LocalBodies.h"

namespace pendular {

namespace {

/// The columns of the last normal are behind those of the normal law, and those of the last torque between.
LaneColumn* columnsFromEnd(ContactMemory& memory, std::size_t block, std::size_t fromEnd) {
    const std::size_t count = memory.normalHistory.count;
    return &memory.normalHistory.columns[block * count + count - fromEnd];
}
LaneColumn* normalColumns(ContactMemory& memory, std::size_t block) {
    return columnsFromEnd(memory, block, 3);
}
LaneColumn* torqueColumns(ContactMemory& memory, std::size_t block) {
    return columnsFromEnd(memory, block, 6);
}

Vector<Pack> load(const LaneColumn* from) {
    return {Pack::load(from[0].lane.data()), Pack::load(from[1].lane.data()),
            Pack::load(from[2].lane.data())};
}
void store(const Vector<Pack>& v, LaneColumn* to) {
    v.x.store(to[0].lane.data()), v.y.store(to[1].lane.data()), v.z.store(to[2].lane.data());
}

}  // namespace

ContactAcceleration<Pack> SuperquadricGeometry::accelerations(const Vector<double>* acceleration,
                                                              Pack /*lever*/) const {
    using Places = std::array<std::uint32_t, Pack::lanes>;
    const auto angular = [&](const Places& grains) {
        auto [x, y, z] = loadRecords<3>(reinterpret_cast<const double*>(rotation) + 4, 8, grains.data());
        return Vector<Pack>{x, y, z};
    };
    const auto ofSurface = [&](const Places& grains, const Vector<Pack>& spin, const Vector<Pack>& arm) {
        return gatherVectors(acceleration, grains.data()) + cross(spin, arm);
    };
    Vector<Pack> turning = angular(contacts->first);
    Vector<Pack> own = ofSurface(contacts->first, turning, arm1);
    if (!isAtWall) {
        const Vector<Pack> other = angular(contacts->second);
        own = own - ofSurface(contacts->second, other, arm2);
        turning = turning - other;
    }
    return {own, zero(), turning};
}

void SuperquadricGeometry::takeLast(const ContactTask& task, std::size_t block) {
    rotation = task.rotation;
    contacts = &task.store.blocks[block];
    acted = Mask(false);
    normalBefore = zero();
    if (task.held && task.held->masses) takeHeldMasses(task, block);
    const std::uint32_t slot = task.store.slots[block];
    if (slot == ContactStore::asleep || slot == ContactStore::waking) return;
    const BlockState& state = task.store.states[block];
    const Vector<Pack> last = load(normalColumns(task.store.memory, slot));
    // One that joinAtStart() has joined has no normal yet.
    acted = maskFromBits(static_cast<std::uint8_t>(state.touching | state.bridged)) &
            (squaredNorm(last) > Pack(0.5));
    normalBefore = select(acted, last, zero());
}

void SuperquadricGeometry::takeHeldMasses(const ContactTask& task, std::size_t block) {
    const ContactBlock& places = task.store.blocks[block];
    const double* const masses = task.held->masses;
    LaneColumn found;
    for (std::size_t k = 0; k < Pack::lanes; ++k)
        found.lane[k] = massOfHeldPair(masses[places.first[k]], isAtWall ? 0 : masses[places.second[k]]);
    massIfHeld = Pack::load(found.lane.data());
}

/// m, up to which contacts are to be known though they are apart: the range of what attracts, where it can be
/// largest on their surfaces. One that begins with a touch acts on bridges only.
Pack SuperquadricGeometry::reachOf(const ContactTask& task, std::size_t block) const {
    const BlockState& state = task.store.states[block];
    const unsigned lanes = !adhesive ? 0u : adhesive->actsApart ? state.listed : state.bridged;
    if (lanes == 0) return Pack(0);
    LaneColumn reach;
    Bodies last{0, 0};  // many are of one size
    double range = 0;
    for (int k = 0; k < Pack::lanes; ++k) {
        if ((lanes >> k & 1) == 0) continue;
        if (last.radius1 != radius1[k] || last.radius2 != radius2[k]) {
            last = {radius1[k], radius2[k]};
            range = adhesive->range(species1, species2, last);
        }
        reach.lane[static_cast<std::size_t>(k)] = range;
    }
    return Pack::load(reach.lane.data());
}

Vector<Pack> SuperquadricGeometry::lastTorque(ContactMemory& memory, std::size_t block) const {
    return select(acted, load(torqueColumns(memory, block)), zero());
}
void SuperquadricGeometry::keepTorque(ContactMemory& memory, std::size_t block,
                                      const Vector<Pack>& torque) const {
    store(torque, torqueColumns(memory, block));
}

void SuperquadricGeometry::prepareAdhesion(ContactMemory& memory, std::size_t block, Mask joined) const {
    const auto lanes = bits(joined & known);
    if (lanes == 0) return;
    const double volume = adhesive->bridgeVolume(species1, species2).value_or(0);
    for (int k = 0; k < Pack::lanes; ++k) {
        if ((lanes >> k & 1) == 0) continue;
        const LocalBodies local({radius1[k], isAtWall ? infinity : radius2[k]}, volume);
        ContactNumbers prepared{};
        adhesive->prepareAdhesion(species1, species2, local.with(effectiveRadius[k], {own1[k], own2[k]}),
                                  prepared.data());
        memory.interaction.set(block * Pack::lanes + static_cast<std::size_t>(k), prepared.data());
    }
}

void SuperquadricGeometry::setRadius(const Pack& gauss, const Pack& around) {
    effectiveRadius = min(gauss, Pack(mostRadii) * around);
}

SuperquadricGeometry::SuperquadricGeometry(const ContactTask& task, std::size_t block,
                                           const EightSuperquadrics& first, const EightSuperquadrics& second,
                                           const Vector<Pack>& shift, const Vector<Pack>& imageVelocity,
                                           const ContactLaws* adhesion, std::atomic<std::uint64_t>& fallbacks)
    : adhesive(adhesion),
      species1(task.store.buckets[task.bucket].species1),
      species2(task.store.buckets[task.bucket].species2),
      isAtWall(false),
      radius1(first.radius),
      radius2(second.radius),
      fallbackCount(&fallbacks) {
    takeLast(task, block);
    SuperquadricPair<Pack> pair{first.shape, second.shape, first.axes, second.axes, shift};
    const Pack reach = reachOf(task, block), sum = radius1 + radius2, most = sum + reach;
    const Mask isNear = maskFromBits(task.store.states[block].listed) & (squaredNorm(shift) < most * most);
    const Mask apart = none(isNear) ? Mask(true) : (!isNear) | boxesAreApart(pair, reach);
    fellBack = Mask(false);
    known = !apart;
    normal = {Pack(1), Pack(0), Pack(0)};
    depth = Pack(-1) - reach;
    if (all(apart)) return;
    // Bodies that are apart are done at once.
    pair.shift = select(apart, {Pack(3) * sum + reach, Pack(0), Pack(0)}, shift);
    const Vector<Pack> start = select(apart, normal, select(acted, normalBefore, firstNormal(pair)));
    const SuperquadricTouch<Pack> touch = findTouch(pair, start, reach);
    normal = touch.normal;
    depth = select(apart, depth, touch.depth);
    fellBack = !touch.isFound;
    arm1 = touch.arm1;
    arm2 = arm1 - pair.shift;
    setRadius(touch.radius, radius1 * radius2 / sum);
    own1 = touch.own1, own2 = touch.own2;
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
    spinDifference = first.spin - second.spin;
    turningResponse = first.turningResponse() + second.turningResponse();
}

SuperquadricGeometry::SuperquadricGeometry(const ContactTask& task, std::size_t block,
                                           const EightSuperquadrics& first, const WallPointColumns& wall,
                                           const ContactLaws* adhesion)
    : adhesive(adhesion),
      species1(task.store.buckets[task.bucket].species1),
      species2(task.store.buckets[task.bucket].species2),
      isAtWall(true),
      fellBack(false),
      known(true),
      radius1(first.radius),
      radius2(first.radius) {
    takeLast(task, block);
    normal = load(wall.normal.data());
    const Pack distance = Pack::load(wall.distance.lane.data());
    const SupportPoint<Pack> lowest = supportPoint(first.shape, first.axes.turnBack(normal));
    depth = lowest.height - distance;
    const TangentPlane<Pack> plane(normal);
    own1 = gaussRadius(curvature(lowest, first.axes.turnBack(plane.u), first.axes.turnBack(plane.v)));
    own2 = Pack(infinity);
    setRadius(own1, radius1);
    const Vector<Pack> point = first.axes.turn(lowest.point);
    arm1 = point - (Pack(0.5) * depth) * normal;
    inverseMass = first.response(point, normal);
    response = Pack(0.5) * (first.response(point, plane.u) + first.response(point, plane.v));
    const Vector<Pack> spin{Pack(task.wallSpin.x), Pack(task.wallSpin.y), Pack(task.wallSpin.z)};
    // The wall's velocity is that of its point below the centre.
    const Vector<Pack> surface = load(wall.velocity.data()) + cross(spin, arm1 - distance * normal);
    velocity = first.velocity + cross(first.spin, arm1) - surface;
    spinSum = first.spin + spin;
    spinDifference = first.spin - spin;
    turningResponse = first.turningResponse();
}

SuperquadricGeometry::SuperquadricGeometry(const ContactTask& task, std::size_t block,
                                           const EightTouches& touches)
    : isAtWall(task.store.buckets[task.bucket].wall >= 0), fellBack(false), known(true) {
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
    arm1 = vector(), arm2 = vector(), velocity = vector(), spinSum = vector(), spinDifference = vector();
    turningResponse = number();
}

ContactGeometry<Pack> SuperquadricGeometry::complete() const {
    ContactGeometry<Pack> g;
    g.normal = normal;
    g.overlap = g.lever = depth;
    g.inverseDistance = Pack(0);
    g.effectiveRadius = effectiveRadius;
    g.inverseMass = inverseMass;
    // Of bodies that are held the response is 0, but for round-off.
    g.effectiveMass =
        select(massIfHeld > Pack(0), select(inverseMass > Pack(1e-150), Pack(1) / inverseMass, massIfHeld),
               Pack(1) / inverseMass);
    g.velocity = velocity;
    g.spinSum = spinSum;
    g.spinLever = zero();
    g.spinDifference = spinDifference;
    g.asymmetry = Pack(0);
    g.rotationResponse = effectiveRadius * effectiveRadius * turningResponse;
    return g;
}

void SuperquadricGeometry::writeRecords(ContactMemory& memory, std::size_t block, Mask acts,
                                        const Pack& normalForce, const Vector<Pack>& tangential,
                                        const Vector<Pack>& torque) const {
    // Where nothing acts, arms may be of no meaning, and forces are zero.
    const Vector<Pack> force = select(acts, fma(-normalForce, normal, tangential), zero());
    const Vector<Pack> torque1 = select(acts, cross(arm1, force), zero());
    Vector<Pack> leverless = cross(normal, force);
    if (!isAtWall)
        leverless = (Pack(1) / (radius1 + radius2)) * (torque1 - select(acts, cross(arm2, force), zero()));
    const Vector<Pack> own = torque1 - radius1 * leverless + torque;
    storeColumns(memory.records.ofBlock(block), force, Pack(0), leverless, normalForce);
    storeRecords(reinterpret_cast<double*>(&memory.torques[block * Pack::lanes]),
                 std::array<Pack, 4>{own.x, own.y, own.z, Pack(0)});
    store(normal, normalColumns(memory, block));
    if (const auto failed = bits(fellBack & acts); failed != 0)
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
