#include "Kernel/Features/RigidBodies/BodyHandler.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Features/RigidBodies/UnionOfSpheres.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"

namespace pendular {

namespace {

Quaternion quaternionOf(const Eigen::Quaterniond& q) { return {q.w(), toVector(q.vec())}; }
Eigen::Quaterniond toEigen(const Quaternion& q) {
    return {q.real, q.imaginary.x, q.imaginary.y, q.imaginary.z};
}
using pendular::toEigen;

/// A grain that is to be joined.
struct Sphere {
    double mass, radius, film;                // kg, m, kg
    Vec3D position, velocity, spin;           // m, m/s, rad/s; the image nearest to the first grain
    Vec3D acceleration, angularAcceleration;  // m/s^2, rad/s^2, of the last step
    EarlierAcceleration earlier;              // of the step before

    /// kg m^2, about its own centre
    [[nodiscard]] double inertia() const {
        return 0.4 * (mass - film) * radius * radius + 2.0 / 3 * film * radius * radius;
    }
};

std::vector<Sphere> spheresOf(ParticleHandler& particles, const PeriodicBox& periodic,
                              std::span<const std::uint32_t> identities) {
    const ParticleStore& grains = particles.store();
    const Vector<double> origin = grains.translation[grains.place[identities[0]]].position;
    std::vector<Sphere> spheres;
    for (const std::uint32_t identity : identities) {
        const std::uint32_t place = grains.place[identity];
        const TranslationRecord& grain = grains.translation[place];
        const Vector<double> image = origin + periodic.nearest(grain.position - origin);
        const RotationRecord turning = grains.hasSpin ? grains.rotation[place] : RotationRecord{};
        const double solid = particles.massOf(grain.radius, grains.species[place]),
                     mass = grain.inverseMass > 0 ? 1 / grain.inverseMass : solid;
        const bool isWet = ParticleHandler::Inside::filmMassAt(particles, place) > 0;
        spheres.push_back({mass, grain.radius, isWet ? std::max(mass - solid, 0.0) : 0, toEigen(image),
                           toEigen(grain.velocity), toEigen(turning.spin),
                           toEigen(grains.acceleration[place]), toEigen(turning.angularAcceleration),
                           grains.earlier.empty() ? EarlierAcceleration{} : grains.earlier[place]});
    }
    return spheres;
}

/// The mass, centre and inertia of solid spheres that do not overlap, about their common centre of mass.
struct SphereSums {
    double mass = 0;                                    // kg
    Vec3D centre = Vec3D::Zero();                       // m
    Vec3D velocity = Vec3D::Zero();                     // m/s
    Vec3D acceleration = Vec3D::Zero();                 // m/s^2
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2
    Vec3D angularMomentum = Vec3D::Zero();              // kg m^2/s
    Vec3D torque = Vec3D::Zero();                       // N m
    double largest = 0;                                 // kg, of one sphere
};

SphereSums sumSpheres(const std::vector<Sphere>& spheres) {
    SphereSums sums;
    for (const Sphere& sphere : spheres) {
        sums.mass += sphere.mass;
        sums.centre += sphere.mass * sphere.position;
        sums.velocity += sphere.mass * sphere.velocity;
        sums.acceleration += sphere.mass * sphere.acceleration;
        sums.largest = std::max(sums.largest, sphere.mass);
    }
    for (Vec3D* sum : {&sums.centre, &sums.velocity, &sums.acceleration}) *sum /= sums.mass;
    for (const Sphere& sphere : spheres) {
        const Vec3D arm = sphere.position - sums.centre;
        const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
        sums.inertia +=
            sphere.inertia() * one + sphere.mass * (arm.squaredNorm() * one - arm * arm.transpose());
        sums.angularMomentum += sphere.inertia() * sphere.spin + sphere.mass * arm.cross(sphere.velocity);
        sums.torque +=
            sphere.inertia() * sphere.angularAcceleration + sphere.mass * arm.cross(sphere.acceleration);
    }
    return sums;
}

/// Without their films.
std::vector<Sphere> drySpheres(std::vector<Sphere> spheres) {
    for (Sphere& sphere : spheres) sphere.mass -= std::exchange(sphere.film, 0);
    return spheres;
}
/// With the motion of the step before.
std::vector<Sphere> earlierSpheres(std::vector<Sphere> spheres) {
    for (Sphere& sphere : spheres) {
        sphere.acceleration = toEigen(sphere.earlier.acceleration);
        sphere.angularAcceleration = toEigen(sphere.earlier.angularAcceleration);
    }
    return spheres;
}

/// What the forces on spheres are to a body that has the dry mass of them (kg) about another centre (m).
EarlierBodyMotion forcesOn(const SphereSums& sums, double mass, const Vec3D& centre, const Vec3D& gravity) {
    const Vec3D force = sums.mass * (sums.acceleration - gravity);
    return {toVector(gravity + force / mass), toVector(sums.torque + (sums.centre - centre).cross(force))};
}

HeldBits requireJoinable(ParticleHandler& particles, std::span<const std::uint32_t> identities) {
    if (identities.empty()) throw InputError("A rigid body must have at least one grain.");
    for (std::size_t k = 0; k < identities.size(); ++k) {
        const GrainReference grain = particles.getObject(identities[k]);
        if (particles.store().bodies.contains(identities[k]))
            throw InputError(fmt::format("particle {} is in a rigid body already.", identities[k]));
        if (std::ranges::count(identities, identities[k]) > 1)
            throw InputError(fmt::format("particle {} is given twice for one rigid body.", identities[k]));
        if (grain.getHeldAxes() != particles.getObject(identities[0]).getHeldAxes())
            throw InputError(
                fmt::format("particles {} and {} are not held alike, and can be in no rigid body; "
                            "hold all or none by fixParticle() or setHeldAxes() first.",
                            identities[0], identities[k]));
    }
    return HeldBits(particles.getObject(identities[0]).getHeldAxes());
}

void refuseOverlaps(const std::vector<Sphere>& spheres, std::span<const std::uint32_t> identities) {
    for (std::size_t a = 0; a < spheres.size(); ++a)
        for (std::size_t b = a + 1; b < spheres.size(); ++b) {
            const double sum = spheres[a].radius + spheres[b].radius;
            const double overlap = sum - (spheres[a].position - spheres[b].position).norm();
            if (overlap > 1e-9 * sum)
                throw InputError(fmt::format(
                    "particles {} and {} of a rigid body overlap by {:.3g} m, so that their masses "
                    "would count the overlap twice; give the mass, the centre and the inertia of "
                    "the body.",
                    identities[a], identities[b], overlap));
        }
}

}  // namespace

std::size_t BodyReference::at() const {
    const std::uint32_t found = handler->store().bodies.find(number);
    if (found == RigidBodies::none) throw InputError(fmt::format("There is no rigid body {}.", number));
    return found;
}
Eigen::Quaterniond BodyReference::getOrientation() const {
    return toEigen(handler->store().bodies.orientationOf(at()));
}
Eigen::Quaterniond BodyReference::getPrincipalAxes() const { return toEigen(body().orientation); }
std::vector<std::uint32_t> BodyReference::getGrains() const {
    std::vector<std::uint32_t> all;
    for (const BodyMember& member : handler->store().bodies.membersOf(at())) all.push_back(member.grain);
    return all;
}
void BodyReference::requireFinite(std::string_view what, const Vec3D& value, std::string_view unit) const {
    if (!value.allFinite())
        throw InputError(fmt::format("rigid body {}: {} = ({}, {}, {}) {} is not finite.", number, what,
                                     value.x(), value.y(), value.z(), unit));
}
// A sphere is what its grain is, which is set itself: by way of the body it would be rounded.
void BodyReference::setVelocity(const Vec3D& velocity) {
    requireFinite("velocity", velocity, "m/s");
    ParticleHandler::Inside::requireHeld(*handler, fmt::format("rigid body {}", number), toVector(velocity),
                                         {0, 0, 0});
    ParticleStore& grains = handler->store();
    const std::size_t k = at();
    grains.bodies[k].velocity = toVector(velocity);
    if (!grains.bodies.isSphere(grains, k)) return grains.bodies.place(grains, k);
    grains.translation[handler->placeOf(getGrains()[0])].velocity = toVector(velocity);
}
void BodyReference::setAngularVelocity(const Vec3D& spin) {
    requireFinite("angular velocity", spin, "rad/s");
    ParticleHandler::Inside::requireHeld(*handler, fmt::format("rigid body {}", number), {0, 0, 0},
                                         toVector(spin));
    ParticleStore& grains = handler->store();
    const std::size_t k = at();
    grains.bodies.setSpin(k, toVector(spin));
    if (!grains.bodies.isSphere(grains, k)) return grains.bodies.place(grains, k);
    if (grains.hasSpin) grains.rotation[handler->placeOf(getGrains()[0])].spin = toVector(spin);
}

void BodyReference::setHeldAxes(const HeldAxes& axes) {
    ParticleStore& grains = handler->store();
    const std::size_t k = at();
    const bool wasHeld = grains.bodies.isHeld(k);
    const HeldBits held = HeldBits(axes).with(HeldBits(handler->axesOfAllHeld()));
    if (held.byte() == grains.bodies.heldAxesOf(k).byte()) return;
    if (grains.bodies.isSphere(grains,
                               k)) {  // it moves as its grain, whose forces are not kept where it is held
        grains.bodies.follow(grains, k);
        const HeldBits before = grains.bodies.heldAxesOf(k);
        const Vector<double>& gravity = ParticleHandler::Inside::gravityOf(*handler);
        grains.bodies[k].acceleration += gravity - before.partAlong(gravity);
    }
    grains.bodies.hold(grains, k, held);
    for (const std::uint32_t grain : getGrains()) ParticleHandler::Inside::noteHeld(*handler, grain, wasHeld);
}

BodyHandler::Solid BodyHandler::solidOf(const std::vector<Ball>& spheres) {
    return {unionOfSpheres(spheres, toleranceOfVolume).volume, exposedShares(spheres)};
}

BodyReference BodyHandler::join(std::span<const std::uint32_t> identities,
                                const std::optional<BodyMass>& mass, const Solid* known,
                                const Eigen::Quaterniond& turn) {
    const HeldBits held = requireJoinable(particles, identities);
    const std::vector<Sphere> wet = spheresOf(particles, periodic, identities), spheres = drySpheres(wet);
    const SphereSums sums = sumSpheres(wet), solid = sumSpheres(spheres);
    if (!mass) refuseOverlaps(spheres, identities);
    const BodyMass own = mass.value_or(BodyMass{solid.mass, solid.centre, solid.inertia});
    checkValue("rigid body", "mass", own.mass, "kg", positive);
    requireResolved("rigid body", "centre", toVector(own.centre),
                    std::ranges::min(spheres, {}, &Sphere::radius).radius);
    // A single sphere moves on as it is, bit for bit.
    const bool isSphere = spheres.size() == 1 && !mass;
    const PrincipalAxes principal =
        isSphere ? PrincipalAxes{Vec3D::Constant(spheres[0].inertia()), Eigen::Quaterniond::Identity()}
                 : principalAxes(own.inertia);
    const Vec3D spin = isSphere ? spheres[0].spin : solveSymmetric(sums.inertia, sums.angularMomentum);
    RigidBody body{.mass = own.mass,
                   .inertia = toVector(principal.moments),
                   .position = toVector(isSphere ? spheres[0].position : own.centre),
                   .velocity = toVector(sums.velocity + spin.cross(own.centre - sums.centre)),
                   .acceleration = toVector(sums.acceleration),
                   .torque = toVector(sums.torque),
                   .orientation = quaternionOf(principal.axes),
                   .largestFreeMass = solid.largest};
    body.setSpin(toVector(spin));
    const Vec3D gravity = toEigen(ParticleHandler::Inside::gravityOf(particles));
    if (!mass && sums.mass > solid.mass) {
        const EarlierBodyMotion now = forcesOn(sums, solid.mass, solid.centre, gravity);
        body.acceleration = now.acceleration, body.torque = now.torque;
    }
    std::vector<Ball> balls;
    for (const Sphere& sphere : spheres) balls.push_back({sphere.position, sphere.radius});
    const BodyReference added =
        add(body, identities, balls, known, isSphere, quaternionOf(turn.conjugate()) * body.orientation);
    RigidBodies& bodies = particles.store().bodies;
    if (!particles.store().earlier.empty()) {
        if (bodies.earlier.size() != bodies.size()) bodies.startEarlier(true);
        bodies.earlier.back() = forcesOn(sumSpheres(earlierSpheres(wet)), own.mass, own.centre, gravity);
    }
    if (held.any()) holdAsJoined(held);
    if (sums.mass > solid.mass) ParticleHandler::Inside::weighFilmsOf(particles, bodies.size() - 1);
    return added;
}

/// The last body keeps the motion that it has in the axes in which its grains are held; but in those in which
/// all are held it has none, also where its grains are not in one plane.
void BodyHandler::holdAsJoined(HeldBits held) {
    ParticleStore& grains = particles.store();
    const std::size_t k = grains.bodies.size() - 1;
    const HeldBits all(particles.axesOfAllHeld());
    const Vector<double> velocity = all.partAlong(grains.bodies[k].velocity),
                         spin = all.partAbout(grains.bodies[k].spin());
    grains.bodies.hold(grains, k, held);
    grains.bodies[k].velocity = velocity;
    grains.bodies.setSpin(k, spin);
    grains.bodies.place(grains, k);
}

/// A single sphere is left as it is.
BodyReference BodyHandler::add(RigidBody body, std::span<const std::uint32_t> identities,
                               const std::vector<Ball>& spheres, const Solid* known, bool isSphere,
                               const Quaternion& frame) {
    const Solid solid = known ? *known : solidOf(spheres);
    std::vector<BodyMember> members;
    for (std::size_t k = 0; k < spheres.size(); ++k)
        members.push_back({identities[k],
                           body.orientation.turnBack(toVector(spheres[k].centre) - body.position),
                           solid.exposed[k]});
    ParticleStore& grains = particles.store();
    const std::uint32_t number = grains.bodies.add(body, members, solid.volume, frame);
    if (!isSphere) grains.bodies.place(grains, grains.bodies.size() - 1);
    ParticleHandler::Inside::noteJoined(particles, identities);
    return {particles, number};
}

BodyReference BodyHandler::copyAndAddObject(const Clump& clump) {
    if (clump.getSpeciesIndex() < 0)
        throw InputError("Clump: species is not set; call setSpecies() with a species of this scene.");
    const double density = particles.massOf(1, clump.getSpeciesIndex()) / sphereMass(1, 1);
    BodyMass own = clump.getTemplate().massOf(density, clump.getScale());
    const Eigen::Matrix3d turn = clump.getOrientation().toRotationMatrix();
    own.centre = clump.getPosition();
    own.inertia = turn * own.inertia * turn.transpose();
    own.inertia = 0.5 * (own.inertia + own.inertia.transpose()).eval();
    std::vector<std::uint32_t> identities;
    try {
        for (const SphericalParticle& sphere : clump.getSpheres())
            identities.push_back(particles.copyAndAddObject(sphere).getId());
        return joinWithMotion(identities, clump, own);
    } catch (...) {
        for (const std::uint32_t identity : identities) particles.removeObject(identity);
        throw;
    }
}

BodyReference BodyHandler::joinWithMotion(std::span<const std::uint32_t> identities, const Clump& clump,
                                          const BodyMass& mass) {
    const ClumpTemplate& shape = clump.getTemplate();
    const double scale = clump.getScale();
    const Solid solid{scale * scale * scale * shape.getVolume(), shape.getExposedShares()};
    if (shape.isSphere()) return join(identities, {}, &solid, clump.getOrientation());
    BodyReference body = join(identities, mass, &solid, clump.getOrientation());
    body.setVelocity(clump.getVelocity());
    body.setAngularVelocity(clump.getAngularVelocity());
    return body;
}

double BodyHandler::refuseTooWide() const {
    const double shortest = periodic.shortestLength();  // m
    double widest = 0;                                  // m
    const ParticleStore& grains = particles.store();
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        for (const BodyMember& member : grains.bodies.membersOf(k)) {
            const double width =
                2 * (norm(member.arm) + grains.translation[grains.place[member.grain]].radius);
            widest = std::max(widest, width);
            if (width > 0.5 * shortest)
                throw InputError(fmt::format(
                    "rigid body {} reaches {:.6g} m from its centre, so it is {:.6g} m wide when it turns; "
                    "in a "
                    "scene that repeats itself after {:.6g} m a body must not be wider than half of that.",
                    grains.bodies.numberOf(k), 0.5 * width, width, shortest));
        }
    return widest;
}

void BodyHandler::removeObject(std::size_t number) {
    const std::vector<std::uint32_t> identities = getObject(number).getGrains();
    ParticleStore& grains = particles.store();
    grains.bodies.remove(grains.bodies.find(number));
    for (const std::uint32_t identity : identities) particles.removeObject(identity);
}

std::size_t BodyHandler::getSize() const {
    ParticleHandler::Inside::requireAll(particles, "bodyHandler.getSize()");
    return particles.store().bodies.size();
}

/// Whether numbers were given that no body has any more.
static bool hasRemoved(const RigidBodies& bodies) {
    return bodies.size() > 0 && bodies.numberOf(bodies.size() - 1) >= bodies.size();
}

BodyReference BodyHandler::getObject(std::size_t number) {
    const ParticleStore& grains = particles.store();
    const std::uint32_t at = grains.bodies.find(number);
    if (grains.isShared && !(at < grains.bodies.size()))
        throw InputError(fmt::format("Rigid body {} is on another rank, or was removed.", number));
    if (at == RigidBodies::none)
        throw InputError(fmt::format(
            "There is no rigid body {}{}.", number,
            hasRemoved(grains.bodies)
                ? ", or it was removed; a loop over bodyHandler, or bodies(), has those that there are"
                : fmt::format("; the scene has {} (counted from 0)", getSize())));
    return {particles, static_cast<std::uint32_t>(number)};
}

std::uint32_t BodyHandler::firstFrom(std::size_t first, std::size_t bound) const {
    const RigidBodies& bodies = particles.store().bodies;
    std::size_t low = 0, end = bodies.size();  // they are in the order of their numbers
    while (low < end) {
        const std::size_t middle = std::midpoint(low, end);
        if (bodies.numberOf(middle) < first) low = middle + 1;
        else end = middle;
    }
    return low < bodies.size() && bodies.numberOf(low) < bound ? bodies.numberOf(low) : RigidBodies::none;
}

BodyHandler::Iterator BodyHandler::begin() {
    ParticleHandler::Inside::requireAll(particles, "a loop over bodyHandler");
    const RigidBodies& bodies = particles.store().bodies;
    const std::size_t bound = bodies.size() == 0 ? 0 : std::size_t{bodies.numberOf(bodies.size() - 1)} + 1;
    return {*this, firstFrom(0, bound), bound};
}

std::optional<std::uint32_t> BodyHandler::bodyOf(std::uint32_t grain) const {
    const std::uint32_t number = particles.store().bodies.bodyOf(grain);
    return number == RigidBodies::none ? std::nullopt : std::optional(number);
}

}  // namespace pendular
