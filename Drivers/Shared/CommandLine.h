#pragma once

#include <functional>
#include <string>

#include "Drivers/Shared/RunOptions.h"

namespace CLI {
class App;
}

namespace pendular {

/// Adds the options to those of a driver.
/// @param files that the driver writes into its folder
/// @param run what the names of the files begin with that all drivers write
void addRunOptions(CLI::App& app, RunOptions& o, const std::string& files, const std::string& run = "run");

/// What a driver says of itself on its command line.
struct DriverProgram {
    std::string name, description;
    const RunOptions& options;
    std::function<void(CLI::App&)> addOptions;  // those of its run too
};

/// Parses the command line and runs the driver's body; returns the program's exit code.
int runDriver(const DriverProgram& driver, int argc, char** argv, const std::function<void()>& body);

/// The main() of a driver that has no options of its own.
template <class Driver>
int runDriver(const std::string& description, const std::string& name, int argc, char** argv) {
    RunOptions options{.output = name + "-output"};
    const auto addOptions = [&](CLI::App& app) { addRunOptions(app, options, "what the run writes"); };
    return runDriver({name, description, options, addOptions}, argc, argv, [&] {
        Driver driver;
        options.apply(driver);
        driver.solve();
    });
}

}  // namespace pendular
