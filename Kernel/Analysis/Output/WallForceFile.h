#pragma once

#include "Kernel/Analysis/Output/TimedTable.h"

namespace pendular {

/// NAME-wall-forces.csv: the forces of the grains on each wall of a scene over time, and their torques, about
/// the origin unless the driver has given keepForces() another point. Given to Simulation::addOutput(). All
/// walls keep their forces, also those that are added during the run. A scene without walls gets no file.
class WallForceFile {
public:
    /// @param time s, from one of the outputs to the next; 0: whenever outputs are due
    explicit WallForceFile(double time = 0);

    [[nodiscard]] OutputInterval interval() const { return table.interval(); }
    void prepare(Scene& scene) const;
    void write(Scene& scene);
    void complete(const Scene& scene);
    void visitState(StateArchive& archive, const Scene& scene);

private:
    TimedTable table;
};

}  // namespace pendular
