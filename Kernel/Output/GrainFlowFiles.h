#pragma once

#include "Kernel/Boundaries/FluxPlane.h"
#include "Kernel/Boundaries/Outlet.h"
#include "Kernel/Insertion/Inlet.h"
#include "Kernel/Output/TimedTable.h"

namespace pendular {

/// What the tables below share: a table over time, given to Simulation::addOutput(). Rows is a class with the
/// ending of the file's name, the header, and what writes the rows of one time.
template <class Rows>
class GrainFlowFile {
public:
    /// @param time s, from one of the outputs to the next; 0: whenever outputs are due
    explicit GrainFlowFile(double time = 0) : table(Rows::name, Rows::ending, time) {}

    [[nodiscard]] OutputInterval interval() const { return table.interval(); }
    template <class Scene>
    void write(const Scene& scene) {
        const double time = scene.getTime();
        if (table.has(time)) return;
        Rows::write(scene,
                    [&](const auto&... values) { table.of(scene, Rows::header).row(time, values...); });
        table.wroteAt(time);
    }
    template <class Scene>
    void complete(const Scene& scene) {
        table.of(scene, Rows::header).close();
    }
    template <class Scene>
    void visitState(StateArchive& archive, const Scene& scene) {
        table.visitState(archive, scene, Rows::header);
    }

private:
    TimedTable table;
};

/// NAME-inlets.csv: what has come, and what was lost for want of room, in the unit of the inlet's flow.
struct InletRows {
    static constexpr const char *name = "InletFile", *ending = "-inlets.csv",
                                *header = "time_s,inlet,number,mass_kg,lost";
    template <class Scene, class Row>
    static void write(const Scene& scene, Row&& row) {
        for (std::size_t k = 0; k < scene.inletHandler.getSize(); ++k) {
            const InletCount& count = scene.inletHandler.count(k);
            row(k, count.number, count.mass, count.lost);
        }
    }
};
using InletFile = GrainFlowFile<InletRows>;

/// NAME-outlets.csv: what has gone through each outlet since the start, by species and class of size.
struct OutletRows {
    static constexpr const char *name = "OutletFile", *ending = "-outlets.csv",
                                *header =
                                    "time_s,outlet,species,diameter_from_m,diameter_to_m,number,mass_kg";
    template <class Scene, class Row>
    static void write(const Scene& scene, Row&& row) {
        for (std::size_t k = 0; k < scene.outletHandler.getSize(); ++k) {
            const GrainTally& tally = scene.outletHandler.tally(k);
            for (std::size_t s = 0; s < scene.laws().speciesCount(); ++s)
                for (std::size_t c = 0; c < tally.classCount(); ++c) {
                    const GrainTally::Entry entry = tally.of(s, c);
                    row(k, s, tally.lowest(c), tally.highest(c), entry.number, entry.mass);
                }
        }
    }
};
using OutletFile = GrainFlowFile<OutletRows>;

/// NAME-flux.csv: what has gone through each flux plane since the start, both ways; the momentum is that
/// forwards less that backwards.
struct FluxRows {
    static constexpr const char *name = "FluxFile", *ending = "-flux.csv",
                                *header =
                                    "time_s,plane,forwards,backwards,mass_forwards_kg,mass_backwards_kg,"
                                    "momentum_x_kg_m_per_s,momentum_y_kg_m_per_s,momentum_z_kg_m_per_s,"
                                    "liquid_forwards_m3,liquid_backwards_m3";
    template <class Scene, class Row>
    static void write(const Scene& scene, Row&& row) {
        for (std::size_t k = 0; k < scene.fluxPlaneHandler.getSize(); ++k) {
            const FluxCount& count = scene.fluxPlaneHandler.count(k);
            const Vec3D momentum = count.netMomentum();
            row(k, count.forwards, count.backwards, count.massForwards, count.massBackwards, momentum.x(),
                momentum.y(), momentum.z(), count.liquidForwards, count.liquidBackwards);
        }
    }
};
using FluxFile = GrainFlowFile<FluxRows>;

}  // namespace pendular
