#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Kernel/Features/Meshes/WornTriangles.h"
#include "Kernel/Features/Meshes/WornVertices.h"
#include "Kernel/Features/RigidBodies/MassProperties.h"

namespace pendular {

struct TriangleMesh;

/// A surface of triangles, of no thickness: grains may lie on both sides. Its parts are convex plane polygons
/// of coplanar triangles; edges and corners belong to one part at a time (see the README of this folder).
class TriangleWall final : public RigidWall, public WornWall {
public:
    /// Throws InputError if a coordinate is not finite or no triangle has an area.
    void set(std::span<const Triangle> triangles);
    /// One triangle, by its corners (m).
    void setVertices(const Vec3D& a, const Vec3D& b, const Vec3D& c) {
        const Triangle one{toVector(a), toVector(b), toVector(c)};
        set({&one, 1});
    }
    /// Reads a mesh: STL, OBJ, PLY or rows (see readTriangles). Throws InputError.
    /// @param scale m for one unit of the file (1e-3 for a file in mm)
    void read(const std::filesystem::path& path, double scale = 1) { set(readTriangles(path, scale)); }

    [[nodiscard]] std::size_t getNumberOfTriangles() const;
    [[nodiscard]] std::size_t getNumberOfParts() const;
    [[nodiscard]] std::size_t partCount() const override { return getNumberOfParts(); }
    [[nodiscard]] std::optional<Vector<double>> facetNormal(std::uint32_t part) const override;
    [[nodiscard]] std::vector<OpenEdge> openEdges() const override;
    /// Triangles without area, and repeated ones.
    [[nodiscard]] std::size_t getNumberLeftOut() const;

    /// Volume, centre and inertia of density 1 of what the mesh holds, in its own frame. Throws InputError
    /// where it is not closed.
    [[nodiscard]] MassProperties massProperties() const;
    using RigidWall::setFreeBody;
    /// It moves freely as a solid of this density (kg/m^3). A mesh that is not closed is given mass and
    /// inertia by the other function. Wear leaves both as they are.
    void setFreeBody(double density);

    /// Counts from the start of the run what grains do to each triangle, and what they wear off it by the
    /// law; the scene keeps an account of its contacts for it. The shape stays. Throws InputError before
    /// set() and in a run.
    void keepWear(const WearLaw& law);
    /// The same, and the vertices move, so that the wall loses this volume. Its material is behind the
    /// normals of its triangles: a grain that touches it from there ends the run. Coplanar triangles are not
    /// merged.
    void keepWear(const WearLaw& law, const VertexMotion& motion);
    /// Throws InputError unless it is kept.
    [[nodiscard]] const WornTriangles& getWear() const;
    /// Throws InputError unless vertices move.
    [[nodiscard]] const WornVertices& getWornVertices() const;
    [[nodiscard]] bool keepsWear() const override { return worn.has_value(); }
    [[nodiscard]] const WearLaw& wearLaw() const override { return worn->law(); }
    [[nodiscard]] const SurfaceWear& wearOf(std::size_t triangle) const override {
        return worn->of(triangle);
    }
    [[nodiscard]] bool movesVertices() const override { return moving.has_value(); }
    [[nodiscard]] bool canBeRepeated() const override { return true; }
    [[nodiscard]] bool hasConvexParts() const override { return true; }
    [[nodiscard]] bool isFlat() const override { return true; }
    [[nodiscard]] SurfaceAtFaces atFaces(const PeriodicFaces& faces) const override {
        return polygonsAtFaces(surface({}).polygons, faces);
    }
    void takeWear(std::uint32_t part, const Vector<double>& point, const ContactWear& done) override;
    void forgetStep() override { noted.clear(); }
    void finishStep(double time) override;
    /// Joins a scene as a RigidWall does; what was worn off the wall that it was copied from does not count.
    void join(double time);
    void visitState(StateArchive& archive) override;

protected:
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override;
    void findInBody(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                    std::span<WallPoint> points) const override;
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override;
    [[nodiscard]] SurfaceExtent extent() const override;
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override;
    double takeShapeShift() override { return std::exchange(shapeShift, 0); }
    void visitShape(StateArchive& archive) const override;

private:
    void refuseWearInRun() const;
    void beginWear(WearLaw law, std::optional<VertexMotion> motion);
    [[nodiscard]] std::optional<VertexMotion> motionOfVertices() const;
    /// Makes the mesh of where its vertices are to be (m). Throws RunError where a triangle loses its area.
    void placeVertices(std::vector<Vector<double>> places);

    std::shared_ptr<const TriangleMesh> mesh;   // copies of a wall share it
    std::shared_ptr<const TriangleMesh> given;  // before wear
    std::optional<WornTriangles> worn;
    std::optional<WornVertices> moving;
    std::vector<Vector<double>> vertices;  // m, of a wall whose vertices move
    double shapeShift = 0;                 // m, how far they went in the last step
    /// What a contact did to the wall in the step that is computed.
    struct Note {
        std::uint32_t part;
        Vector<double> point;  // m, in the body's frame
        ContactWear done;
    };
    std::vector<Note> noted;
};

}  // namespace pendular
