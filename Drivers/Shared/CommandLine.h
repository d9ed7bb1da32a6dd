#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <string>

#include "Drivers/Shared/RunOptions.h"

namespace pendular {

/// Adds the options to those of a driver.
/// @param files that the driver writes into its folder
inline void addRunOptions(CLI::App& app, RunOptions& o, const std::string& files) {
    app.add_option("--output", o.output, "folder for " + files)->capture_default_str();
    app.add_option("--threads", o.threads, "OpenMP threads; the results do not depend on their number")
        ->capture_default_str();
    auto* resume = app.add_flag("--resume", o.resume,
                                "go on from the restart file in the output folder, if there is one; give the "
                                "other options as before (end, intervals and threads may change)");
    app.add_option("--restart", o.restart, "go on from this restart file")->excludes(resume);
    app.add_option(
           "--restart-interval-s", o.restartInterval,
           "time on the clock from one restart file to the next, s; 0: one at the end only. One is also "
           "written on SIGINT, SIGTERM (the run ends), and SIGUSR1 (it goes on)")
        ->capture_default_str();
    app.add_option("--wall-time", o.wallTime,
                   "time on the clock, hours:minutes:seconds, after which the run ends as on SIGTERM");
    app.add_option("--paraview-interval-s", o.paraViewInterval,
                   "time between two frames for ParaView (run.pvd in the folder), s, which are written when "
                   "output is due; 0: none")
        ->capture_default_str();
    app.add_flag("--quiet", o.quiet, "print nothing but errors");
}

/// Parses a driver's command line, and runs its body; returns the program's exit code.
template <class Body>
int runDriver(CLI::App& app, const RunOptions& options, int argc, char** argv, Body&& body) {
    CLI11_PARSE(app, argc, argv);
    return runProgram([&] {
        checkValue(app.get_name(), "number of threads", options.threads, "", {1, 4096});
        checkValue(app.get_name(), "restart interval", options.restartInterval, "s", notNegative);
        checkValue(app.get_name(), "ParaView interval", options.paraViewInterval, "s", notNegative);
        if (!options.wallTime.empty()) setWallTimeLimit(secondsOf(options.wallTime));
        if (options.resume || !options.restart.empty()) requireRestartFiles();
        if (!options.restart.empty()) checkRestartFile(options.restart);
        body();
        return 0;
    });
}

/// The main() of a driver that has no options of its own.
template <class Driver>
int runDriver(const std::string& description, const std::string& folder, int argc, char** argv) {
    CLI::App app(description, folder);
    RunOptions options{.output = folder};
    addRunOptions(app, options, "what the run writes");
    return runDriver(app, options, argc, argv, [&] {
        Driver driver;
        options.apply(driver);
        driver.solve();
    });
}

}  // namespace pendular
