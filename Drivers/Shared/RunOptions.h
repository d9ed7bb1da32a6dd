#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>

#include "Kernel/Output/EnergyFile.h"
#include "Kernel/Output/Hdf5Output.h"
#include "Kernel/Output/ParaViewOutput.h"
#include "Kernel/Output/WallForceFile.h"
#include "Kernel/Simulation/RunSummary.h"
#include "Kernel/Simulation/Simulation.h"

namespace pendular {

/// What the user of any driver can say of its run, besides the scene.
struct RunOptions {
    std::string output;  // folder; empty, which no command line can say: the run keeps no restart file
    int threads = 1;
    std::string restart{};  // file; empty: none
    bool resume = false;
    double restartInterval = 600;  // s of the clock on the wall
    std::string wallTime{};        // [[hours:]minutes:]seconds; empty: no limit
    bool quiet = false;
    double paraViewInterval = 0;   // s; 0: no files for ParaView
    double hdf5Interval = 0;       // s; 0: no HDF5 files of fields
    double energyInterval = 0;     // s; 0: no ledger of the energy
    double wallForceInterval = 0;  // s; 0: no forces on walls

    /// The restart file from which a run of this name goes on; empty if it begins.
    [[nodiscard]] std::filesystem::path restartSource(const std::string& run = "run") const {
        if (!restart.empty()) return restart;
        const std::filesystem::path own = std::filesystem::path(output) / (run + "-restart.h5");
        return resume && std::filesystem::exists(own) ? own : std::filesystem::path();
    }
    /// Removes the restart file of an earlier run of this name, unless the run is to go on from it.
    void forget(const std::string& run) const {
        if (!resume && !output.empty())
            std::filesystem::remove(std::filesystem::path(output) / (run + "-restart.h5"));
    }
    /// What they say of a run that makes the initial state. It keeps only a restart file of its own, from
    /// which --resume goes on, and not from one that an earlier run has left.
    template <class S>
    void applyToPreparation(Simulation<S>& scene) const {
        applyToAny(scene, "preparation");
        if (!output.empty()) std::filesystem::remove(std::filesystem::path(output) / "run-restart.h5");
    }
    /// Gives a scene a name in the folder, and what these options say of its run.
    template <class S>
    void apply(Simulation<S>& scene, const std::string& run = "run") const {
        applyToAny(scene, run);
        if (output.empty()) return;
        scene.addOutput(RunSummary());
        if (paraViewInterval > 0) scene.addOutput(ParaViewOutput().withInterval(paraViewInterval));
        if (hdf5Interval > 0) scene.addOutput(Hdf5Output().withInterval(hdf5Interval));
        if (energyInterval > 0) scene.addOutput(EnergyFile(energyInterval));
        if (wallForceInterval > 0) scene.addOutput(WallForceFile(wallForceInterval));
    }

private:
    template <class S>
    void applyToAny(Simulation<S>& scene, const std::string& run) const {
        scene.setNumberOfThreads(threads);
        scene.setQuiet(quiet);
        if (output.empty()) return;
        scene.setName((std::filesystem::path(output) / run).string());
        if (Hdf5File::isAvailable()) scene.keepRestartFile();
        scene.setRestartInterval(restartInterval);
        scene.restartFrom(restartSource(run));
    }
};

/// Makes the folder if there is none. Throws InputError unless files can be written into it.
inline void requireOutputFolder(std::string_view driver, const std::filesystem::path& folder) {
    if (folder.empty())
        throw InputError(fmt::format(
            "{}: the output folder is empty; it must be a name ('.' for the current one).", driver));
    const std::filesystem::path probe = folder / fmt::format(".probe-{}", getpid());
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);
    std::FILE* file = std::fopen(probe.c_str(), "w");
    if (!file)
        throw InputError(fmt::format("{}: no files can be written into the output folder {}: {}.", driver,
                                     folder.string(), std::strerror(errno)));
    std::fclose(file);
    std::filesystem::remove(probe, ignored);
}

/// "11:30:00", "90:00" or "45" in s. Throws InputError.
inline double secondsOf(const std::string& clock) {
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
            fmt::format("The wall time '{}' has {} behind a colon; minutes and seconds there must "
                        "be at most 59.",
                        clock, largest));
    return sum;
}

/// Throws InputError, before a scene is made, unless a run with these options can begin.
/// @param endTime s; @param interval s
inline void checkRun(std::string_view driver, std::size_t number, double endTime, double interval) {
    checkValue(driver, "number of grains", static_cast<double>(number), "", {1, 1e8});
    checkValue(driver, "end time", endTime, "s", notNegative);
    checkValue(driver, "interval", interval, "s", positive);
}

/// Whole steps nearest to an interval of output, at least one; 0 (no output between) where they are more than
/// 1e15.
/// @param interval s; @param timeStep s
inline std::size_t stepsOf(double interval, double timeStep) {
    const double steps = std::round(interval / timeStep);
    return steps < 1 ? 1 : steps > 1e15 ? 0 : static_cast<std::size_t>(steps);
}

}  // namespace pendular
