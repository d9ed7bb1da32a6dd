#include "Kernel/Features/Meshes/IntersectionOfHalfSpaces.h"

#include <fmt/format.h>

#include <cmath>

#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Core/Walls/WallSurface.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

std::vector<HalfSpace> checkedHalfSpaces(std::span<const SolidFace> faces) {
    std::vector<HalfSpace> halfSpaces;
    for (const SolidFace& face : faces) {
        const Vector<double> out = -checkedDirection("intersectionOfHalfSpaces", "normal", face.normal);
        halfSpaces.push_back(
            {out, dot(out, checkedVector("intersectionOfHalfSpaces", "point", face.point, "m"))});
    }
    return halfSpaces;
}

/// A square in the plane of a half-space that covers what of it is in a sphere; its corners in a ring, as
/// seen from outside.
Polygon squareIn(const SceneSphere& around, const HalfSpace& half) {
    const double height = half.offset - dot(half.normal, around.centre);
    if (std::abs(height) > around.radius) return {};
    const Vector<double> middle = around.centre + height * half.normal;
    const Vector<double> u = around.radius * anyAcross(half.normal), v = cross(half.normal, u);
    return {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
}

}  // namespace

std::vector<Triangle> intersectionOfHalfSpaces(std::span<const SolidFace> faces, const Vec3D& centre,
                                               double radius) {
    if (!(radius > 0 && radius < infinity))
        throw InputError(fmt::format(
            "intersectionOfHalfSpaces: radius of the sphere around the grains = {:.6g} m is not allowed; it "
            "must be positive and finite.",
            radius));
    const SceneSphere around{checkedVector("intersectionOfHalfSpaces", "centre", centre, "m"), radius};
    const std::vector<HalfSpace> solid = checkedHalfSpaces(faces);
    std::vector<Triangle> triangles;
    for (std::size_t k = 0; k < solid.size(); ++k) {
        std::vector<HalfSpace> others = solid;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
        const Polygon face = clipped(squareIn(around, solid[k]), others);
        for (std::size_t c = 2; c < face.size(); ++c) triangles.push_back({face[0], face[c - 1], face[c]});
    }
    if (triangles.empty())
        throw InputError(
            fmt::format("intersectionOfHalfSpaces: the {} planes bound no solid with a face in the sphere of "
                        "{:.6g} m around ({:.6g}, {:.6g}, {:.6g}) m; normals point into the solid.",
                        faces.size(), around.radius, around.centre.x, around.centre.y, around.centre.z));
    return triangles;
}

}  // namespace pendular
