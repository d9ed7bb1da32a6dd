#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "Kernel/Core/Run/Run.h"

namespace pendular {

/// An option of a program, with so many numbers behind it.
struct MercuryOption {
    std::string_view name;
    std::size_t count;
    std::function<void(const std::vector<double>& values)> set;
};

/// Gives a run what solve(argc, argv) of MercuryDPM reads of a command line: -name NAME, -tmax SECONDS, -dt
/// SECONDS, -saveCount STEPS (also -savecount, -save_count), -r (goes on from the restart file of its name)
/// or -r FILE (also -restart). Throws InputError for any other word, or for a value that is missing or no
/// number.
/// @param others further options; @param restart called for -r, with an empty path where there is no FILE;
/// none: the kernel's restartFrom()
void takeArguments(Run& run, int argc, const char* const* argv, std::span<const MercuryOption> others = {},
                   const std::function<void(const std::filesystem::path&)>& restart = {});

/// A number of steps that was given as an option. Throws InputError for another number.
[[nodiscard]] std::size_t stepsOfOption(std::string_view option, double value);
/// 2 or 3. Throws InputError for another number.
[[nodiscard]] int dimensionsOfOption(std::string_view option, double value);

}  // namespace pendular
