#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Features/Insertion/Region.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/Meshes/WeldedMesh.h"

namespace pendular {

/// The inside of a closed surface of triangles. A point is inside if the surface winds around it once: a ray
/// from it upwards leaves the surface once more than it enters it.
class MeshRegion final : public Region {
public:
    /// Throws InputError unless the triangles are a closed surface that does not go through itself: each edge
    /// belongs to two triangles, which go along it in opposite directions (corners are the same as for a
    /// TriangleWall: WeldedMesh.h), and the surface winds around no point of a sample more than once.
    explicit MeshRegion(std::span<const Triangle> triangles);
    /// A region from a file that readTriangles() reads.
    /// @param scale m for one unit of the file (1e-3 for a file in mm)
    static MeshRegion fromFile(const std::filesystem::path& path, double scale = 1) {
        return MeshRegion(readTriangles(path, scale));
    }

    /// The surface (m): corners are welded, all triangles are counter-clockwise from outside, and those of
    /// which two corners are one are left out.
    [[nodiscard]] const std::vector<Triangle>& getTriangles() const { return triangles; }

    using Region::contains;
    [[nodiscard]] bool contains(const Vector<double>& point, double margin) const override;
    [[nodiscard]] double volume() const override { return size; }
    [[nodiscard]] Box bounds() const override { return box; }
    [[nodiscard]] double areaAcross(const Vector<double>& direction) const override;
    [[nodiscard]] double largestSphere() const override;
    [[nodiscard]] Vector<double> inwards(const Vector<double>& centre, double radius) const override;
    [[nodiscard]] std::shared_ptr<const Region> in(const PeriodicBox& periodic) const override;
    void visitState(StateArchive& archive) const override;

    /// How often the surface winds around a point: 0 outside, 1 inside. (Of a point above an edge the sides
    /// are told apart as if it lay a little farther in x, then in y, so that each counts once.)
    [[nodiscard]] int windings(const Vector<double>& point) const;

private:
    /// The triangles above a column of a grid in x and y.
    [[nodiscard]] std::span<const std::uint32_t> column(double x, double y) const;
    void makeColumns();
    static void refuseUnlessClosed(const WeldedMesh& mesh);
    void refuseIfThroughItself() const;

    std::vector<Triangle> triangles;  // m; seen from outside, counter-clockwise
    TriangleWall surface;             // the same, to measure distances
    Box box;
    double size = 0;          // m^3
    std::size_t columns = 1;  // along x, and along y
    std::vector<std::uint32_t> begins, members;
};

}  // namespace pendular
