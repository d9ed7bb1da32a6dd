#pragma once

#include "Kernel/Output/CsvFile.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

/// The forces on walls over time, as a table: a row for each wall that keeps its forces, each time write() is
/// called.
class WallForceFile {
public:
    /// Throws InputError if the file cannot be written.
    explicit WallForceFile(std::filesystem::path path)
        : file(std::move(path),
               "time_s,wall,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm") {}

    void write(double time, const WallHandler& walls) {
        for (std::size_t w = 0; w < walls.getSize(); ++w) {
            const Wall& wall = walls.getObject(w);
            if (!wall.keepsForces()) continue;
            const Vec3D force = wall.getForce(), torque = wall.getTorque();
            file.row(time, w, force.x(), force.y(), force.z(), torque.x(), torque.y(), torque.z());
        }
    }
    /// Completes the file under its name.
    void close() { file.close(); }

private:
    CsvFile file;
};

}  // namespace pendular
