#include "Drivers/Shared/CommandLine.h"

#include <fmt/format.h>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/DescribeOptions.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Core/Run/RunControl.h"
#include "Kernel/Foundation/Files/FileLock.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

void addRunOptions(CLI::App& app, RunOptions& o, const std::string& files, const std::string& run) {
    app.add_option("--output", o.output, "folder for " + files)->type_name(folderName)->capture_default_str();
    app.add_option("--threads", o.threads, "threads; the results do not depend on their number")
        ->capture_default_str();
    auto* resume =
        app.add_flag("--resume", o.resume,
                     "go on from the restart file in the output folder. If there is none, the run starts "
                     "again and removes the frames of an earlier run. Give the other options as before; "
                     "only end, intervals and threads may change. Do not switch --energy-interval-s on or "
                     "off");
    app.add_option("--restart", o.restart, "go on from this restart file")
        ->type_name(fileName)
        ->excludes(resume);
    app.add_option("--restart-interval-s", o.restartInterval,
                   "time on the clock between two restart files, s; 0: at the start and the end only. One is "
                   "also written on SIGINT, SIGTERM (the run ends), and SIGUSR1 (it goes on)")
        ->capture_default_str();
    app.add_option(
        "--wall-time", o.wallTime,
        "time on the clock, hours:minutes:seconds, after which the run ends as on SIGTERM; no limit if "
        "not given");
    const auto addInterval = [&](const char* name, double& interval, const std::string& between,
                                 const std::string& file, const std::string& none = "none") {
        app.add_option(name, interval,
                       fmt::format("time between two {} ({}{} in the folder), s: they are "
                                   "written at the steps nearest to its multiples, and at the end; 0: {}",
                                   between, run, file, none))
            ->capture_default_str();
    };
    addInterval("--paraview-interval-s", o.paraViewInterval, "frames for ParaView", ".pvd");
    app.add_flag("--paraview-parts", o.paraViewParts,
                 "frames for ParaView in parts, of which each rank (mpirun) writes its own, .pvtp with .vtp");
    addInterval("--hdf5-interval-s", o.hdf5Interval, "frames for h5py and MATLAB", "-fields.h5");
    addInterval("--energy-interval-s", o.energyInterval, "rows of the energy by mechanism", "-energy.csv",
                "none, and no account is kept");
    addInterval("--wall-force-interval-s", o.wallForceInterval, "outputs of the forces on the walls",
                "-wall-forces.csv");
    app.add_flag("--quiet", o.quiet, "print nothing but errors");
}

void addRunOptionsOfSeveral(CLI::App& app, RunOptions& o, const std::string& files, const std::string& runs) {
    addRunOptions(app, o, files, runs);
    app.remove_option(app.get_option("--restart"));
}

static void addOptionsOf(const DriverProgram& driver, CLI::App& app) {
    if (driver.addOptions) driver.addOptions(app);
    for (const NumberOption& number : driver.numbers)
        std::visit(
            [&](auto* value) {
                const std::string unit = number.unit.empty() ? "" : ", " + number.unit;
                app.add_option(number.option(), *value, number.description + unit)->capture_default_str();
            },
            number.value);
    if (!driver.files.empty()) addRunOptions(app, driver.options, driver.files);
}

int runDriver(const DriverProgram& driver, int argc, char** argv, const std::function<void()>& body) {
    CLI::App app(driver.description, driver.name);
    addOptionsOf(driver, app);
    bool describes = false;
    app.add_flag("--describe-options", describes, "print all options as JSON, for other programs, and end");
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    if (describes) return runProgram([&] { return fmt::print("{}", describeOptions(driver, app)), 0; });
    return runProgram([&] {
        const RunOptions& o = driver.options;
        for (const NumberOption& number : driver.numbers) {
            const double value = std::visit([](auto* v) { return static_cast<double>(*v); }, number.value);
            checkValue(driver.name, number.option(), value, number.unit, number.allowed);
            if (number.name == "number") checkNumberOfGrains(driver.name, static_cast<std::size_t>(value));
        }
        checkValue(driver.name, "number of threads", o.threads, "", {1, 4096});
        checkValue(driver.name, "restart interval", o.restartInterval, "s", notNegative);
        checkValue(driver.name, "ParaView interval", o.paraViewInterval, "s", notNegative);
        checkValue(driver.name, "HDF5 interval", o.hdf5Interval, "s", notNegative);
        checkValue(driver.name, "energy interval", o.energyInterval, "s", notNegative);
        checkValue(driver.name, "wall force interval", o.wallForceInterval, "s", notNegative);
        if (!o.wallTime.empty()) setWallTimeLimit(secondsOf(o.wallTime));
        if (o.resume || !o.restart.empty()) requireRestartFiles();
        if (!o.restart.empty()) checkRestartFile(o.restart);
        if (o.hdf5Interval > 0) Hdf5Frames::prepare();
        requireOutputFolder(driver.name, o.output);
        const FileLock lock(std::filesystem::path(o.output) / ".pendular-lock",
                            fmt::format("The folder {} is", o.output), "give another one (--output)");
        body();
        return 0;
    });
}

}  // namespace pendular
