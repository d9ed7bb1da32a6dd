#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <vector>

#include "Kernel/Analysis/CoarseGraining/FieldFiles.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileName.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

FieldOutput::FieldOutput(const FieldGrid& grid, KernelShape shape, double width, double cutOff)
    : sums(grid, SmoothingKernel(shape, grid.dimensions(), width, cutOff)) {}

FieldOutput& FieldOutput::withInterval(double seconds) {
    return times = OutputInterval("FieldOutput", seconds), *this;
}

FieldOutput& FieldOutput::averagedOver(double seconds) {
    if (!(seconds >= 0))
        throw InputError(fmt::format(
            "FieldOutput: the time of an average is {:g} s; it must be 0 or more, or infinity.", seconds));
    return window = seconds, *this;
}

FieldOutput& FieldOutput::withGroups(const GrainGroups& groups) {
    return sums = FieldSums(sums.grid(), sums.kernel(), groups, content), *this;
}

FieldOutput& FieldOutput::withoutContacts() {
    content = FieldContent::WithoutContacts;
    return sums = FieldSums(sums.grid(), sums.kernel(), sums.groups(), content), *this;
}

FieldOutput& FieldOutput::withName(const std::string& fields) {
    requireFileName("FieldOutput", fields);
    if (fields.find('/') != std::string::npos)
        throw InputError(
            fmt::format("FieldOutput: name = '{}' is a part of a name; it must have no /.", fields));
    return ending = "-" + fields, *this;
}

void FieldOutput::prepare(const Scene& scene) const {
    if (isHdf5) {
        Hdf5Series::prepare();
        refuseFileOfOthers(scene.getName());
    }
    if (window > 0 && !times.isGiven() && scene.adaptiveTimeStep().isSet())
        throw InputError("FieldOutput: averages with the adaptive time step need withInterval().");
    FieldSums::refuseMovingImages(sums.grid(), scene.getPeriodicBox());
    if (!withFlow && !scene.getPeriodicBox().imagesMove)
        throw InputError(
            "FieldOutput: againstFlow() needs a flow, and the images of this scene do not move "
            "(setLeesEdwards(), setStrainRate(), setTargetStress()); leave it out.");
}

void FieldOutput::write(const Scene& scene) {
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

void FieldOutput::complete(const Scene& scene) {
    writeAverage(scene);
    if (isTable()) tableOf(scene).close();
}

void FieldOutput::visitState(StateArchive& archive, const Scene& scene) {
    const std::string entry = std::filesystem::path(nameOf(scene)).filename().string() + "-last-time";
    if (archive.isReading() && !archive.holds(entry)) {
        if (isTable()) tableOf(scene).goOnFrom(scene.getTime());
        keptUntil = scene.getTime();
        return;
    }
    archive.value(entry, last);
    if (archive.isReading()) keptUntil = last;
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
        // The last row of that part was written at its end: it is an average that goes on.
        if (states > 0) keptUntil = std::nextafter(first, -INFINITY);
    });
    if (isTable()) return tableOf(scene).visitState(archive);
    if (!archive.isReading()) return;
    if (isHdf5) Hdf5Series::check(nameOf(scene));
    else ParaViewSeries::check(nameOf(scene));
}

void FieldOutput::refuseFileOfOthers(const std::string& name) const {
    const std::filesystem::path own = Hdf5Series::indexOf(name + ending);
    const std::string_view owner = own == Hdf5Frames::indexOf(name) ? "of Hdf5Output"
                                   : own == restartFileOf(name)     ? "from which a run goes on"
                                                                    : "";
    if (!owner.empty())
        throw InputError(fmt::format(
            "FieldOutput: NAME{}.h5 is the file {}; give it another name by withName().", ending, owner));
}

std::string FieldOutput::nameOf(const Scene& scene) const { return scene.getName() + ending; }

RunTable& FieldOutput::tableOf(const Scene& scene) {
    if (!table) table = std::make_shared<RunTable>(nameOf(scene) + ".csv", headerOf(sums));
    return *table;
}

void FieldOutput::writeAverage(const Scene& scene) {
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

}  // namespace pendular
