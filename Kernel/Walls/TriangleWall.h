#pragma once

#include <filesystem>
#include <memory>

#include "Kernel/Walls/RigidWall.h"
#include "Kernel/Walls/TriangleReader.h"

namespace pendular {

struct TriangleMesh;

/// A surface of triangles, of no thickness: grains may lie on both sides. Its parts are convex plane polygons
/// of coplanar triangles; edges and corners belong to one part at a time (see the README of this folder).
class TriangleWall final : public RigidWall {
public:
    /// Throws InputError if a coordinate is not finite or no triangle has an area.
    void set(std::span<const Triangle> triangles);
    /// Reads an STL file or rows of nine numbers (see readTriangles). Throws InputError.
    /// @param scale m for one unit of the file (1e-3 for a file in mm)
    void read(const std::filesystem::path& path, double scale = 1) { set(readTriangles(path, scale)); }

    [[nodiscard]] std::size_t getNumberOfTriangles() const;
    [[nodiscard]] std::size_t getNumberOfParts() const;
    [[nodiscard]] std::size_t partCount() const override { return getNumberOfParts(); }
    /// Triangles without area, and repeated ones.
    [[nodiscard]] std::size_t getNumberLeftOut() const;

protected:
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override;
    void findInBody(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                    std::span<WallPoint> points) const override;
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override;
    [[nodiscard]] SurfaceExtent extent() const override;
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override;
    void visitShape(StateArchive& archive) const override;

private:
    std::shared_ptr<const TriangleMesh> mesh;  // copies of a wall share it
};

}  // namespace pendular
