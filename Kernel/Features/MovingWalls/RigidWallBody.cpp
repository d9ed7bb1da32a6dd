// Rigid walls that are bodies.
#include <fmt/format.h>

#include <cmath>

#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

constexpr Range positiveOrEndless{0, infinity, false, true};

Quaternion toQuaternion(const Eigen::Quaterniond& q) { return {q.w(), {q.x(), q.y(), q.z()}}; }

/// How a wall turns from its own frame into the scene.
Quaternion turnOf(const Pose& pose) {
    Eigen::Matrix3d matrix;
    for (int k = 0; k < 3; ++k) matrix.col(k) = toEigen(pose.column[k]);
    return toQuaternion(Eigen::Quaterniond(matrix).normalized());
}

/// Throws InputError unless an endless surface turns into itself about an axis (unit) through a point (m).
void refuseUnlessOwnAxis(const SurfaceExtent& surface, const Vector<double>& axis,
                         const Vector<double>& point) {
    const Vector<double> apart = point - surface.centre;
    if (surface.symmetry == SurfaceExtent::Symmetry::Cylinder && norm(cross(axis, surface.axis)) < 1e-9 &&
        norm(cross(axis, apart)) <= 1e-9 * (norm(point) + norm(surface.centre)))
        return;
    throw InputError(
        "Wall: an endless surface can be a rotor only where it turns into itself, a cylinder about its own "
        "axis; take that axis, or a surface with ends (TriangleWall, AxisymmetricWall).");
}

}  // namespace

void RigidWall::requireShape(std::string_view function) const {
    if (!given)
        throw InputError(
            fmt::format("Wall: there is no shape that forces could move; call set() before {}().", function));
}

/// m, of the surface from the axis (unit) of a rotor through a point (m), in the wall's own frame.
double RigidWall::reachFromAxis(const Vector<double>& axis, const Vector<double>& point) const {
    const SurfaceExtent own = extent();
    if (own.radius < infinity) return norm(cross(axis, own.centre - point)) + own.radius;
    refuseUnlessOwnAxis(own, axis, point);
    // On its axis the distance of a cylinder is its radius.
    const std::uint32_t part = 0;
    WallPoint nearest{};
    findInBody(own.centre, infinity, {&part, 1}, {&nearest, 1});
    return std::abs(nearest.distance);
}

void RigidWall::setSlider(const Vec3D& direction, const SliderSettings& settings) {
    requireShape("setSlider");
    checkValue("Wall", "mass of the slider", settings.mass, "kg", positive);
    checkValue("Wall", "force of the slider", settings.force, "N", anyFinite);
    checkValue("Wall", "friction of the slider", settings.friction, "N", notNegative);
    checkValue("Wall", "largest speed", settings.largestSpeed, "m/s", positiveOrEndless);
    beginBody({.kind = WallBodySettings::Kind::Slider,
               .axis = checkedDirection("Wall", "direction of the slider", direction),
               .load = settings.force,
               .friction = settings.friction,
               .largestSpeed = settings.largestSpeed,
               .inertia = settings.mass});
}

void RigidWall::setRotor(const Vec3D& axis, const Vec3D& point, const RotorSettings& settings) {
    requireShape("setRotor");
    checkValue("Wall", "inertia of the rotor", settings.inertia, "kg m^2", positive);
    checkValue("Wall", "torque of the rotor", settings.torque, "N m", anyFinite);
    checkValue("Wall", "friction of the rotor", settings.friction, "N m", notNegative);
    checkValue("Wall", "largest spin", settings.largestSpin, "rad/s", positiveOrEndless);
    const Vector<double> about = checkedDirection("Wall", "axis of the rotor", axis),
                         through = checkedVector("Wall", "point of the axis", point, "m");
    beginBody({.kind = WallBodySettings::Kind::Rotor,
               .axis = about,
               .load = settings.torque,
               .friction = settings.friction,
               .largestSpeed = settings.largestSpin,
               .inertia = settings.inertia,
               .centre = through,
               .reach = reachFromAxis(pose.turnBack(about), pose.placeBack(through))});
}

void RigidWall::setFreeBody(const FreeBodySettings& settings) {
    requireShape("setFreeBody");
    Eigen::Matrix3d turn;
    for (int k = 0; k < 3; ++k) turn.col(k) = toEigen(pose.column[k]);
    const Vector<double> centre = checkedVector("Wall", "centre of mass", settings.centre, "m");
    beginFreeBody(settings.mass, toEigen(pose.placeBack(centre)), turn.transpose() * settings.inertia * turn,
                  settings);
}

void RigidWall::beginFreeBody(double mass, const Vec3D& centre, const Eigen::Matrix3d& inertia,
                              const FreeBodySettings& forces) {
    checkValue("Wall", "mass of the free body", mass, "kg", positive);
    const SurfaceExtent own = extent();
    if (!(own.radius < infinity))
        throw InputError(
            "Wall: an endless surface cannot move freely in space; take one with ends (TriangleWall, "
            "AxisymmetricWall), or setSlider() or setRotor().");
    const PrincipalAxes principal = principalAxes(inertia);
    const Vector<double> at = toVector(centre);
    beginBody({.kind = WallBodySettings::Kind::Free,
               .inertia = mass,
               .centre = at,
               .reach = norm(at - own.centre) + own.radius,
               .moments = toVector(principal.moments),
               .axes = toQuaternion(principal.axes),
               .force = checkedVector("Wall", "force on the free body", forces.force, "N"),
               .torque = checkedVector("Wall", "torque on the free body", forces.torque, "N m")});
}

void RigidWall::beginBody(const WallBodySettings& asked) {
    const bool goesOn = bodily && bodily->asked.movesAs(asked);
    if (!goesOn) {
        const RigidVelocity before = velocity;
        if (asked.kind == WallBodySettings::Kind::Slider && norm(before.spin) > 0)
            throw InputError("Wall: it turns, so that it cannot slide along a direction; stop it first.");
        endDrive();
        followsFunction = atRest = false;
        steady = {};
        shifted = 0;
        origin = pose;
        bodily.emplace().asked = asked;
        setVelocitiesOfBody(before);
    }
    if (!bodily->asked.isAsHeavyAs(asked)) bodily->mostTouches = 0, bodily->isChecked = false;
    bodily->asked = asked;
    if (!isInRun()) bodyAtSetUp = asked;
}

void RigidWall::setVelocitiesOfBody(const RigidVelocity& before) {
    WallBody& own = *bodily;
    if (own.isFree()) {
        own.free.mass = own.asked.inertia;
        own.free.inertia = own.asked.moments;
        own.free.position = pose.place(own.asked.centre);
        own.free.orientation = (turnOf(pose) * own.asked.axes).normalised();
        own.free.velocity = before.at(own.free.position);
        own.free.setSpin(before.spin);
    } else {
        own.speed = dot(own.turns() ? before.spin : before.linear, own.asked.axis);
        if (!own.turns()) own.across = before.linear - own.speed * own.asked.axis;
    }
    showVelocity(own.velocity());
}

void RigidWall::showVelocity(const RigidVelocity& ofBody) {
    velocity = ofBody;
    velocity.linear += bodily->across;
}

void RigidWall::followBody() {
    const Pose last = pose;
    pose = bodily->poseFrom(origin);
    shifted = extent().displacement(last, pose);
}

void RigidWall::takeBack(const WallBody& before, const Pose& placed, const RigidVelocity& then) {
    *bodily = before;
    pose = placed;
    velocity = then;
    shifted = 0;
}

void RigidWall::visitBody(StateArchive& archive) {
    archive.group("body", [&] {
        archive.same("firstKind", static_cast<std::uint32_t>(bodyAtSetUp.kind));
        archive.same("firstInertia", bodyAtSetUp.inertia, "kg or kg m^2");
        archive.same("firstLoad", bodyAtSetUp.load, "N or N m");
        archive.same("firstFriction", bodyAtSetUp.friction, "N or N m");
        archive.same("firstLargestSpeed", bodyAtSetUp.largestSpeed, "m/s or rad/s");
        archive.sameRecord<double>("firstForce", bodyAtSetUp.force);
        archive.sameRecord<double>("firstTorque", bodyAtSetUp.torque);
        bool isBody = bodily.has_value();
        archive.value("isBody", isBody);
        if (archive.isReading() && !isBody) bodily.reset();
        if (!isBody) return;
        if (!bodily) bodily.emplace();
        bodily->visitState(archive);
    });
}

}  // namespace pendular
