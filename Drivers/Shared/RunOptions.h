#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "Kernel/Output/ParaViewOutput.h"
#include "Kernel/Simulation/RunSummary.h"
#include "Kernel/Simulation/Simulation.h"

namespace pendular {

/// What the user of any driver can say of its run, besides the scene.
struct RunOptions {
    std::string output;  // folder; empty: the run keeps no restart file
    int threads = 1;
    std::string restart{};  // file; empty: none
    bool resume = false;
    double restartInterval = 600;  // s of the clock on the wall
    std::string wallTime{};        // [[hours:]minutes:]seconds; empty: no limit
    bool quiet = false;
    double paraViewInterval = 0;  // s; 0: no files for ParaView

    /// The restart file from which a run of this name goes on; empty if it begins.
    [[nodiscard]] std::filesystem::path restartSource(const std::string& run = "run") const {
        if (!restart.empty()) return restart;
        const std::filesystem::path own = std::filesystem::path(output) / (run + "-restart.h5");
        return resume && std::filesystem::exists(own) ? own : std::filesystem::path();
    }
    /// What they say of a run that makes the initial state: it keeps no files.
    template <class S>
    void applyToPreparation(Simulation<S>& scene) const {
        scene.setNumberOfThreads(threads);
        scene.setQuiet(quiet);
    }
    /// Gives a scene a name in the folder, and what these options say of its run.
    template <class S>
    void apply(Simulation<S>& scene, const std::string& run = "run") const {
        applyToPreparation(scene);
        if (output.empty()) return;
        scene.setName((std::filesystem::path(output) / run).string());
        if (Hdf5File::isAvailable()) scene.keepRestartFile();
        scene.setRestartInterval(restartInterval);
        scene.restartFrom(restartSource(run));
        scene.addOutput(RunSummary());
        if (paraViewInterval > 0) scene.addOutput(ParaViewOutput().withInterval(paraViewInterval));
    }
};

/// "11:30:00", "90:00" or "45" in s. Throws InputError.
inline double secondsOf(const std::string& clock) {
    int hours = 0, minutes = 0, seconds = 0, end = 0;
    const auto reads = [&](const char* format, auto*... parts) {
        end = 0;
        return std::sscanf(clock.c_str(), format, parts..., &end) == sizeof...(parts) &&
               static_cast<std::size_t>(end) == clock.size();
    };
    const bool known = reads("%6d:%2d:%2d%n", &hours, &minutes, &seconds) ||
                       (hours = 0, reads("%6d:%2d%n", &minutes, &seconds)) ||
                       (minutes = 0, reads("%9d%n", &seconds));
    const double sum = 3600.0 * hours + 60.0 * minutes + seconds;
    if (!known || hours < 0 || minutes < 0 || seconds < 0 || !(sum > 0))
        throw InputError(
            fmt::format("The wall time '{}' is not a time above 0 s; it must be hours:minutes:seconds, "
                        "minutes:seconds or seconds.",
                        clock));
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
