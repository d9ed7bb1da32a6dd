#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace CLI {
class App;
}

namespace pendular {

/// Adds the options to those of a driver.
/// @param files that the driver writes into its folder
/// @param run what the names of the files begin with that all drivers write
void addRunOptions(CLI::App& app, RunOptions& o, const std::string& files, const std::string& run = "run");

/// The same of a driver that makes several runs, each with files of its own: --resume goes on with them, and
/// there is no --restart.
void addRunOptionsOfSeveral(CLI::App& app, RunOptions& o, const std::string& files, const std::string& runs);

/// A number that a driver's command line can give, with its unit in its name: --end-time-s. --number is that
/// of grains, for which there must be memory.
struct NumberOption {
    std::string name;                                 // "end-time"
    std::string unit;                                 // "s"; empty: none
    std::variant<double*, int*, std::size_t*> value;  // it has its default
    Range allowed;                                    // any other value is refused in one sentence
    std::string description;

    [[nodiscard]] std::string option() const { return "--" + name + (unit.empty() ? "" : "-" + unit); }
};

/// The type_name() of each option that names a file or a folder: --help shows it, and the page of runs in the
/// browser leaves the option out, as nobody may reach files through it.
inline constexpr const char *fileName = "FILE", *folderName = "FOLDER";

/// What a driver says of itself on its command line.
struct DriverProgram {
    std::string name, description;
    RunOptions& options;
    std::function<void(CLI::App&)> addOptions{};  // other than those that follow
    std::string files{};  // that it writes into its folder; with it the options of its run are added
    std::vector<NumberOption> numbers{};
};

/// Parses the command line and runs the driver's body; returns the program's exit code.
int runDriver(const DriverProgram& driver, int argc, char** argv, const std::function<void()>& body);

/// The main() of a driver with a struct of options of its own, in which `run` are those of its run: a
/// function adds them to the command line, another one runs the driver with them.
template <class Options>
int runDriver(const std::string& name, const std::string& description, Options options,
              void (*addOptions)(CLI::App&, Options&), void (*body)(const Options&), int argc, char** argv) {
    return runDriver({name, description, options.run, [&](CLI::App& app) { addOptions(app, options); }}, argc,
                     argv, [&] { body(options); });
}

/// The main() of a driver that has no options of its own.
template <class Driver>
int runDriver(const std::string& description, const std::string& name, int argc, char** argv) {
    RunOptions options{.output = name + "-output"};
    return runDriver({name, description, options, {}, "what the run writes"}, argc, argv, [&] {
        Driver driver;
        options.apply(driver);
        driver.solve();
    });
}

}  // namespace pendular
