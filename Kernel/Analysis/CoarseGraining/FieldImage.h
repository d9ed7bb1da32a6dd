#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "Kernel/Analysis/Output/PolyData.h"

namespace pendular {

/// One field at the points of a grid, as a file of FieldOutput or coarse-grain has it.
struct FieldImage {
    struct Name {
        std::string name;
        std::size_t components;
    };

    double time = std::numeric_limits<double>::quiet_NaN();  // s; NaN: the file is named by its step alone
    std::array<std::string, 3> axes{"x", "y", "z"};          // or r, theta, z
    std::array<std::vector<double>, 3>
        places;                            // m, of the points along each axis; one where it is averaged over
    std::array<std::size_t, 3> strides{};  // from a point to the next one along an axis
    std::vector<Name> known;               // all fields of the file
    PolyDataField field;

    [[nodiscard]] double at(const std::array<std::size_t, 3>& point, std::size_t component) const {
        return field.at((point[0] * strides[0] + point[1] * strides[1] + point[2] * strides[2]) *
                            field.components +
                        component);
    }
};

/// Reads one field of a file .vti or .h5, and no others. Throws InputError, with the file and the reason, if
/// it is none with fields, or has none of this name.
/// @param field its name; empty: the first one
/// @param named its name, which tells the form, where the path is not that one (that of an open file)
FieldImage readFieldImage(const std::filesystem::path& path, const std::string& field,
                          const std::filesystem::path& named = {});

}  // namespace pendular
