#include "Kernel/Walls/Wall.h"

#include "Kernel/State/StateArchive.h"
#include "Kernel/Walls/PlaneDrive.h"

namespace pendular {

void Wall::keepForces(bool keep, const Vec3D& about) {
    forcesKept = keep;
    // A wall that is moved by its force keeps it.
    kept = {.force = drive() ? kept.force : Vector<double>{0, 0, 0}, .about = toVector(about)};
}

void Wall::setForce(const Vector<double>& force, const Vector<double>& torque, std::uint64_t touches) {
    kept = {force, torque, kept.about};
    if (PlaneDrive* const driven = drive()) driven->touches = touches, driven->forcesAreOld = false;
}

void Wall::loseForce(const Vector<double>& force) {
    PlaneDrive* const driven = drive();
    if (!driven) return;
    kept.force -= force;
    if (driven->touches > 0) --driven->touches;
    driven->forcesAreOld = true;
}

void Wall::visitState(StateArchive& archive) {
    archive.same("species", species);
    const Vector<double> about = kept.about;
    archive.finite("force", kept);
    kept.about = about;  // as this scene has it; the contacts give the sums again
}

}  // namespace pendular
