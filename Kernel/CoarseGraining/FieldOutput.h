#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "Kernel/CoarseGraining/FieldFiles.h"
#include "Kernel/CoarseGraining/SceneState.h"
#include "Kernel/Files/FileName.h"
#include "Kernel/Output/Hdf5Output.h"
#include "Kernel/Output/OutputInterval.h"
#include "Kernel/Output/ParaViewSeries.h"
#include "Kernel/Output/RunTable.h"
#include "Kernel/Parts/AdaptiveStep.h"
#include "Kernel/State/RestartFile.h"

namespace pendular {

/// Fields of a scene at points, averaged over time. Given to Simulation::addOutput():
///   addOutput(FieldOutput(FieldGrid("XZ", lowest, highest, 1e-3), KernelShape::Gauss, 1e-3)
///                 .withInterval(1e-3).averagedOver(0.1));
/// For up to one resolved direction NAME-FIELDS.csv with the rows of all averages, else NAME-FIELDS.pvd for
/// ParaView; after asHdf5() NAME-FIELDS.h5 for h5py and MATLAB. FIELDS is "coarse" unless another name is
/// given.
class FieldOutput {
public:
    /// @param width m, of the kernel; @param cutOff m; see SmoothingKernel
    FieldOutput(const FieldGrid& grid, KernelShape shape, double width, double cutOff = 0)
        : sums(grid, SmoothingKernel(shape, grid.dimensions(), width, cutOff)) {}

    /// A sample at the step nearest to each multiple of this time (s).
    FieldOutput& withInterval(double seconds) {
        return times = OutputInterval("FieldOutput", seconds), *this;
    }
    [[nodiscard]] OutputInterval interval() const { return times; }
    /// Samples of this time (s) make one average; 0, the default: each is one. Infinity: the whole run.
    FieldOutput& averagedOver(double seconds) {
        if (!(seconds >= 0))
            throw InputError(fmt::format(
                "FieldOutput: the time of an average is {:g} s; it must be 0 or more, or infinity.",
                seconds));
        return window = seconds, *this;
    }
    /// Fields of each group of grains as well.
    FieldOutput& withGroups(const GrainGroups& groups) {
        return sums = FieldSums(sums.grid(), sums.kernel(), groups, content), *this;
    }
    /// Only fields of the grains themselves: no stress of contacts, traction, fabric, coordination, liquid.
    /// It costs a fifth or less.
    FieldOutput& withoutContacts() {
        content = FieldContent::WithoutContacts;
        return sums = FieldSums(sums.grid(), sums.kernel(), sums.groups(), content), *this;
    }
    /// Velocities against the flow of setLeesEdwards(), or of a strain: then velocity is the deviation from
    /// the flow, and the kinetic stress is free of it also where the gradient is averaged over. A scene
    /// whose images do not move refuses it.
    FieldOutput& againstFlow() { return withFlow = false, *this; }
    FieldOutput& withName(const std::string& fields) {
        requireFileName("FieldOutput", fields);
        if (fields.find('/') != std::string::npos)
            throw InputError(
                fmt::format("FieldOutput: name = '{}' is a part of a name; it must have no /.", fields));
        return ending = "-" + fields, *this;
    }
    /// Files of the HDF5 library, for any coordinates: a list of averages, each with its fields.
    FieldOutput& asHdf5() { return isHdf5 = true, *this; }

    /// Throws InputError for coordinates that have no meaning in the scene, and for files that cannot be
    /// written.
    template <class Scene>
    void prepare(const Scene& scene) const {
        if (isHdf5) {
            Hdf5Series::prepare();
            refuseFileOfOthers(scene.getName());
        }
        if (window > 0 && !times.isGiven() && scene.adaptiveTimeStep().isSet())
            throw InputError("FieldOutput: averages with the adaptive time step need withInterval().");
        if (scene.laws().shapes())
            throw InputError(
                "FieldOutput: fields take grains for spheres, and those of this scene are none; leave it "
                "out.");
        FieldSums::refuseMovingImages(sums.grid(), scene.getPeriodicBox());
        if (!withFlow && !scene.getPeriodicBox().imagesMove)
            throw InputError(
                "FieldOutput: againstFlow() needs a flow, and the images of this scene do not move "
                "(setLeesEdwards(), setStrainRate(), setTargetStress()); leave it out.");
    }

    template <class Scene>
    void write(const Scene& scene) {
        const double time = scene.getTime();
        if (time <= last) return;
        // Half a step, so that round-off of times decides nothing.
        if (sums.states() > 0 && time >= first + window - 0.5 * scene.getTimeStep()) writeAverage(scene);
        if (sums.states() == 0) {
            first = time;
            firstStep = scene.getNumberOfTimeSteps();
        }
        takeState(scene, state, content);
        if (!withFlow) takeFlowAway(state);
        sums.add(state, scene.getNumberOfThreads());
        last = time;
        if (window == 0) writeAverage(scene);
    }
    template <class Scene>
    void complete(const Scene& scene) {
        writeAverage(scene);
        if (isTable()) tableOf(scene).close();
    }

    template <class Scene>
    void visitState(StateArchive& archive, const Scene& scene) {
        const std::string entry = std::filesystem::path(nameOf(scene)).filename().string() + "-last-time";
        if (archive.isReading() && !archive.holds(entry)) {
            if (isTable()) tableOf(scene).goOnFrom(scene.getTime());
            keptUntil = scene.getTime();
            return;
        }
        archive.value(entry, last);
        keptUntil = last;
        archive.group(std::filesystem::path(nameOf(scene)).filename().string(), [&] {
            std::uint64_t states = sums.states();
            archive.same("withFlow", withFlow);
            archive.value("states", states);
            archive.value("first", first);
            archive.value("firstStep", firstStep);
            std::vector<double> numbers = sums.numbers();
            archive.column<double>("sums", numbers);
            if (!archive.isReading()) return;
            sums.setNumbers(numbers, states);
            // What was written at the end of that part is an average that goes on.
            if (states > 0) keptUntil = std::nextafter(first, -INFINITY);
        });
        if (isTable()) return tableOf(scene).visitState(archive);
        if (!archive.isReading()) return;
        if (isHdf5) Hdf5Series::check(nameOf(scene));
        else ParaViewSeries::check(nameOf(scene));
    }

private:
    void refuseFileOfOthers(const std::string& name) const {
        const std::filesystem::path own = Hdf5Series::indexOf(name + ending);
        const std::string_view owner = own == Hdf5Frames::indexOf(name) ? "of Hdf5Output"
                                       : own == restartFileOf(name)     ? "from which a run goes on"
                                                                        : "";
        if (!owner.empty())
            throw InputError(fmt::format(
                "FieldOutput: NAME{}.h5 is the file {}; give it another name by withName().", ending, owner));
    }
    [[nodiscard]] bool isTable() const { return !isHdf5 && sums.grid().dimensions() <= 1; }
    template <class Scene>
    [[nodiscard]] std::string nameOf(const Scene& scene) const {
        return scene.getName() + ending;
    }
    template <class Scene>
    RunTable& tableOf(const Scene& scene) {
        if (!table) table = std::make_shared<RunTable>(nameOf(scene) + ".csv", headerOf(sums));
        return *table;
    }
    /// Under the middle of the time that it is of.
    template <class Scene>
    void writeAverage(const Scene& scene) {
        if (sums.states() == 0) return;
        const double time = 0.5 * (first + last);
        const double kept = scene.isRestarted() ? keptUntil : -INFINITY;
        if (isTable()) {
            forEachRow(sums, time, [&](const std::string& row) { tableOf(scene).row(row); });
        } else if (isHdf5) {
            if (!frames) frames.emplace(nameOf(scene), kept);
            writeHdf5(frames->fileOf(firstStep), sums, time, firstStep, scene.getNumberOfThreads());
            frames->add(firstStep, time);
        } else {
            if (!series) series.emplace(nameOf(scene), kept, ".vti");
            writeImage(series->add("fields", time, firstStep), sums, time, scene.getNumberOfThreads());
            series->write();
        }
        sums.clear();
    }

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
