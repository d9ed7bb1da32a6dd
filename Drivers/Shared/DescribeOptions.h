#pragma once

#include <string>

namespace CLI {
class App;
}

namespace pendular {

struct DriverProgram;

/// What --describe-options prints: the driver's name and description, and of each option, in the order of
/// --help, as JSON:
/// name    "--end-time-s"
/// type    "number", "whole", "count" (whole, 0 or more), "text", "flag"
/// unit    "s"; empty: none
/// text    what --help says
/// default as a text, of several values with commas between; empty: none
/// several whether it takes more than one value
/// range   of each value where it is known: lowest, highest (null: none), lowestIncluded, highestIncluded;
///         a driver may allow less, by what else it is given
/// choices the texts that it takes, where they are listed
/// excludes, needs  names of other options
/// path    whether it names a file or a folder
/// Throws InputError if this build cannot write it (no nlohmann-json).
/// @param app with all options of the driver
std::string describeOptions(const DriverProgram& driver, const CLI::App& app);

}  // namespace pendular
