#include "Kernel/Core/Walls/RigidWall.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

constexpr Range finiteRange{-infinity, infinity, false, false};
/// s, between the poses of which velocities are differences. A power of two, so that times are not rounded.
constexpr double differenceInterval = 0x1p-24;

/// The part of a velocity that is along a surface with this normal: the rest would do work on grains that the
/// surface, which stays where it is, cannot do.
template <Number T>
Vector<T> alongSurface(const Vector<T>& velocity, const Vector<T>& normal) {
    return velocity - dot(velocity, normal) * normal;
}

std::string shownPoint(const Vector<double>& v) { return fmt::format("({}, {}, {})", v.x, v.y, v.z); }

}  // namespace

Vector<double> checkedVector(std::string_view owner, std::string_view field, const Vec3D& vector,
                             std::string_view unit) {
    for (int axis = 0; axis < 3; ++axis) checkValue(owner, field, vector[axis], unit, finiteRange);
    return toVector(vector);
}

Vector<double> checkedDirection(std::string_view owner, std::string_view field, const Vec3D& direction) {
    const double largest = direction.cwiseAbs().maxCoeff(), length = direction.norm();
    // Squares of very large and very small numbers are out of range, though directions are not.
    if (direction.allFinite() && largest > 0 && !(length > 1e-150 && length < infinity))
        return toVector(Vec3D(direction / largest).normalized());
    checkValue(owner, field, length, "", positive);
    return toVector(direction.normalized());
}

Vector<double> anyAcross(const Vector<double>& d) {
    const Vector<double> other = std::abs(d.x) < 0.6 ? Vector<double>{1, 0, 0} : Vector<double>{0, 1, 0};
    const Vector<double> across = cross(d, other);
    return (1 / norm(across)) * across;
}

Pose::Pose(const Eigen::Isometry3d& pose) : shift(toVector(pose.translation())) {
    for (int k = 0; k < 3; ++k) column[k] = toVector(pose.linear().col(k));
}

Pose Pose::turnedAbout(const Vector<double>& axis, const Vector<double>& point, double angle) {
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
    turn.linear() = Eigen::AngleAxisd(angle, toEigen(axis)).toRotationMatrix();
    Pose pose(turn);
    pose.shift = point - pose.turn(point);
    return pose;
}

double SurfaceExtent::displacement(const Pose& from, const Pose& to) const {
    double turned = 0;  // m/m, the farthest shift of a unit vector
    if (symmetry == Symmetry::None) {
        for (int k = 0; k < 3; ++k) turned += squaredNorm(to.column[k] - from.column[k]);
        turned = std::sqrt(0.5 * turned);
    } else {
        turned = norm(to.turn(axis) - from.turn(axis));
    }
    // Less than this in a step is the round-off of a turn about the surface's own axis; 10^6 steps of it are
    // 10^-8 rad.
    if (turned < 1e-14) turned = 0;
    const Vector<double> shift = to.place(centre) - from.place(centre);
    const Vector<double> along = dot(shift, to.turn(axis)) * to.turn(axis);
    const double carried = symmetry == Symmetry::Cylinder ? norm(shift - along)
                           : symmetry == Symmetry::Plane  ? norm(along)
                                                          : norm(shift);
    if (turned == 0) return carried;
    double way = turned * radius;
    if (symmetry == Symmetry::None && norm(half) > 0) {
        // No point goes farther than a corner of the box, which is less where a long mesh turns about its
        // length.
        const Vector<double> x = half.x * (to.column[0] - from.column[0]),
                             y = half.y * (to.column[1] - from.column[1]),
                             z = half.z * (to.column[2] - from.column[2]);
        const double corner = std::max({norm(x + y + z), norm(x + y - z), norm(x - y + z), norm(x - y - z)});
        way = std::min(way, (1 + 1e-12) * corner);
    }
    return carried + way;
}

void RigidWall::takePlace() {
    if (isInRun())
        throw InputError(
            "Wall: its place and shape cannot be set again in a run, where it would jump; move it by "
            "setVelocity(), setAngularVelocity() or setMotion(), or remove it and add another one.");
    if (bodily)
        throw InputError(
            "Wall: its shape is set after setSlider(), setRotor() or setFreeBody(), which count with it; set "
            "the shape first.");
    repeat({0, 0, 0});  // the scene looks at the new shape
    given = true;
}

void RigidWall::beginSteadyMotion() {
    if (isMovedByForces()) {
        steady = velocity;
        if (drive()) steady.point = pose.shift;
        endDrive();
        bodily.reset();
    } else if (isInRun() && !followsFunction) {
        steady = velocityAt(now);
    }
    if (isInRun()) {
        began = now;
        origin = pose;
    }
    followsFunction = false;
    atRest = false;
}

void RigidWall::setVelocity(const Vec3D& value) {
    const Vector<double> linear = checkedVector("Wall", "velocity", value, "m/s");
    beginSteadyMotion();
    steady.linear = linear;
    noteSetUp();
    placeAt(began);
}

void RigidWall::setAngularVelocity(const Vec3D& spin, const Vec3D& point) {
    const Vector<double> turning = checkedVector("Wall", "angular velocity", spin, "rad/s"),
                         through = checkedVector("Wall", "point of the angular velocity", point, "m");
    beginSteadyMotion();
    steady.spin = turning;
    steady.point = through;
    noteSetUp();
    placeAt(began);
}

void RigidWall::setMotion(std::function<Eigen::Isometry3d(double)> poseOfTime) {
    if (!poseOfTime) throw InputError("Wall: the function of the motion is empty.");
    motion = std::move(poseOfTime);
    endDrive();
    bodily.reset();
    followsFunction = true;
    steady = {};
    noteSetUp();
    atRest = false;
    const double time = isInRun() ? now : 0;
    origin = isInRun() ? displacementAt(time).inverse().after(pose) : Pose();
    placeAt(time);
}

Vector<double> RigidWall::beginDrive() {
    if (norm(velocity.spin) > 0)
        throw InputError(
            "Wall: it turns, so that it cannot be moved by forces along its normal; stop it first.");
    const Vector<double> linear = velocity.linear;
    bodily.reset();
    followsFunction = false;
    atRest = false;
    steady = {};
    shifted = 0;
    return linear;
}

void RigidWall::goOn(const Vector<double>& shift) {
    pose.shift += shift;
    shifted = norm(shift);
}

void RigidWall::showVelocity(const Vector<double>& linear) { velocity = {linear, {0, 0, 0}, pose.shift}; }

void RigidWall::takeBack(const Pose& before, const Vector<double>& linear) {
    pose = before;
    shifted = 0;
    showVelocity(linear);
}

void RigidWall::setSurfaceVelocity(const Vec3D& value) {
    surfaceVelocity = checkedVector("Wall", "surface velocity", value, "m/s");
    if (!isInRun()) surfaceVelocityAtSetUp = surfaceVelocity;
}

/// The motion that a scene which goes on must set as well. The run may give the wall another one later.
void RigidWall::noteSetUp() {
    if (!isInRun()) steadyAtSetUp = steady;
}

void RigidWall::compareMotionAtSetUp(StateArchive& archive) const {
    archive.sameRecord<double>("firstVelocity", steadyAtSetUp.linear, "m/s");
    archive.sameRecord<double>("firstAngularVelocity", steadyAtSetUp.spin, "rad/s");
    if (norm(steadyAtSetUp.spin) > 0)
        archive.sameRecord<double>("firstPointOfTurning", steadyAtSetUp.point, "m");
    archive.sameRecord<double>("firstSurfaceVelocity", surfaceVelocityAtSetUp, "m/s");
}

Vec3D RigidWall::getVelocityAt(const Vec3D& point) const {
    return toEigen(velocity.at(toVector(point)) + pose.turn(surfaceVelocity));
}

Eigen::Isometry3d RigidWall::askedPose(double time) const {
    const Eigen::Isometry3d asked = motion(time);
    const double error = (asked.linear() * asked.linear().transpose() - Eigen::Matrix3d::Identity()).norm();
    constexpr double farthest = 1e100;  // m: squares of distances and speeds are finite numbers
    if (!(error < 1e-9) || !(asked.linear().determinant() > 0) ||
        !(asked.translation().array().abs() <= farthest).all())
        throw InputError(fmt::format(
            "Wall: the function of the motion gives no rigid pose within {:g} m at time {:.6g} s.", farthest,
            time));
    return asked;
}

Pose RigidWall::displacementAt(double time) const {
    if (followsFunction) return Pose(askedPose(time));
    const double elapsed = time - began;
    const Vec3D spin = toEigen(steady.spin), point = toEigen(steady.point);
    const double rate = spin.norm();
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    if (rate > 0) result.linear() = Eigen::AngleAxisd(rate * elapsed, spin / rate).toRotationMatrix();
    result.translation() = point - result.linear() * point + elapsed * toEigen(steady.linear);
    return Pose(result);
}

RigidVelocity RigidWall::velocityAt(double time) const {
    if (!followsFunction) return {steady.linear, steady.spin, steady.point + (time - began) * steady.linear};
    return askedVelocity(time);
}

/// The derivative of the pose by five of its values, of fourth order (Fornberg (1988), Math. Comp. 51, 699,
/// Tables 1 and 3): around the time, or from it on where that would ask for a time below 0. Of a vibration
/// with the angular frequency w the relative error is (w h)^4 / 30, or (w h)^4 / 5. The sum of the weights
/// is 3/2 (32/3): by as many times epsilon/2 / h, with the lengths (m) of which the pose is made, its
/// round-off enters.
RigidVelocity RigidWall::askedVelocity(double time) const {
    constexpr double h = differenceInterval;
    constexpr std::array<double, 5> around{1. / 12, -2. / 3, 0, 2. / 3, -1. / 12},
        from{-25. / 12, 4, -3, 4. / 3, -1. / 4};
    const bool isAround = time >= 2 * h;
    Eigen::Matrix4d change = Eigen::Matrix4d::Zero();  // 1/s, and m/s
    for (int k = 0; k < 5; ++k)
        change += (isAround ? around : from)[static_cast<std::size_t>(k)] / h *
                  askedPose(time + (isAround ? k - 2 : k) * h).matrix();
    const Eigen::Matrix3d ofTurn = change.topLeftCorner<3, 3>();
    const Eigen::Vector3d point = toEigen(origin.shift);  // which is at pose.shift now
    const Eigen::Vector3d linear = ofTurn * point + change.topRightCorner<3, 1>();
    const Eigen::Matrix3d turn = ofTurn * askedPose(time).linear().transpose();  // spin x, as a matrix
    const Eigen::Vector3d spin(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return {toVector(linear), toVector(Eigen::Vector3d(0.5 * spin)), pose.shift};
}

void RigidWall::visitState(StateArchive& archive) {
    bool hasMoved = isInRun();  // not where a wall was added in this step
    double lastMoved = hasMoved ? now : 0;
    Wall::visitState(archive);
    visitShape(archive);
    archive.same(
        "hasMotionFunction", static_cast<bool>(motion), {},
        "a scene that goes on gives a wall its function by setMotion() when it is set up, also where "
        "the wall got it during the run, and gives none to a wall that had none");
    compareMotionAtSetUp(archive);
    archive.value("followsFunction", followsFunction);
    archive.require(motion || !followsFunction, "followsFunction", "is 1, and there is no function");
    archive.value("atRest", atRest);
    archive.value("hasMoved", hasMoved);
    archive.finite("lastMoved", lastMoved);
    archive.finite("motionBegan", began);
    archive.finite("motionOrigin", origin);
    archive.finite("steadyMotion", steady);
    archive.finite("surfaceVelocity", surfaceVelocity);
    archive.finite("pose", pose);
    archive.finite("velocity", velocity);
    visitBody(archive);
    now = hasMoved ? lastMoved : unset;
    if (archive.isReading() && isInRun() && followsFunction) requireSameMotion(archive);
}

/// The function gives what the file holds: bit for bit on the same machine. On another one its sines may
/// differ in their last digits, and its phases by the rounding of 10^6 rad: 1e-10, for poses of about 1 m by
/// less than 1e-9 m. Velocities differ by as much of them, and by round-off as in askedVelocity(): 2e-8 m/s.
void RigidWall::requireSameMotion(const StateArchive& archive) const {
    const auto require = [&](std::string_view name, const Vector<double>& kept, const Vector<double>& asked,
                             double error, std::string_view unit) {
        archive.requireSame(norm(kept - asked) <= error * (1 + norm(kept)), name, shownPoint(kept),
                            shownPoint(asked), unit,
                            "a run goes on with the function of setMotion() that it had");
    };
    const Pose asked = displacementAt(now).after(origin);
    require("pose", pose.shift, asked.shift, 1e-9, "m");
    for (int k = 0; k < 3; ++k) require("pose", pose.column[k], asked.column[k], 1e-9, "");
    const RigidVelocity askedNow = velocityAt(now);
    require("velocity", velocity.linear, askedNow.linear, 1e-7, "m/s");
    require("velocity", velocity.spin, askedNow.spin, 1e-7, "rad/s");
}

void RigidWall::join(double time) {
    if (!atRest && !isMovedByForces()) {
        began = time;
        if (followsFunction) origin = displacementAt(time).inverse().after(pose);
        placeAt(time);
    }
    now = time;
}

double RigidWall::moveTo(double time) {
    now = time;
    if (isMovedByForces()) return takeShapeShift() + shifted;
    return takeShapeShift() + (atRest ? 0 : placeAt(time));
}

/// Returns how far (m) any point of the surface has moved.
double RigidWall::placeAt(double time) {
    const Pose last = pose;
    pose = displacementAt(time).after(origin);
    velocity = velocityAt(time);
    return given ? extent().displacement(last, pose) : 0;
}

std::optional<PlaneAtRest> RigidWall::planeAtRest() const {
    const std::optional<HalfSpace> plane = atRest ? planeInBody() : std::nullopt;
    if (!plane) return {};
    return PlaneAtRest{*plane, alongSurface(surfaceVelocity, plane->normal)};
}

void RigidWall::listOwn(const Vector<double>& centre, double reach, std::vector<std::uint32_t>& parts) const {
    listInBody(atRest ? centre : pose.placeBack(centre), reach, parts);
}

void RigidWall::findOwn(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                        std::span<WallPoint> points) const {
    if (atRest) {
        findInBody(centre, reach, parts, points);
        for (WallPoint& point : points) point.velocity = alongSurface(surfaceVelocity, point.normal);
        return;
    }
    findInBody(pose.placeBack(centre), reach, parts, points);
    const Vector<double> belt = pose.turn(surfaceVelocity);
    for (WallPoint& point : points) {
        point.normal = pose.turn(point.normal);
        const double distance = std::isfinite(point.distance) ? point.distance : 0;
        point.velocity = velocity.at(centre + distance * point.normal) + alongSurface(belt, point.normal);
    }
}

/// The steps of findOwn().
void RigidWall::findEight(const Vector<Pack>& centres, const std::array<std::uint32_t, Pack::lanes>& parts,
                          EightWallPoints& points) const {
    if (atRest) {
        findEightInBody(centres, parts, points);
        points.velocity = alongSurface(inAllLanes<Pack>(surfaceVelocity), points.normal);
        return;
    }
    findEightInBody(pose.placeBack(centres), parts, points);
    points.normal = pose.turn(points.normal);
    const Pack distance = select(points.distance < Pack(infinity), points.distance, Pack(0));
    points.velocity = velocity.at(centres + distance * points.normal) +
                      alongSurface(inAllLanes<Pack>(pose.turn(surfaceVelocity)), points.normal);
}

bool RigidWall::isOwnCrossed(const Vector<double>& from, const Vector<double>& to) const {
    return atRest ? isCrossedInBody(from, to) : isCrossedInBody(pose.placeBack(from), pose.placeBack(to));
}

SurroundingBox RigidWall::surroundings() const {
    const SurfaceExtent own = extent();
    SurroundingBox box{.middle = pose.place(own.centre)};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector<double>& column = pose.column[k];
        const double half = k == 0 ? own.half.x : k == 1 ? own.half.y : own.half.z;
        box.half += half * Vector<double>{std::abs(column.x), std::abs(column.y), std::abs(column.z)};
    }
    return box;
}

SurfaceAtFaces RigidWall::atFaces(const PeriodicFaces& faces) const {
    const SurfaceExtent own = extent();
    const Vector<double> centre = pose.place(own.centre), axis = pose.turn(own.axis);
    if (own.symmetry == SurfaceExtent::Symmetry::Plane) return planeAtFaces(axis, centre, faces);
    if (own.symmetry == SurfaceExtent::Symmetry::Cylinder)
        return cylinderAtFaces(axis, centre, own.radius, faces);
    const double middle = dot(faces.along, centre);
    const SurfaceAtFaces found = intervalAtFaces(middle - own.radius, middle + own.radius, faces);
    return found.passes ? SurfaceAtFaces{.passes = true} : found;
}

WallSurface RigidWall::surface(const SceneSphere& around) const {
    return surfaceInBody({pose.placeBack(around.centre), around.radius}).placed(pose);
}

}  // namespace pendular
