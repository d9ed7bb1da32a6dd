#include "Kernel/Mercury/MercuryWalls.h"

#include <fmt/format.h>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

void MercurySolid::createOpenPrism(const std::vector<Vec3D>& points, const Vec3D& axis) {
    faces.clear();
    for (std::size_t k = 1; k < points.size(); ++k)
        addObject(axis.cross(points[k] - points[k - 1]), points[k - 1]);
}

void MercurySolid::createPrism(const std::vector<Vec3D>& points, const Vec3D& axis) {
    createOpenPrism(points, axis);
    if (!points.empty()) addObject(axis.cross(points.front() - points.back()), points.front());
}

/// Across the first three points of a prism.
static Vec3D axisOf(const std::vector<Vec3D>& points) {
    if (points.size() < 3)
        throw InputError(fmt::format("A prism of {} points has no axis; give it the axis, or three points.",
                                     points.size()));
    return (points[1] - points[0]).cross(points[2] - points[0]);
}

void MercurySolid::createOpenPrism(const std::vector<Vec3D>& points) {
    createOpenPrism(points, axisOf(points));
}

void MercurySolid::createPrism(const std::vector<Vec3D>& points) { createPrism(points, axisOf(points)); }

double MercurySolid::farthest(const char* name, const Vec3D& lowest, const Vec3D& highest,
                              const Vec3D& from) {
    if (!((highest - lowest).norm() > 0))
        throw InputError(fmt::format(
            "{}: the domain has no width, and faces without end are cut off by it; call setMin() and "
            "setMax(), in m, before the wall is added.",
            name));
    return (lowest - from).cwiseAbs().cwiseMax((highest - from).cwiseAbs()).norm();
}

void MercurySolid::finish(RigidWall& wall) const {
    if (setSpeciesOf) setSpeciesOf(wall);
    if (velocity != Vec3D::Zero()) wall.setVelocity(velocity);
    if (spin != Vec3D::Zero()) wall.setAngularVelocity(spin, position);
}

TriangleWall IntersectionOfWalls::inDomain(const Vec3D& lowest, const Vec3D& highest) const {
    const Vec3D middle = 0.5 * (lowest + highest);
    const double reach = 2 * farthest("IntersectionOfWalls", lowest, highest, middle);
    std::vector<SolidFace> placed = faces;
    for (SolidFace& face : placed) face.point += position;
    TriangleWall wall;
    wall.set(intersectionOfHalfSpaces(placed, middle, reach));
    finish(wall);
    return wall;
}

/// The edges of a convex profile in the plane of x, the distance from the axis, and z, as one line: without
/// its edge on the axis, or if it has none, without one that was cut off at the largest distance.
static std::vector<ProfilePoint> openedProfile(const Polygon& profile, double reach) {
    const std::size_t count = profile.size();
    const auto isEdgeAt = [&](std::size_t k, double distance) {
        return profile[k].x == distance && profile[(k + 1) % count].x == distance;
    };
    std::size_t start = count;  // behind the edge that is left out
    for (const double distance : {reach, 0.0})
        for (std::size_t k = 0; k < count; ++k)
            if (isEdgeAt(k, distance)) start = k + 1;
    const bool isClosed = start == count && !isEdgeAt(count - 1, 0) && !isEdgeAt(count - 1, reach);
    std::vector<ProfilePoint> line;
    for (std::size_t k = 0; k < count + (isClosed ? 1 : 0); ++k) {
        const Vector<double>& p = profile[(start + k) % count];
        const ProfilePoint point{p.x, p.z};
        if (line.empty() || point.radius != line.back().radius || point.height != line.back().height)
            line.push_back(point);
    }
    return line;
}

AxisymmetricWall AxisymmetricIntersectionOfWalls::inDomain(const Vec3D& lowest, const Vec3D& highest) const {
    constexpr const char* name = "AxisymmetricIntersectionOfWalls";
    const double reach = 4 * farthest(name, lowest, highest, position);
    std::vector<HalfSpace> solid;
    for (const SolidFace& face : faces) {
        if (face.normal.y() != 0)
            throw InputError(fmt::format(
                "{}: normal = ({}, {}, {}); it must be (distance from the axis, 0, place along it).", name,
                face.normal.x(), face.normal.y(), face.normal.z()));
        const Vector<double> out = -checkedDirection(name, "normal", face.normal);
        solid.push_back({out, dot(out, checkedVector(name, "point", face.point, "m"))});
    }
    const Polygon profile =
        clipped({{0, 0, -reach}, {reach, 0, -reach}, {reach, 0, reach}, {0, 0, reach}}, solid);
    if (profile.size() < 3)
        throw InputError(
            fmt::format("{}: the {} planes bound no solid within {:.6g} m; normals point into it.", name,
                        faces.size(), reach));
    AxisymmetricWall wall;
    wall.set(axis, position, openedProfile(profile, reach));
    finish(wall);
    return wall;
}

RigidWall* MercuryWallHandler::getObject(std::size_t number) const {
    auto* const rigid = dynamic_cast<RigidWall*>(&walls->getObject(number));
    if (!rigid)
        throw InputError(fmt::format(
            "WallHandler: wall {} is no rigid wall; keep the pointer that copyAndAddObject() returned.",
            number));
    return rigid;
}

RigidWall* MercuryWallHandler::getLastObject() const {
    if (walls->present().empty()) throw InputError("WallHandler: there is no wall.");
    return getObject(walls->present().back().number);
}

std::size_t MercuryWallHandler::getNumberOfObjects() const { return walls->present().size(); }

}  // namespace pendular
