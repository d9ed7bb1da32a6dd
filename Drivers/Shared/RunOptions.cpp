#include "Drivers/Shared/RunOptions.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/RunSummary.h"
#include "Kernel/Analysis/Output/WallForceFile.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

std::string RunOptions::nameOf(const std::string& run) const {
    return (std::filesystem::path(output) / run).string();
}

std::filesystem::path RunOptions::restartSource(const std::string& run) const {
    if (!restart.empty()) return restart;
    const std::filesystem::path own = restartFileOf(nameOf(run));
    return resume && isThere(own) ? own : std::filesystem::path();
}

void RunOptions::forgetAtStart(Scene& scene, const std::vector<std::string>& runs) const {
    if (resume || output.empty()) return;
    std::vector<std::filesystem::path> files;
    for (const std::string& run : runs) files.push_back(restartFileOf(nameOf(run)));
    scene.replaceAtStart(std::move(files));
}

void RunOptions::applyToPreparation(Scene& scene) const {
    applyToAny(scene, "preparation");
    scene.setSaveCount(100);  // the summary is written once a second at most
    if (!output.empty()) scene.addOutput(RunSummary().withoutPrinting());
    forgetAtStart(scene, {"run"});
}

void RunOptions::apply(Scene& scene, const std::string& run) const {
    applyToAny(scene, run);
    if (output.empty()) return;
    scene.addOutput(RunSummary());
    if (paraViewInterval > 0)
        scene.addOutput(ParaViewOutput().withInterval(paraViewInterval).withParts(paraViewParts));
    if (hdf5Interval > 0) scene.addOutput(Hdf5Output().withInterval(hdf5Interval));
    if (energyInterval > 0) scene.addOutput(EnergyFile(energyInterval));
    if (wallForceInterval > 0) scene.addOutput(WallForceFile(wallForceInterval));
}

void RunOptions::applyToAny(Scene& scene, const std::string& run) const {
    scene.setNumberOfThreads(threads);
    scene.setQuiet(quiet);
    if (output.empty()) return;
    scene.setName(nameOf(run));
    if (Hdf5File::isAvailable()) scene.keepRestartFile();
    scene.setRestartInterval(restartInterval);
    scene.restartFrom(restartSource(run));
}

void requireOutputFolder(std::string_view driver, const std::filesystem::path& folder) {
    if (folder.empty())
        throw InputError(fmt::format(
            "{}: the output folder is empty; it must be a name ('.' for the current one).", driver));
    const std::filesystem::path probe = folder / fmt::format(".probe-{}", getpid());
    std::error_code ignored;
    std::FILE* file = createFile(probe);
    if (!file)
        throw InputError(fmt::format("{}: no files can be written into the output folder {}: {}.", driver,
                                     folder.string(), std::strerror(errno)));
    std::fclose(file);
    std::filesystem::remove(probe, ignored);
}

double secondsOf(const std::string& clock) {
    int hours = 0, minutes = 0, seconds = 0, end = 0;
    const auto reads = [&](const char* format, auto*... parts) {
        end = 0;
        return std::sscanf(clock.c_str(), format, parts..., &end) == sizeof...(parts) &&
               static_cast<std::size_t>(end) == clock.size();
    };
    const bool hasHours = reads("%6d:%2d:%2d%n", &hours, &minutes, &seconds),
               hasMinutes = hasHours || (hours = 0, reads("%6d:%2d%n", &minutes, &seconds)),
               known = hasMinutes || (minutes = 0, reads("%9d%n", &seconds));
    const double sum = 3600.0 * hours + 60.0 * minutes + seconds;
    if (!known || hours < 0 || minutes < 0 || seconds < 0 || !(sum > 0))
        throw InputError(
            fmt::format("The wall time '{}' is not a time above 0 s; it must be hours:minutes:seconds, "
                        "minutes:seconds or seconds.",
                        clock));
    const int largest = std::max(hasHours ? minutes : 0, hasMinutes ? seconds : 0);  // after a colon
    if (largest > 59)
        throw InputError(
            fmt::format("The wall time '{}' has {} after a colon; minutes and seconds there must "
                        "be at most 59.",
                        clock, largest));
    return sum;
}

/// Bytes that this process can have: of the machine, or of the container or batch job that it runs in.
double memoryThere() {
    double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    for (const char* limit : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
        if (double most = 0; std::ifstream(limit) >> most) bytes = std::min(bytes, most);
    return bytes;
}

void checkNumberOfGrains(std::string_view program, std::size_t number) {
    checkValue(program, "number of grains", static_cast<double>(number), "", {1, 1e8});
    constexpr double bytesOfGrain = 472;  // at the peak, of a bed of 1 000 000 (page on contacts)
    const double there = memoryThere(), needed = bytesOfGrain * static_cast<double>(number);
    if (there > 0 && needed > there)
        throw InputError(fmt::format(
            "{}: {} grains would take about {:.3g} GB of memory; there are {:.3g} GB, so that the "
            "number of grains must be at most {:.2g}.",
            program, number, 1e-9 * needed, 1e-9 * there, there / bytesOfGrain));
}

void checkRun(std::string_view driver, std::size_t number, double endTime, double interval) {
    checkNumberOfGrains(driver, number);
    checkValue(driver, "end time", endTime, "s", notNegative);
    checkValue(driver, "interval", interval, "s", positive);
}

std::size_t stepsOf(double interval, double timeStep) {
    const double steps = std::round(interval / timeStep);
    return steps < 1 ? 1 : steps > 1e15 ? 0 : static_cast<std::size_t>(steps);
}

}  // namespace pendular
