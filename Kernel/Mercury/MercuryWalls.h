#pragma once

#include <memory>
#include <vector>

#include "Kernel/Mercury/MercuryDomain.h"
#include "Kernel/Mercury/MercuryFiles.h"
#include "Kernel/Walls/IntersectionOfHalfSpaces.h"
#include "Kernel/Walls/TriangleWall.h"
#include "Kernel/Walls/WallHandler.h"

namespace pendular {

/// The solid behind several planes, as a driver describes it: a TriangleWall of intersectionOfHalfSpaces().
class IntersectionOfWalls {
public:
    /// @param normal into the solid, of any length; @param point on the plane, m
    void addObject(const Vec3D& normal, const Vec3D& point) { faces.push_back({normal, point}); }
    template <class S>
    void setSpecies(const S* ofWall) {
        forWall.setSpecies(ofWall);
    }
    /// The wall itself. Faces without end are cut off at the distance of the box's diagonal from its middle.
    /// Throws InputError where the box has no width.
    [[nodiscard]] TriangleWall inDomain(const Vec3D& lowest, const Vec3D& highest) const;

private:
    std::vector<SolidFace> faces;
    TriangleWall forWall;  // has the species
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
    template <class Other>
    requires(!std::derived_from<Other, Wall>) void copyAndAddObject(const Other&) {
        static_assert(std::derived_from<Other, Wall>,
                      "a wall is added to wallHandler, a boundary is added to boundaryHandler");
    }
    TriangleWall* copyAndAddObject(const IntersectionOfWalls& solid) {
        return walls->copyAndAddObject(solid.inDomain(domain->getLowest(), domain->getHighest()));
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
