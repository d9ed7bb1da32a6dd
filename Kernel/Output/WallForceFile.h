#pragma once

#include "Kernel/Output/TimedTable.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

/// NAME-wall-forces.csv: the forces of the grains on each wall of a scene over time, and their torques, about
/// the origin unless the driver has given keepForces() another point. Given to Simulation::addOutput(). All
/// walls keep their forces; one that is added during the run does from the next output on, in which it has no
/// row. A scene without walls gets no file.
class WallForceFile {
public:
    /// @param time s, from one of the outputs to the next; 0: whenever outputs are due
    explicit WallForceFile(double time = 0) : table("WallForceFile", "-wall-forces.csv", time) {}

    [[nodiscard]] OutputInterval interval() const { return table.interval(); }
    template <class Scene>
    void prepare(Scene& scene) const {
        keepAll(scene.wallHandler);
    }

    template <class Scene>
    void write(Scene& scene) {
        const double time = scene.getTime();
        if (table.has(time)) return;
        for (std::size_t w = 0; w < scene.wallHandler.getSize(); ++w) {
            const Wall& wall = scene.wallHandler.getObject(w);
            if (!wall.keepsForces()) continue;
            const Vec3D force = wall.getForce(), torque = wall.getTorque();
            table.of(scene, header)
                .row(time, w, force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z());
        }
        keepAll(scene.wallHandler);
        table.wroteAt(time);
    }
    template <class Scene>
    void complete(const Scene& scene) {
        table.of(scene, header).close();
    }

    template <class Scene>
    void visitState(StateArchive& archive, Scene& scene) {
        table.visitState(archive, scene, header);
    }

private:
    static void keepAll(WallHandler& walls) {
        for (std::size_t w = 0; w < walls.getSize(); ++w) {
            Wall& wall = walls.getObject(w);
            if (!wall.keepsForces()) wall.keepForces(true, wall.getTorquePoint());
        }
    }

    static constexpr const char* header =
        "time_s,wall,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm";

    TimedTable table;
};

}  // namespace pendular
