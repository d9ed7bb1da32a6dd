#include "Kernel/Core/Walls/Wall.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Features/MovingWalls/PlaneDrive.h"
#include "Kernel/Features/MovingWalls/WallBody.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

bool Wall::getDistanceAndNormal(const SphericalParticle& grain, double& distance, Vec3D& normal) const {
    const Vector<double> centre = toVector(grain.getPosition());
    const double radius = grain.getRadius();
    checkValue("SphericalParticle", "radius", radius, "m", radiusRange);
    std::vector<std::uint32_t> parts;
    listParts(centre, radius, parts);
    std::vector<WallPoint> points(parts.size());
    if (!parts.empty()) findPoints(centre, radius, parts, points);
    const auto nearest = std::ranges::min_element(points, {}, &WallPoint::distance);
    if (nearest == points.end() || !(nearest->distance < radius)) return false;
    distance = nearest->distance;
    normal = toEigen(nearest->normal);
    return true;
}

void Wall::keepForces(bool keep, const Vec3D& about) {
    const Vector<double> point = checkedVector("Wall", "point of the torque", about, "m");
    forcesKept = keep;
    // A wall that is moved by its force keeps it.
    if (isMovedByForces()) kept = {kept.force, kept.torque + cross(kept.about - point, kept.force), point};
    else kept = {.about = point};
}

void Wall::refuseForces(std::string_view call) {
    throw InputError(fmt::format(
        "A wall's {} needs the forces on it, which are not summed unless keepForces() is called, of "
        "the wall or of the wallHandler, before the step.",
        call));
}

void Wall::setForce(const Vector<double>& force, const Vector<double>& torque, std::uint64_t touches) {
    kept = {force, torque, kept.about};
    if (PlaneDrive* const driven = drive()) driven->touches = touches, driven->forcesAreOld = false;
    if (WallBody* const moved = body()) moved->touches = touches, moved->forcesAreOld = false;
}

void Wall::loseForce(const Vector<double>& force) {
    const auto lose = [&](auto* moved) {
        if (!moved) return;
        kept.force -= force;
        if (moved->touches > 0) --moved->touches;
        moved->forcesAreOld = true;
    };
    lose(drive());
    lose(body());
}

void Wall::visitState(StateArchive& archive) {
    archive.same("species", species);
    const Vector<double> about = kept.about;
    archive.finite("force", kept);
    // As this scene has it; the contacts give the sums again.
    if (kept.about != about) kept.torque += cross(kept.about - about, kept.force);
    kept.about = about;
}

}  // namespace pendular
