#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "Kernel/Walls/RigidWall.h"
#include "Kernel/Walls/TriangleReader.h"
#include "Kernel/Walls/WornTriangles.h"

namespace pendular {

struct TriangleMesh;

/// A surface of triangles, of no thickness: grains may lie on both sides. Its parts are convex plane polygons
/// of coplanar triangles; edges and corners belong to one part at a time (see the README of this folder).
class TriangleWall final : public RigidWall, public WornWall {
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

    /// Counts from the start of the run what grains do to each triangle, and what they wear off it by the
    /// law; the scene keeps the ledger of the energy for it. The shape stays. Throws InputError before set()
    /// and in a run.
    void keepWear(const WearLaw& law);
    /// Throws InputError unless it is kept.
    [[nodiscard]] const WornTriangles& getWear() const;
    [[nodiscard]] bool keepsWear() const override { return worn.has_value(); }
    [[nodiscard]] bool needsFriction() const override { return worn->law().needsFriction(); }
    [[nodiscard]] const SurfaceWear& wearOf(std::size_t triangle) const override {
        return worn->of(triangle);
    }
    void takeWear(std::uint32_t part, const Vector<double>& point, const ContactWear& done) override;
    void visitState(StateArchive& archive) override;

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
    std::optional<WornTriangles> worn;
};

}  // namespace pendular
