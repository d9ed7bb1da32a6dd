#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/CoarseGraining/GrainState.h"
#include "Kernel/Analysis/Output/Hdf5Series.h"
#include "Kernel/Analysis/Output/ParaViewSeries.h"
#include "Kernel/Core/Run/OutputInterval.h"

namespace pendular {

class RunTable;
class Scene;
class StateArchive;

/// Fields of a scene at points, averaged over time. Given to Simulation::addOutput():
///   addOutput(FieldOutput(FieldGrid("XZ", lowest, highest, 1e-3), KernelShape::Gauss, 1e-3)
///                 .withInterval(1e-3).averagedOver(0.1));
/// The file is, for up to one resolved direction, NAME-FIELDS.csv with the rows of all averages, else
/// NAME-FIELDS.pvd for ParaView; after asHdf5() NAME-FIELDS.h5 for h5py and MATLAB. FIELDS is "coarse" unless
/// another name is given.
class FieldOutput {
public:
    /// @param width m, of the kernel; @param cutOff m; see SmoothingKernel
    FieldOutput(const FieldGrid& grid, KernelShape shape, double width, double cutOff = 0);

    /// A sample at the step nearest to each multiple of this time (s).
    FieldOutput& withInterval(double seconds);
    [[nodiscard]] OutputInterval interval() const { return times; }
    /// Samples of this time (s) make one average; 0, the default: each is one. Infinity: the whole run.
    FieldOutput& averagedOver(double seconds);
    /// Fields of each group of grains as well.
    FieldOutput& withGroups(const GrainGroups& groups);
    /// Takes only fields of the grains themselves: no stress of contacts, traction, fabric, coordination,
    /// liquid. It costs a fifth or less.
    FieldOutput& withoutContacts();
    /// Velocities against the flow of setLeesEdwards(), or of a strain: then velocity is the deviation from
    /// the flow, and the kinetic stress is free of it also where the gradient is averaged over. A scene
    /// whose images do not move refuses it.
    FieldOutput& againstFlow() { return withFlow = false, *this; }
    FieldOutput& withName(const std::string& fields);
    /// Files of the HDF5 library, for any coordinates: a list of averages, each with its fields.
    FieldOutput& asHdf5() { return isHdf5 = true, *this; }

    /// Throws InputError for coordinates that have no meaning in the scene, and for files that cannot be
    /// written.
    void prepare(const Scene& scene) const;
    void write(const Scene& scene);
    void complete(const Scene& scene);
    void visitState(StateArchive& archive, const Scene& scene);

private:
    void refuseFileOfOthers(const std::string& name) const;
    [[nodiscard]] bool isTable() const { return !isHdf5 && sums.grid().dimensions() <= 1; }
    [[nodiscard]] std::string nameOf(const Scene& scene) const;
    RunTable& tableOf(const Scene& scene);
    /// Under the middle of the time that it is of.
    void writeAverage(const Scene& scene);

    FieldSums sums;
    FieldContent content = FieldContent::All;
    bool withFlow = true, isHdf5 = false;
    GrainState state;
    OutputInterval times;
    double window = 0;                   // s
    double first = 0, last = -INFINITY;  // s, of the samples of this average; of the last one
    std::uint64_t firstStep = 0;         // of the first sample, after which a file is named
    double keptUntil = -INFINITY;        // s, of the files of an earlier part of the run
    std::string ending = "-coarse";
    std::shared_ptr<RunTable> table;  // none until the run begins, so that copies made before share nothing
    std::optional<ParaViewSeries> series;
    std::optional<Hdf5Series> frames;
};

}  // namespace pendular
