#pragma once

#include <optional>
#include <vector>

#include "Kernel/Features/Meshes/MeshParts.h"
#include "Kernel/Features/Meshes/TriangleGrid.h"
#include "Kernel/Features/Wear/WornWall.h"

namespace pendular {

/// The triangles of a mesh, by which its wear is counted: coplanar ones are one part of the mesh, but each
/// has its own sums. Those that the mesh leaves out have none.
class WornTriangles {
public:
    WornTriangles(const MeshTriangles& mesh, const WearLaw& wearLaw);

    /// Where a point is.
    struct Corners {
        std::uint32_t triangle = 0;
        std::array<double, 3> weights{};  // of its corners; they sum to 1
    };
    /// The place at which a volume has been worn off.
    struct Place {
        Corners at;
        double volume;  // m^3
    };

    /// Takes in what a contact of a part does in a step, at a point (m, in the frame of the mesh): counted
    /// for the triangle of this part in which the point lies, or where it has the largest of the smallest
    /// weights.
    Place add(std::uint32_t part, const Vector<double>& point, const ContactWear& done);

    [[nodiscard]] std::size_t size() const { return wear.size(); }
    [[nodiscard]] const SurfaceWear& of(std::size_t triangle) const { return wear[triangle]; }
    /// The wear of all triangles; the area is theirs together.
    [[nodiscard]] SurfaceWear sum() const;
    [[nodiscard]] Triangle triangle(std::size_t number) const;
    [[nodiscard]] const WearLaw& law() const { return wearLaw; }
    [[nodiscard]] const MeshTriangles& mesh() const { return triangles; }

    /// Takes the places (m) of the mesh's vertices, which have moved.
    void moveTo(const std::vector<Vector<double>>& vertices);

    void visitState(StateArchive& archive);

private:
    /// In a triangle of the part.
    [[nodiscard]] Corners cornersAt(std::uint32_t part, const Vector<double>& point) const;
    /// What follows from the places of the vertices.
    void measure();

    MeshTriangles triangles;
    WearLaw wearLaw;
    std::vector<SurfaceWear> wear;
    std::vector<std::vector<std::uint32_t>> trianglesOf;  // each part
    std::vector<CornerWeights> weights;
    std::vector<std::optional<TriangleGrid>> grids;  // of parts of many triangles
};

}  // namespace pendular
