#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <type_traits>
#include <vector>

#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/Meshes/IntersectionOfHalfSpaces.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Mercury/MercuryDomain.h"
#include "Kernel/Mercury/MercuryFiles.h"
#include "Kernel/Mercury/MercuryMesh.h"

namespace pendular {

/// Planes with a solid behind all of them, as MercuryDPM's walls of several planes describe it: in the body's
/// own frame, which is put somewhere and may move.
class MercurySolid {
public:
    /// @param normal into the solid, of any length; @param point on the plane, m
    void addObject(const Vec3D& normal, const Vec3D& point) { faces.push_back({normal, point}); }
    /// Planes between each two points (m) that follow each other, along the axis. The solid is on the left of
    /// the way from one to the next, as seen against the axis.
    void createOpenPrism(const std::vector<Vec3D>& points, const Vec3D& axis);
    /// The same, also between the last and the first one.
    void createPrism(const std::vector<Vec3D>& points, const Vec3D& axis);
    /// The axis is across the first three points, so that they go round it anti-clockwise.
    void createOpenPrism(const std::vector<Vec3D>& points);
    void createPrism(const std::vector<Vec3D>& points);
    [[nodiscard]] std::size_t getNumberOfObjects() const { return faces.size(); }

    template <class S>
    void setSpecies(const S* of) {
        setSpeciesOf = [of](Wall& wall) { wall.setSpecies(of); };
    }
    /// m, where the origin of its frame is.
    void setPosition(const Vec3D& place) { position = place; }
    [[nodiscard]] const Vec3D& getPosition() const { return position; }
    /// m/s, and rad/s about its position, from the start on.
    void setVelocity(const Vec3D& value) { velocity = value; }
    void setAngularVelocity(const Vec3D& value) { spin = value; }

protected:
    /// m, of the farthest corner of a box from a point. Throws InputError where the box has no width.
    static double farthest(const char* name, const Vec3D& lowest, const Vec3D& highest, const Vec3D& from);
    /// Gives a wall the species and the motion.
    void finish(RigidWall& wall) const;

    std::vector<SolidFace> faces;
    Vec3D position = Vec3D::Zero(), velocity = Vec3D::Zero(), spin = Vec3D::Zero();  // m, m/s, rad/s

private:
    std::function<void(Wall&)> setSpeciesOf;
};

/// A normal into a solid, and a point (m) on its plane.
struct normalAndPosition {
    Vec3D normal, position;
};

/// The solid behind several planes: a TriangleWall of intersectionOfHalfSpaces().
class IntersectionOfWalls : public MercurySolid {
public:
    IntersectionOfWalls() = default;
    template <class S>
    IntersectionOfWalls(const std::vector<normalAndPosition>& walls, const S* of) {
        setSpecies(of);
        for (const normalAndPosition& wall : walls) addObject(wall.normal, wall.position);
    }
    /// The wall itself. Faces without end are cut off at the distance of the box's diagonal from its middle.
    /// Throws InputError where the box has no width.
    [[nodiscard]] TriangleWall inDomain(const Vec3D& lowest, const Vec3D& highest) const;
};

/// A solid that MercuryDPM has as distances on a grid; here with its plane faces: a cube, or an octahedron
/// with its corners on the axes, of this radius (m, from the middle to a face of the cube, or to a corner).
class LevelSetWall : public IntersectionOfWalls {
public:
    enum class Shape { Cube, Diamond };
    template <class S>
    LevelSetWall(Shape shape, double radius, const S* of) {
        setSpecies(of);
        for (const double x : {-1.0, 1.0})
            for (const double y : {-1.0, 1.0})
                for (const double z : {-1.0, 1.0})
                    if (shape == Shape::Diamond) addObject({x, y, z}, Vec3D(-x * radius, 0, 0));
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0})
                if (shape == Shape::Cube)
                    addObject(side * Vec3D::Unit(axis), -side * radius * Vec3D::Unit(axis));
    }
};

/// The solid that a convex profile makes by turning about an axis: an AxisymmetricWall. Normals and points
/// are (distance from the axis, 0, place along it), as there; the part at negative distances is left out.
class AxisymmetricIntersectionOfWalls : public MercurySolid {
public:
    AxisymmetricIntersectionOfWalls() = default;
    template <class S>
    AxisymmetricIntersectionOfWalls(const Vec3D& place, const Vec3D& direction,
                                    const std::vector<normalAndPosition>& walls, const S* of) {
        setSpecies(of), setPosition(place), setAxis(direction);
        for (const normalAndPosition& wall : walls) addObject(wall.normal, wall.position);
    }
    /// @param direction of any length
    void setAxis(const Vec3D& direction) { axis = direction; }
    void setOrientationViaNormal(const Vec3D& direction) { axis = direction; }
    /// The wall itself. A profile without end is cut off at four times the distance of the box's farthest
    /// corner from its position. Throws InputError where the box has no width, or no part of the profile is
    /// in it.
    [[nodiscard]] AxisymmetricWall inDomain(const Vec3D& lowest, const Vec3D& highest) const;

private:
    Vec3D axis{0, 0, 1};
};

/// A mesh from a file, as one wall.
class TriangulatedWall {
public:
    template <class S>
    TriangulatedWall(const std::filesystem::path& file, const S* of) {
        wall.set(readMercuryMesh(file, 1));
        wall.setSpecies(of);
    }
    bool getDistanceAndNormal(const SphericalParticle& grain, double& distance, Vec3D& normal) const {
        return wall.getDistanceAndNormal(grain, distance, normal);
    }
    [[nodiscard]] const TriangleWall& getWall() const { return wall; }
    void write(std::ostream& to) const = delete;  // ParaViewOutput has walls

private:
    TriangleWall wall;
};

/// The walls of a MercuryScene, by pointers as in MercuryDPM. The forces on all of them are kept:
/// wall->getForce().
class MercuryWallHandler {
public:
    MercuryWallHandler(WallHandler& ofScene, const MercuryDomain& inScene,
                       std::shared_ptr<MercurySettings> ofFiles)
        : walls(&ofScene), domain(&inScene), settings(std::move(ofFiles)) {
        walls->keepForces();
    }
    MercuryWallHandler(const MercuryWallHandler&) = delete;

    template <class Shape>
    requires std::derived_from<Shape, Wall> Shape* copyAndAddObject(const Shape& wall) {
        return walls->copyAndAddObject(wall);
    }
    TriangleWall* copyAndAddObject(const TriangulatedWall& mesh) {
        return walls->copyAndAddObject(mesh.getWall());
    }
    /// A copy of what a pointer shows.
    template <class Shape>
    auto copyAndAddObject(const Shape* wall) {
        return copyAndAddObject(*wall);
    }
    template <class Other>
    requires(!std::derived_from<Other, Wall> && !std::derived_from<Other, MercurySolid> &&
             !std::is_pointer_v<Other>) void copyAndAddObject(const Other&) {
        static_assert(std::derived_from<Other, Wall>,
                      "a wall is added to wallHandler, a boundary is added to boundaryHandler");
    }
    TriangleWall* copyAndAddObject(const IntersectionOfWalls& solid) {
        return walls->copyAndAddObject(solid.inDomain(domain->getLowest(), domain->getHighest()));
    }
    AxisymmetricWall* copyAndAddObject(const AxisymmetricIntersectionOfWalls& solid) {
        return walls->copyAndAddObject(solid.inDomain(domain->getLowest(), domain->getHighest()));
    }
    /// Adds a mesh from a file (STL, or VTK in its old text form) as one wall; there each triangle is one.
    /// Throws InputError.
    /// @param scale m for one unit of the file; @param shift m; @param velocity m/s; @param spin rad/s, about
    /// the origin of the file after the shift
    template <class S>
    TriangleWall* readTriangleWall(const std::filesystem::path& file, const S* of, double scale = 1,
                                   const Vec3D& shift = Vec3D::Zero(), const Vec3D& velocity = Vec3D::Zero(),
                                   const Vec3D& spin = Vec3D::Zero()) {
        TriangleWall mesh;
        mesh.set(readMercuryMesh(file, scale, shift));
        mesh.setSpecies(of);
        if (velocity != Vec3D::Zero()) mesh.setVelocity(velocity);
        if (spin != Vec3D::Zero()) mesh.setAngularVelocity(spin, shift);
        return walls->copyAndAddObject(mesh);
    }
    /// Throws InputError if there is no such wall, or if it is a membrane, which is none of MercuryDPM's.
    [[nodiscard]] RigidWall* getObject(std::size_t number) const;
    /// The one that was added last, of those that there are. Throws InputError if there is none.
    [[nodiscard]] RigidWall* getLastObject() const;
    /// Those that there are.
    [[nodiscard]] std::size_t getNumberOfObjects() const;
    [[nodiscard]] std::size_t getSize() const { return getNumberOfObjects(); }
    void removeObject(std::size_t number) { walls->removeObject(number); }
    void clear() { walls->clear(); }
    /// Files for ParaView, of grains, contacts and walls together: addOutput(ParaViewOutput()).
    void setWriteVTK(bool write = true) { settings->picturesOfWalls = write; }
    void setWriteVTK(FileType type) { setWriteVTK(type != FileType::NO_FILE); }

    /// The kernel's own handler.
    operator WallHandler&() const { return *walls; }  // NOLINT(google-explicit-constructor)

private:
    WallHandler* walls;
    const MercuryDomain* domain;
    std::shared_ptr<MercurySettings> settings;
};

}  // namespace pendular
