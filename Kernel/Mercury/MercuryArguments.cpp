#include "Kernel/Mercury/MercuryArguments.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "Kernel/Files/TextFile.h"

namespace pendular {
namespace {

double numberOf(std::string_view option, std::string_view word) {
    double value = 0;
    if (!parseNumber(word, value))
        throw InputError(fmt::format("The option {} needs a number: {}.", option, whyNoNumber(word)));
    return value;
}

std::size_t stepsOf(std::string_view option, std::string_view word) {
    const double value = numberOf(option, word);
    if (!(value >= 0) || value > 1e18 || value != std::floor(value))
        throw InputError(fmt::format("The option {} is {}; it must be a whole number of steps, at least 0.",
                                     option, word));
    return static_cast<std::size_t>(value);
}

}  // namespace

void takeArguments(Run& run, int argc, const char* const* argv) {
    bool goesOn = false;
    for (int k = 1; k < argc; ++k) {
        const std::string_view option = argv[k];
        const bool hasValue = k + 1 < argc && (argv[k + 1][0] != '-' || option != "-r");
        if (option == "-r") {
            if (hasValue) run.restartFrom(argv[++k]);
            else goesOn = true;
            continue;
        }
        if (option != "-name" && option != "-tmax" && option != "-dt" && option != "-savecount")
            throw InputError(fmt::format(
                "There is no option {}; solve(argc, argv) knows -name, -tmax, -dt, -savecount and -r.",
                option));
        if (!hasValue) throw InputError(fmt::format("The option {} needs a value behind it.", option));
        const std::string_view value = argv[++k];
        if (option == "-name") run.setName(std::string(value));
        else if (option == "-tmax") run.setTimeMax(numberOf(option, value));
        else if (option == "-dt") run.setTimeStep(numberOf(option, value));
        else run.setSaveCount(stepsOf(option, value));
    }
    if (goesOn) run.restartFrom(run.restartFile());
}

}  // namespace pendular
