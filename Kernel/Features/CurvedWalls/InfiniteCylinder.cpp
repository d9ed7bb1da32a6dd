#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"

#include <cmath>
#include <numbers>

#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

void InfiniteCylinder::set(const Vec3D& direction, const Vec3D& point, double radius, CylinderSide side) {
    axis = checkedDirection("InfiniteCylinder", "length of the axis' direction", direction);
    origin = checkedVector("InfiniteCylinder", "point", point, "m");
    radialOnAxis = anyAcross(axis);
    checkValue("InfiniteCylinder", "radius", radius, "m", positive);
    cylinderRadius = radius;
    inside = side == CylinderSide::Inside;
    takePlace();
}

SurfaceAtFaces InfiniteCylinder::atFaces(const PeriodicFaces& faces) const {
    return cylinderAtFaces(getPose().turn(axis), getPose().place(origin), cylinderRadius, faces);
}

void InfiniteCylinder::listInBody(const Vector<double>& centre, double reach,
                                  std::vector<std::uint32_t>& parts) const {
    if (gap(norm(across(centre))) < reach) parts.push_back(0);
}

void InfiniteCylinder::findInBody(const Vector<double>& centre, double, std::span<const std::uint32_t>,
                                  std::span<WallPoint> points) const {
    const auto [normal, distance] = nearestTo(centre);
    points[0] = {normal, distance, {0, 0, 0}};
}

void InfiniteCylinder::findEightInBody(const Vector<Pack>& centres,
                                       const std::array<std::uint32_t, Pack::lanes>&,
                                       EightWallPoints& points) const {
    const auto [normal, distance] = nearestTo(centres);
    points.normal = normal;
    points.distance = distance;
}

bool InfiniteCylinder::isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const {
    return gap(norm(across(from))) >= 0 && gap(norm(across(to))) < 0;
}

SurfaceExtent InfiniteCylinder::extent() const {
    return {SurfaceExtent::Symmetry::Cylinder, origin, infinity, axis};
}

WallSurface InfiniteCylinder::surfaceInBody(const SceneSphere& around) const {
    const Vector<double> middle = around.centre - across(around.centre);
    const Vector<double> half = around.radius * axis;
    WallSurface surface;
    surface.endless = true;
    surface.axis = axis;
    // The facets stay where they are while the cylinder turns about its axis.
    const Vector<double> a = getPose().turnBack(anyAcross(getPose().turn(axis))), b = cross(axis, a);
    surface.polygons = turnedAround(axis, a, middle - half, cylinderRadius, middle + half, cylinderRadius);
    if (!inside) return surface;
    for (int k = 0; k < facetsAround; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5) / facetsAround;
        const Vector<double> outward = std::cos(angle) * a + std::sin(angle) * b;
        surface.inside.push_back(
            {outward, dot(outward, middle) + cylinderRadius * std::cos(std::numbers::pi / facetsAround)});
    }
    return surface;
}

void InfiniteCylinder::visitShape(StateArchive& archive) const {
    archive.same("shape", "InfiniteCylinder");
    archive.sameRecord<double>("axis", axis);
    archive.sameRecord<double>("origin", origin);
    archive.same("radius", cylinderRadius, "m");
    archive.same("inside", inside);
}

}  // namespace pendular
