#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

using Triangle = std::array<Vector<double>, 3>;  // m

/// Reads triangles from a file; what it is, its content says: STL, OBJ or PLY, binary or text (faces of more
/// corners are cut into triangles), or rows of nine numbers `x1 y1 z1 x2 y2 z2 x3 y3 z3`, parted by blanks or
/// commas, after an optional line of column names; empty lines and lines that begin with # are skipped.
/// Throws InputError with the file, the line or offset, and the reason. The memory used is bounded by the
/// size of the file.
/// @param scale m for one unit of the file (1e-3 for a file in mm)
std::vector<Triangle> readTriangles(const std::filesystem::path& path, double scale = 1);

/// m for one unit of a mesh, as it is. Throws InputError unless it is positive and finite.
double checkedMeshScale(double scale);

}  // namespace pendular
