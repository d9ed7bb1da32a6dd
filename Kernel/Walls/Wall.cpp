#include "Kernel/Walls/Wall.h"

#include "Kernel/State/StateArchive.h"
#include "Kernel/Walls/PlaneDrive.h"
#include "Kernel/Walls/WallBody.h"

namespace pendular {

void Wall::keepForces(bool keep, const Vec3D& about) {
    forcesKept = keep;
    // A wall that is moved by its force keeps it.
    const Vector<double> point = toVector(about);
    if (isMovedByForces()) kept = {kept.force, kept.torque + cross(kept.about - point, kept.force), point};
    else kept = {.about = point};
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
