#include "Kernel/Analysis/Output/GrainFlowFiles.h"

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Features/FluxPlanes/FluxPlane.h"
#include "Kernel/Features/Inlets/Inlet.h"
#include "Kernel/Features/Outlets/GrainTally.h"
#include "Kernel/Features/Outlets/Outlet.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

struct InletRows {
    static constexpr const char *name = "InletFile", *ending = "-inlets.csv",
                                *header = "time_s,inlet,number,mass_kg,lost";
    template <class Row>
    static void write(const Scene& scene, Row&& row) {
        for (std::size_t k = 0; k < scene.inletHandler.getSize(); ++k) {
            const InletCount& count = scene.inletHandler.countOf(k);
            row(k, count.number, count.mass, count.lost);
        }
    }
};

struct OutletRows {
    static constexpr const char *name = "OutletFile", *ending = "-outlets.csv",
                                *header =
                                    "time_s,outlet,species,diameter_from_m,diameter_to_m,number,mass_kg";
    template <class Row>
    static void write(const Scene& scene, Row&& row) {
        for (std::size_t k = 0; k < scene.outletHandler.getSize(); ++k) {
            const GrainTally& tally = scene.outletHandler.countOf(k);
            for (std::size_t s = 0; s < scene.laws().speciesCount(); ++s)
                for (std::size_t c = 0; c < tally.classCount(); ++c) {
                    const GrainTally::Entry entry = tally.of(s, c);
                    row(k, s, tally.lowest(c), tally.highest(c), entry.number, entry.mass);
                }
        }
    }
};

struct FluxRows {
    static constexpr const char *name = "FluxFile", *ending = "-flux.csv",
                                *header =
                                    "time_s,plane,forwards,backwards,mass_forwards_kg,mass_backwards_kg,"
                                    "momentum_x_kg_m_per_s,momentum_y_kg_m_per_s,momentum_z_kg_m_per_s,"
                                    "liquid_forwards_m3,liquid_backwards_m3";
    template <class Row>
    static void write(const Scene& scene, Row&& row) {
        for (std::size_t k = 0; k < scene.fluxPlaneHandler.getSize(); ++k) {
            const FluxCount& count = scene.fluxPlaneHandler.countOf(k);
            const Vec3D momentum = count.netMomentum();
            row(k, count.forwards, count.backwards, count.massForwards, count.massBackwards, momentum.x(),
                momentum.y(), momentum.z(), count.liquidForwards, count.liquidBackwards);
        }
    }
};

template <class Rows>
GrainFlowFile<Rows>::GrainFlowFile(double time) : table(Rows::name, Rows::ending, time) {}

template <class Rows>
void GrainFlowFile<Rows>::write(const Scene& scene) {
    const double time = scene.getTime();
    if (table.has(time)) return;
    Rows::write(scene, [&](const auto&... values) { table.of(scene, Rows::header).row(time, values...); });
    table.wroteAt(time);
}

template <class Rows>
void GrainFlowFile<Rows>::complete(const Scene& scene) {
    table.of(scene, Rows::header).close();
}

template <class Rows>
void GrainFlowFile<Rows>::visitState(StateArchive& archive, const Scene& scene) {
    table.visitState(archive, scene, Rows::header);
}

template class GrainFlowFile<InletRows>;
template class GrainFlowFile<OutletRows>;
template class GrainFlowFile<FluxRows>;

}  // namespace pendular
