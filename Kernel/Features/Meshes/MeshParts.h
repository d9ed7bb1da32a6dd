#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Features/Meshes/TriangleReader.h"

namespace pendular {

/// A plane convex polygon, made of triangles that lie in one plane.
struct MeshPart {
    std::vector<Vector<double>> corners;  // m, in a ring
    Vector<double> normal;                // unit
};

/// The triangles of a mesh, without those that it leaves out.
struct MeshTriangles {
    std::vector<Vector<double>> vertices;               // m; some may belong to no triangle
    std::vector<std::array<std::uint32_t, 3>> corners;  // of each triangle: places in `vertices`
    std::vector<std::uint32_t> partOf;                  // of each triangle
};

/// The parts of a mesh, in the order of their first triangles. Merging is only an economy (a wall of a
/// thousand coplanar triangles is one part): triangles that do not merge touch the same grains with the same
/// forces.
struct MeshParts {
    std::vector<MeshPart> parts;
    /// Parts (lower, higher) that share an edge at which the surface turns by less than smoothAngle; sorted.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> smoothPairs;
    MeshTriangles triangles;
    double size = 0;          // m, diagonal of the box around all vertices
    std::size_t leftOut = 0;  // triangles without area, and repeated ones
};

/// Lengths below this share of the mesh's size count as zero: coplanarity, and the height of a triangle.
/// (When two corners are one, WeldedMesh.h says.)
inline constexpr double meshTolerance = 1e-9;

/// Whether coplanar triangles become one part, or each is its own, as where they will move apart.
enum class CoplanarTriangles { Merge, Keep };

/// Throws InputError if a coordinate is not finite (or above 1e9 m) or no triangle has an area.
MeshParts makeMeshParts(std::span<const Triangle> triangles,
                        CoplanarTriangles coplanar = CoplanarTriangles::Merge);

}  // namespace pendular
