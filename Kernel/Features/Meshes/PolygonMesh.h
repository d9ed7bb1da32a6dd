#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

/// A mesh as files have it: vertices, and faces of three or more of them.
struct PolygonMesh {
    struct Face {
        std::size_t end;    // of its corners in `corners`; they begin where those of the face before end
        std::size_t place;  // in the file
    };
    std::string_view placeIs = "line";     // what `place` counts, for messages
    std::vector<Vector<double>> vertices;  // m
    std::vector<std::int64_t> corners;     // of all faces: numbers of vertices, from 0
    std::vector<Face> faces;

    /// The corners that were added since the face before are one.
    void endFace(std::size_t place) { faces.push_back({corners.size(), place}); }
};

/// The triangles of all faces. Throws InputError, with the place in the file, for a corner that is no vertex,
/// a face with fewer than three, and one whose sides cross.
std::vector<Triangle> trianglesOf(const PolygonMesh& mesh, const InputFile& file);

/// A polygon cut into triangles: plane, convex or not, with corners in a line, too; also one that is cut open
/// to go round a hole. Each triangle has three of its corners, and runs round as the polygon does. Empty if
/// its sides cross. Corners in a line with others remain corners of triangles, so that the neighbours fit. Of
/// a polygon that is not plane the shape along its mean normal is cut.
///
/// Ears are cut off (Meisters (1975), Am. Math. Mon. 82, 648), the one with the shortest new side first.
/// @param ring its corners in a ring, m; the work grows with the square of their number
std::vector<std::array<std::uint32_t, 3>> cutPolygon(std::span<const Vector<double>> ring);

}  // namespace pendular
