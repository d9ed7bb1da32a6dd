#include "Kernel/Walls/RigidWall.h"

#include <fmt/format.h>

#include <cmath>

#include "Kernel/InputError.h"

namespace pendular {

namespace {

constexpr Range finiteRange{-infinity, infinity, false, false};
constexpr double differenceInterval = 1e-6;  // s

}  // namespace

Vector<double> checkedVector(std::string_view owner, std::string_view field, const Vec3D& vector,
                             std::string_view unit) {
    for (int axis = 0; axis < 3; ++axis) checkValue(owner, field, vector[axis], unit, finiteRange);
    return toVector(vector);
}

Vector<double> checkedDirection(std::string_view owner, std::string_view field, const Vec3D& direction) {
    checkValue(owner, field, direction.norm(), "", positive);
    return toVector(direction.normalized());
}

Vector<double> anyAcross(const Vector<double>& d) {
    const Vector<double> other = std::abs(d.x) < 0.6 ? Vector<double>{1, 0, 0} : Vector<double>{0, 1, 0};
    const Vector<double> across = cross(d, other);
    return (1 / norm(across)) * across;
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
    return turned == 0 ? carried : carried + turned * radius;
}

void RigidWall::takePlace() {
    if (isInRun())
        throw InputError(
            "Wall: its place and shape cannot be set again in a run, where it would jump; move it by "
            "setVelocity(), setAngularVelocity() or setMotion(), or remove it and add another one.");
    given = true;
}

void RigidWall::beginSteadyMotion() {
    if (isInRun()) {
        if (!followsFunction) steady = velocityAt(now);
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
    placeAt(began);
}

void RigidWall::setAngularVelocity(const Vec3D& spin, const Vec3D& point) {
    const Vector<double> turning = checkedVector("Wall", "angular velocity", spin, "rad/s"),
                         through = checkedVector("Wall", "point of the angular velocity", point, "m");
    beginSteadyMotion();
    steady.spin = turning;
    steady.point = through;
    placeAt(began);
}

void RigidWall::setMotion(std::function<Eigen::Isometry3d(double)> poseOfTime) {
    if (!poseOfTime) throw InputError("Wall: the function of the motion is empty.");
    motion = std::move(poseOfTime);
    followsFunction = true;
    steady = {};
    atRest = false;
    const double time = isInRun() ? now : 0;
    origin = isInRun() ? displacementAt(time).inverse().after(pose) : Pose();
    placeAt(time);
}

void RigidWall::setSurfaceVelocity(const Vec3D& value) {
    surfaceVelocity = checkedVector("Wall", "surface velocity", value, "m/s");
}

Vec3D RigidWall::getVelocityAt(const Vec3D& point) const {
    return toEigen(velocity.at(toVector(point)) + pose.turn(surfaceVelocity));
}

Eigen::Isometry3d RigidWall::askedPose(double time) const {
    const Eigen::Isometry3d asked = motion(time);
    const double error = (asked.linear() * asked.linear().transpose() - Eigen::Matrix3d::Identity()).norm();
    if (!(error < 1e-9) || !(asked.linear().determinant() > 0) || !asked.translation().allFinite())
        throw InputError(
            fmt::format("Wall: the function of the motion gives no rigid pose at time {:.6g} s.", time));
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
    const double h = differenceInterval;
    const Eigen::Isometry3d before = askedPose(time - h), after = askedPose(time + h);
    const Eigen::Vector3d point = toEigen(origin.shift);  // which is at pose.shift now
    const Eigen::Vector3d linear = (after * point - before * point) / (2 * h);
    // The skew part of R(t + h) R(t - h)^T is sin(angle) n; for small angles the angle itself.
    const Eigen::Matrix3d turn = after.linear() * before.linear().transpose();
    const Eigen::Vector3d spin(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return {toVector(linear), toVector(Eigen::Vector3d(spin / (4 * h))), pose.shift};
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
    now = hasMoved ? lastMoved : unset;
}

void RigidWall::join(double time) {
    if (!atRest) {
        began = time;
        if (followsFunction) origin = displacementAt(time).inverse().after(pose);
        placeAt(time);
    }
    now = time;
}

double RigidWall::moveTo(double time) {
    now = time;
    return atRest ? 0 : placeAt(time);
}

/// Returns how far (m) any point of the surface has moved.
double RigidWall::placeAt(double time) {
    const Pose last = pose;
    pose = displacementAt(time).after(origin);
    velocity = velocityAt(time);
    return given ? extent().displacement(last, pose) : 0;
}

void RigidWall::listParts(const Vector<double>& centre, double reach,
                          std::vector<std::uint32_t>& parts) const {
    listInBody(atRest ? centre : pose.placeBack(centre), reach, parts);
}

void RigidWall::findPoints(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                           std::span<WallPoint> points) const {
    if (atRest) {
        findInBody(centre, reach, parts, points);
        for (WallPoint& point : points) point.velocity = surfaceVelocity;
        return;
    }
    findInBody(pose.placeBack(centre), reach, parts, points);
    const Vector<double> belt = pose.turn(surfaceVelocity);
    for (WallPoint& point : points) {
        point.normal = pose.turn(point.normal);
        const double distance = std::isfinite(point.distance) ? point.distance : 0;
        point.velocity = velocity.at(centre + distance * point.normal) + belt;
    }
}

bool RigidWall::isCrossed(const Vector<double>& from, const Vector<double>& to) const {
    return atRest ? isCrossedInBody(from, to) : isCrossedInBody(pose.placeBack(from), pose.placeBack(to));
}

WallSurface RigidWall::surface(const SceneSphere& around) const {
    return surfaceInBody({pose.placeBack(around.centre), around.radius}).placed(pose);
}

}  // namespace pendular
