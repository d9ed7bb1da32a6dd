#include "Kernel/Mercury/MercuryHelpers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace helpers {

void writeToFile(const std::string& file, const std::string& text) {
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out) throw pendular::InputError(fmt::format("The file {} cannot be written.", file));
}

bool fileExists(const std::string& file) { return pendular::isThere(file); }

std::size_t getSaveCountFromNumberOfSavesAndTimeMaxAndTimeStep(std::size_t saves, double timeMax,
                                                               double timeStep) {
    pendular::checkValue("helpers", "time step", timeStep, "s", pendular::positive);
    pendular::checkValue("helpers", "end of the run", timeMax, "s", pendular::notNegative);
    if (saves == 0) throw pendular::InputError("helpers: the number of saves is 0; it must be at least 1.");
    const double intervals = std::max(1.0, static_cast<double>(saves) - 1);
    return static_cast<std::size_t>(std::max(1.0, std::ceil(timeMax / timeStep / intervals)));
}

/// The word behind a name; null where the name is not there.
static const char* wordBehind(int argc, const char* const* argv, const std::string& name) {
    for (int k = 1; k < argc; ++k) {
        if (argv[k] != name) continue;
        if (k + 1 == argc)
            throw pendular::InputError(fmt::format("The option {} needs a value behind it.", name));
        return argv[k + 1];
    }
    return nullptr;
}

double readFromCommandLine(int argc, const char* const* argv, const std::string& name, double standard) {
    const char* const word = wordBehind(argc, argv, name);
    double value = standard;
    if (word && !pendular::parseNumber(word, value))
        throw pendular::InputError(
            fmt::format("The option {} needs a number: {}.", name, pendular::whyNoNumber(word)));
    return value;
}

std::string readFromCommandLine(int argc, const char* const* argv, const std::string& name,
                                const std::string& standard) {
    const char* const word = wordBehind(argc, argv, name);
    return word ? word : standard;
}

bool readFromCommandLine(int argc, const char* const* argv, const std::string& name) {
    return std::find(argv + 1, argv + argc, name) != argv + argc;
}

void check(double value, double expected, double error, const std::string& whatIsChecked) {
    if (!mathsFunc::isEqual(value, expected, error))
        throw pendular::RunError(
            fmt::format("{} is {}; it must be {} up to {}.", whatIsChecked, value, expected, error));
}

void check(const pendular::Vec3D& value, const pendular::Vec3D& expected, double error,
           const std::string& whatIsChecked) {
    for (int axis = 0; axis < 3; ++axis)
        check(value[axis], expected[axis], error, fmt::format("{}, {}", whatIsChecked, "xyz"[axis]));
}

}  // namespace helpers
