#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// Corners of triangles that are nearer to each other than this share of the mesh's size are one: programs
/// that write meshes round the same corner in several ways. (This is the one place that says so: walls,
/// membranes, regions and clumps all weld by it.)
inline constexpr double weldTolerance = 1e-9;

/// Triangles whose corners are vertices that they share.
struct WeldedMesh {
    std::vector<Vector<double>> vertices;  // m, by x, then y, then z; no two of them are the same
    std::vector<std::array<std::uint32_t, 3>> corners;  // of each given triangle: places in `vertices`
    Vector<double> lowest{0, 0, 0};                     // m, of the box around all corners
    double size = 0;                                    // m, its diagonal
};

/// Welds corners that are within weldTolerance times the size of each other, directly or by way of others:
/// "the same corner" is an equivalence, so that the result does not depend on the order of the triangles. The
/// vertex is the lowest of them (by x, then y, then z). Corners with equal bits stay one, however far the
/// mesh is from the origin; a -0 is 0. Sorted along one direction, compared with the next ones along it: O(n
/// log n). Throws InputError if a coordinate is not finite or above 1e9 m.
/// @param owner for the message: "TriangleWall"
WeldedMesh weld(std::span<const std::array<Vector<double>, 3>> triangles, std::string_view owner);

}  // namespace pendular
