#include "Kernel/Features/MovingWalls/WallBody.h"

#include <algorithm>

#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

bool WallBodySettings::movesAs(const WallBodySettings& other) const {
    return kind == other.kind && axis == other.axis && centre == other.centre &&
           (kind != WallBodySettings::Kind::Free ||
            (isAsHeavyAs(other) && axes.real == other.axes.real && axes.imaginary == other.axes.imaginary));
}

bool WallBodySettings::isAsHeavyAs(const WallBodySettings& other) const {
    return inertia == other.inertia && moments == other.moments && reach == other.reach;
}

RigidVelocity WallBody::velocityAt(double speedThen) const {
    if (turns()) return {{0, 0, 0}, speedThen * asked.axis, asked.centre};
    return {speedThen * asked.axis, {0, 0, 0}, asked.centre};
}

RigidVelocity WallBody::velocity() const {
    return isFree() ? RigidVelocity{free.velocity, free.spin(), free.position} : velocityAt(speed);
}

Pose WallBody::poseFrom(const Pose& origin) const {
    if (asked.kind == WallBodySettings::Kind::Rotor)
        return Pose::turnedAbout(asked.axis, asked.centre, way).after(origin);
    if (asked.kind == WallBodySettings::Kind::Slider) {
        Pose pose = origin;
        pose.shift += way * asked.axis + carried;
        return pose;
    }
    const Axes<double> inSpace(free.orientation), inWall(asked.axes);
    Pose pose;
    for (int k = 0; k < 3; ++k) {
        const Vector<double> unit{k == 0 ? 1. : 0., k == 1 ? 1. : 0., k == 2 ? 1. : 0.};
        pose.column[k] = inSpace.turn(inWall.turnBack(unit));
    }
    pose.shift = free.position - pose.turn(asked.centre);
    return pose;
}

double WallBody::kineticEnergy() const {
    if (!isFree()) return 0.5 * asked.inertia * speed * speed;
    return 0.5 * free.mass * squaredNorm(free.velocity) + free.rotationalEnergy();
}

double WallBody::turningMobility() const {
    if (asked.kind == WallBodySettings::Kind::Slider) return 0;
    return 1 / (isFree() ? std::min({asked.moments.x, asked.moments.y, asked.moments.z}) : asked.inertia);
}

double WallBody::mobility() const {
    const double ofCentre = asked.kind == WallBodySettings::Kind::Rotor ? 0 : 1 / asked.inertia;
    return ofCentre + asked.reach * asked.reach * turningMobility();
}

void WallBody::visitState(StateArchive& archive) {
    auto kind = static_cast<std::uint32_t>(asked.kind);
    archive.value("kind", kind);
    archive.require(kind >= 1 && kind <= static_cast<std::uint32_t>(WallBodySettings::Kind::Free), "kind",
                    "is none that there is");
    asked.kind = static_cast<WallBodySettings::Kind>(kind);
    archive.finite("axis", asked.axis);
    archive.finite("load", asked.load);
    archive.finite("friction", asked.friction);
    archive.value("largestSpeed", asked.largestSpeed);
    archive.require(asked.largestSpeed > 0 && asked.friction >= 0, "largestSpeed",
                    "is not positive, or the friction negative");
    archive.finite("inertia", asked.inertia);
    archive.require(asked.inertia > 0, "inertia", "is not positive");
    archive.finite("centre", asked.centre);
    archive.finite("reach", asked.reach);
    archive.finite("moments", asked.moments);
    archive.require(!isFree() || std::min({asked.moments.x, asked.moments.y, asked.moments.z}) > 0, "moments",
                    "are not positive");
    archive.finite("axes", asked.axes);
    archive.finite("force", asked.force);
    archive.finite("torque", asked.torque);
    archive.finite("speed", speed);
    archive.finite("way", way);
    archive.finite("earlier", earlier);
    archive.finite("across", across);
    archive.finite("carried", carried);
    archive.finite("free", free);
    archive.finite("earlierAcceleration", earlierAcceleration);
    archive.finite("earlierTorque", earlierTorque);
    archive.value("steps", steps);
    archive.value("touches", touches);
    archive.value("mostTouches", mostTouches);
}

}  // namespace pendular
