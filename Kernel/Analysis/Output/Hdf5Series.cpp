#include "Kernel/Analysis/Output/Hdf5Series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/FrameIndex.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/State/Hdf5File.h"

namespace pendular {

namespace {

std::vector<double> columnOf(const Hdf5File& file, const std::string& name) {
    const auto shape = file.holds(name) ? file.shapeOf(name) : std::nullopt;
    if (!shape || shape->kind != NumberKind::Float64 || shape->columns != 1)
        throw InputError(
            fmt::format("The file {} is no list of frames: it has no {}.", file.path().string(), name));
    std::vector<double> numbers(shape->rows);
    file.read(name, *shape, numbers.data());
    return numbers;
}

std::filesystem::path fileOfStep(const std::string& beginning, std::uint64_t step) {
    return fmt::format("{}-{:09}.h5", beginning, step);
}

std::string groupOf(std::uint64_t step) { return fmt::format("frames/{:09}", step); }

}  // namespace

void Hdf5Series::prepare() {
    if (!Hdf5File::isAvailable())
        throw InputError(
            "This build of Pendular has no HDF5 library and writes no fields with it: install the library "
            "(install-dependencies.sh of the source) and build again.");
}

Hdf5Series::Times Hdf5Series::readIndex(const std::filesystem::path& path) {
    const Hdf5File index(path, Hdf5File::Access::Read);
    const std::vector<double> steps = columnOf(index, "step"), seconds = columnOf(index, "time_s");
    constexpr double largestStep = 0x1p53;  // of whole numbers that a double holds
    const auto isStep = [](double step) {
        return step >= 0 && step <= largestStep && step == std::floor(step);
    };
    const auto isTime = [](double time) { return std::isfinite(time); };
    if (steps.size() != seconds.size() || !std::ranges::all_of(steps, isStep) ||
        !std::ranges::all_of(seconds, isTime))
        throw InputError(fmt::format(
            "The file {} is no list of frames: step and time_s are not a whole number and a time for each.",
            path.string()));
    Times found;
    for (std::size_t k = 0; k < steps.size(); ++k) found[static_cast<std::uint64_t>(steps[k])] = seconds[k];
    return found;
}

std::vector<Hdf5Entry> readHdf5Series(const std::filesystem::path& path, const std::filesystem::path& named) {
    const std::filesystem::path& list = named.empty() ? path : named;
    const std::string beginning = list.parent_path() / list.stem();
    std::vector<Hdf5Entry> entries;
    for (const auto& [step, time] : Hdf5Series::readIndex(path))
        entries.push_back({time, fileOfStep(beginning, step)});
    return entries;
}

void Hdf5Series::check(const std::string& name) { checkFrameIndex(indexOf(name), readIndex); }

Hdf5Series::Times Hdf5Series::formerTimes(bool needed) const {
    if (!isThere(indexOf(beginning))) return {};
    try {
        return readIndex(indexOf(beginning));
    } catch (const InputError&) {
        if (needed) throw;
        return {};
    }
}

Hdf5Series::Hdf5Series(std::string name, double keptUntil) : beginning(std::move(name)) {
    std::vector<std::filesystem::path> dropped;
    for (const auto& [step, time] : formerTimes(keptUntil != -INFINITY)) {
        if (time <= keptUntil) times[step] = time;
        else dropped.push_back(fileOf(step));
    }
    // In this order, so that a series never names a file that is not there.
    if (times.empty()) removeFile(indexOf(beginning));
    else if (!dropped.empty()) writeIndex();
    for (const std::filesystem::path& path : dropped) removeFile(path);
}

std::filesystem::path Hdf5Series::fileOf(std::uint64_t step) const { return fileOfStep(beginning, step); }

void Hdf5Series::add(std::uint64_t step, double time) {
    times[step] = time;
    writeIndex();
}

void Hdf5Series::writeIndex() const {
    FieldFile index(indexOf(beginning));
    std::vector<double> steps, seconds;
    for (const auto& [step, time] : times) {
        steps.push_back(static_cast<double>(step));
        seconds.push_back(time);
        index.link(groupOf(step), fileOf(step).filename().string());
    }
    index.column("/", {"step", 1, std::move(steps)});
    index.column("/", {"time_s", 1, std::move(seconds)});
    index.attribute("/", "content", "frames of a run of Pendular: the page on output has the format");
    index.close();
}

}  // namespace pendular
