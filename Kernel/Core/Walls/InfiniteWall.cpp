#include "Kernel/Core/Walls/InfiniteWall.h"

#include <utility>

namespace pendular {

void InfiniteWall::set(const Vec3D& outward, const Vec3D& point) {
    normal = checkedDirection("InfiniteWall", "length of the normal", outward);
    offset = dot(normal, checkedVector("InfiniteWall", "point", point, "m"));
    takePlace();
}

WallSurface InfiniteWall::surfaceInBody(const SceneSphere& around) const {
    const Vector<double> middle = around.centre + gap(around.centre) * normal;
    const Vector<double> a = around.radius * anyAcross(normal), b = cross(normal, a);
    return {{{middle + a + b, middle - a + b, middle - a - b, middle + a - b}}, {{normal, offset}}, true};
}

void InfiniteWall::visitShape(StateArchive& archive) const {
    archive.same("shape", "InfiniteWall");
    archive.sameRecord<double>("normal", normal);
    archive.same("offset", offset, "m");
}

void InfiniteWall::setDrive(const PlaneDriveSettings& asked) {
    const double velocity = driven ? driven->velocity : dot(beginDrive(), drivenNormal());
    if (!driven || driven->asked.kind != asked.kind) {
        driven = PlaneDrive{};
        driven->velocity = driven->servo.speed = velocity;
    }
    const PlaneDriveSettings before = std::exchange(driven->asked, asked);
    // Nothing else is checked: another load needs no new list of contacts.
    if (before.kind != asked.kind || before.mass != asked.mass || before.time != asked.time) {
        driven->mostTouches = 0;
        driven->isChecked = false;
    }
    driven->servo.beginAnew(before.time == asked.time);
    if (!isInRun()) atSetUp = asked;
}

void InfiniteWall::setPiston(double mass, double load) {
    checkValue("InfiniteWall", "mass of the piston", mass, "kg", positive);
    checkValue("InfiniteWall", "load of the piston", load, "N", anyFinite);
    setDrive({.kind = PlaneDriveSettings::Kind::Piston, .load = load, .mass = mass});
}

void InfiniteWall::setTargetForce(double force, double time, double largestSpeed) {
    checkValue("InfiniteWall", "target force", force, "N", notNegative);
    checkValue("InfiniteWall", "time of the target force", time, "s", positive);
    checkValue("InfiniteWall", "largest speed", largestSpeed, "m/s", positive);
    setDrive(
        {.kind = PlaneDriveSettings::Kind::Servo, .load = force, .time = time, .largestSpeed = largestSpeed});
}

void InfiniteWall::visitState(StateArchive& archive) {
    RigidWall::visitState(archive);
    archive.group("drive", [&] {
        archive.same("firstKind", static_cast<std::uint32_t>(atSetUp.kind));
        archive.same("firstLoad", atSetUp.load, "N");
        archive.same("firstMass", atSetUp.mass, "kg");
        archive.same("firstTime", atSetUp.time, "s");
        archive.same("firstLargestSpeed", atSetUp.largestSpeed, "m/s");
        bool isDriven = driven.has_value();
        archive.value("isDriven", isDriven);
        if (archive.isReading() && !isDriven) driven.reset();
        if (!isDriven) return;
        if (!driven) driven.emplace();
        driven->visitState(archive);
    });
}

}  // namespace pendular
