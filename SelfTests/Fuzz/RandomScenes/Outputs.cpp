// Files that a run writes.
#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/GrainFlowFiles.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/RunSummary.h"
#include "Kernel/Analysis/Output/WallForceFile.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

/// s, some ten times in a run
double intervalOf(Making& making) {
    return making.draw.give("interval", making.draw.even(0.05, 0.4) * making.scales.duration);
}

template <class Frames>
void addFrames(Making& making) {
    auto frames = Frames().withInterval(intervalOf(making)).withContacts(making.draw.oneIn(2));
    if (making.draw.oneIn(2)) frames.withStress();
    if (making.draw.oneIn(3)) frames.withContactPoints();
    if (making.draw.oneIn(3)) frames.withDoubles();
    if (making.draw.oneIn(3))
        frames.addField("distance_m", [&scene = making.scene](std::size_t grain) {
            return scene.particleHandler.getObject(grain).getPosition().norm();
        });
    making.scene.addOutput(frames);
}

void addMercury(Making& making) {
    making.scene.setSaveCount(static_cast<std::size_t>(making.draw.whole(1, 60)));
    making.scene.addOutput(MercuryOutput().withEnergies(making.has("Ledger")));
}

template <class Table>
void addTable(Making& making) {
    if (making.draw.oneIn(2)) return making.scene.addOutput(Table(intervalOf(making)));
    making.scene.setSaveCount(static_cast<std::size_t>(making.draw.whole(1, 60)));
    making.scene.addOutput(Table());
}

void addFlowTables(Making& making) {
    addTable<InletFile>(making), addTable<OutletFile>(making), addTable<FluxFile>(making);
}

/// Points of fields. A wrong spacing may ask for up to 2^28, which Pendular takes; those are left out. A
/// point takes the runs of a scene some 4 us a sample (measured: 2.3 s of 160 000 points), and there are up
/// to 20 samples: a quarter of what judge() grants.
constexpr std::size_t mostPoints = 50'000;

void addFields(Making& making) {
    constexpr std::array<std::string_view, 6> coordinates{"O", "X", "Z", "XZ", "R", "RZ"};
    constexpr std::array shapes{KernelShape::Gauss, KernelShape::Lucy, KernelShape::Heaviside};
    const bool movesImages = making.has("moving images");
    const std::string_view resolved = movesImages
                                          ? making.draw.oneOf(std::array<std::string_view, 2>{"O", "X"})
                                          : making.draw.oneOf(coordinates);
    const FieldGrid grid(resolved, toVector(making.draw.give("lowest", making.lowest)),
                         toVector(making.draw.give("highest", making.highest)),
                         making.draw.give("spacing", making.scales.cell));
    if (grid.size() > mostPoints) return making.draw.note(fmt::format("({} points: left out)", grid.size()));
    FieldOutput fields(grid, making.draw.oneOf(shapes), making.draw.give("width", making.scales.radius));
    fields.withInterval(intervalOf(making));
    if (making.draw.oneIn(2)) fields.averagedOver(making.draw.give("window", 0.5 * making.scales.duration));
    if (making.draw.oneIn(3)) fields.withoutContacts();
    if (making.draw.oneIn(3)) fields.asHdf5();
    making.scene.addOutput(fields);
}

void addSummary(Making& making) { making.scene.addOutput(RunSummary()); }

void addRestartFile(Making& making) {
    making.scene.keepRestartFile();
    making.scene.setRestartCount(static_cast<std::size_t>(making.draw.whole(20, 100)));
}

}  // namespace

std::vector<Feature> outputFeatures() {
    const std::vector<std::string_view> output{"output"};
    return {
        {.name = "ParaView", .share = 0.12, .add = addFrames<ParaViewOutput>, .kinds = output},
        {.name = "Hdf5", .share = 0.05, .add = addFrames<Hdf5Output>, .kinds = {"output", "HDF5"}},
        {.name = "Mercury", .share = 0.1, .add = addMercury, .kinds = output},
        {.name = "EnergyTable", .share = 0.1, .add = addTable<EnergyFile>, .kinds = {"output", "ledger"}},
        {.name = "WallForces",
         .share = 0.15,
         .add = addTable<WallForceFile>,
         .kinds = output,
         .needs = {"wall"}},
        {.name = "FlowTables",
         .share = 0.3,
         .add = addFlowTables,
         .kinds = output,
         .needs = {"inlet", "outlet", "FluxPlane"}},
        {.name = "Fields", .share = 0.1, .add = addFields, .kinds = output},
        {.name = "Summary", .share = 0.08, .add = addSummary, .kinds = output},
        {.name = "RestartFile", .share = 0.06, .add = addRestartFile, .kinds = {"output", "HDF5"}},
    };
}

}  // namespace pendular::fuzz
