#include "Kernel/Mercury/MercuryHelpers.h"

#include <fmt/format.h>

#include <fstream>

#include "Kernel/Base/InputError.h"
#include "Kernel/Base/RunError.h"

namespace helpers {

void writeToFile(const std::string& file, const std::string& text) {
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out) throw pendular::InputError(fmt::format("The file {} cannot be written.", file));
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
