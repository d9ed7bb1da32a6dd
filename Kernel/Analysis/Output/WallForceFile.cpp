#include "Kernel/Analysis/Output/WallForceFile.h"

#include "Kernel/Core/Walls/Wall.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {
namespace {

constexpr const char* headerOfWallForces =
    "time_s,wall,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm";

}  // namespace

WallForceFile::WallForceFile(double time) : table("WallForceFile", "-wall-forces.csv", time) {}

void WallForceFile::prepare(Scene& scene) const { scene.wallHandler.keepForces(); }

void WallForceFile::write(Scene& scene) {
    const double time = scene.getTime();
    if (table.has(time)) return;
    for (const auto& [number, wall] : scene.wallHandler.present()) {
        const Vec3D force = wall->getForce(), torque = wall->getTorque();
        table.of(scene, headerOfWallForces)
            .row(time, number, force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z());
    }
    table.wroteAt(time);
}

void WallForceFile::complete(const Scene& scene) { table.of(scene, headerOfWallForces).close(); }

void WallForceFile::visitState(StateArchive& archive, const Scene& scene) {
    table.visitState(archive, scene, headerOfWallForces);
}

}  // namespace pendular
