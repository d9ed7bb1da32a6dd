// Walls of triangles, what grains wear off them, and membranes.
#include <numbers>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/Meshes/IntersectionOfHalfSpaces.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/Fuzz/RandomScenes/Making.h"

namespace pendular::fuzz {

namespace {

/// A floor of triangles with normals upwards, whose corners lie at or a little below the grains. It goes on
/// beyond them on all sides, or ends at periodic faces.
std::vector<Triangle> anyFloor(Making& making) {
    const int columns = making.draw.whole(1, 3), rows = making.draw.whole(1, 3);
    const bool flat = making.draw.oneIn(3);
    Vec3D margin = 1.5 * making.scales.cell * Vec3D(1, 1, 0);
    for (const int axis : {0, 1})
        if (making.isPeriodic[static_cast<std::size_t>(axis)] && (columns + rows) % 2 == 0) margin[axis] = 0;
    const Vec3D from = making.lowest - margin, size = making.highest + margin - from;
    std::vector<Vector<double>> corners;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x) {
            const double below = flat ? 0 : making.draw.even(0, 0.2) * making.scales.radius;
            const Vec3D corner(from.x() + size.x() * x / columns, from.y() + size.y() * y / rows,
                               making.lowest.z() - below);
            corners.push_back(toVector(making.draw.give("corner", corner)));
        }
    std::vector<Triangle> triangles;
    const auto at = [&](int x, int y) { return corners[static_cast<std::size_t>(y * (columns + 1) + x)]; };
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            triangles.push_back({at(x, y), at(x + 1, y), at(x + 1, y + 1)});
            triangles.push_back({at(x, y), at(x + 1, y + 1), at(x, y + 1)});
        }
    return triangles;
}

TriangleWall anyMesh(Making& making) {
    TriangleWall mesh;
    mesh.set(anyFloor(making));
    mesh.setSpecies(making.anyMaterial());
    return mesh;
}

void addMesh(Making& making) {
    making.scene.wallHandler.copyAndAddObject(anyMesh(making))->keepForces(making.draw.oneIn(2));
}

void addMovingMesh(Making& making) {
    TriangleWall mesh = anyMesh(making);
    const double speed = 0.2 * making.scales.speed;
    if (making.draw.oneIn(2))
        mesh.setVelocity(making.draw.give("velocity", Vec3D(making.draw.inCube(speed))));
    if (making.draw.oneIn(2)) {
        const double width = (making.highest - making.lowest).norm();
        mesh.setAngularVelocity(making.draw.give("spin", Vec3D(making.draw.inCube(speed / width))),
                                making.draw.give("point", making.lowest));
    }
    making.scene.wallHandler.copyAndAddObject(mesh);
}

/// A ridge or a tip below the grains, or a trough that holds them; nearly flat, so that its images cross it
/// below all grains.
std::vector<SolidFace> anySolid(Making& making) {
    const bool holds = making.draw.oneIn(2);
    Vec3D point = making.lowest;
    if (!holds) point.x() = making.draw.even(point.x(), making.highest.x());
    const double below = making.draw.even(0, 0.2) * making.scales.radius;
    if (!making.isPeriodic[2]) point.z() -= below;  // else its images would be in the grains
    std::vector<SolidFace> faces;
    for (const int axis : {0, 1})
        for (const double side : {-1.0, 1.0}) {
            if (axis == 1 && !holds && making.draw.oneIn(2)) continue;
            if (holds && making.isPeriodic[static_cast<std::size_t>(axis)]) continue;
            Vec3D normal = side * making.draw.even(0.02, 0.2) * Vec3D::Unit(axis) - Vec3D(0, 0, 1);
            if (holds) normal = Vec3D(-side * Vec3D::Unit(axis) + Vec3D(0, 0, making.draw.even(0, 0.1)));
            if (holds) point[axis] = side < 0 ? making.lowest[axis] : making.highest[axis];
            faces.push_back({making.draw.give("normal", normal), making.draw.give("point", point)});
        }
    if (holds)
        faces.push_back({making.draw.give("normal", Vec3D(0, 0, 1)), making.draw.give("point", point)});
    return faces;
}

void addHalfSpaces(Making& making) {
    Vec3D middle = 0.5 * (making.lowest + making.highest), width = making.highest - making.lowest;
    // A mesh that is repeated is at most four periods long: that of a sphere around the floor alone.
    if (making.has("periodic")) middle.z() = making.lowest.z(), width.z() = 0;
    const double radius = 0.5 * width.norm() + making.scales.cell;
    const std::vector<SolidFace> faces = anySolid(making);
    TriangleWall wall;
    wall.set(intersectionOfHalfSpaces(faces, middle, making.draw.give("radius", radius)));
    wall.setSpecies(making.anyMaterial());
    making.scene.wallHandler.copyAndAddObject(wall)->keepForces(making.draw.oneIn(2));
}

WearLaw anyWear(Making& making) {
    switch (making.draw.whole(0, making.has("friction") ? 3 : 1)) {
        case 0:
            return WearLaw::none();
        case 1:
            return WearLaw::finnie(making.draw.give("share", 0.5), making.draw.give("stress", 1e6));
        case 2:
            return WearLaw::reye(making.draw.give("factor", 1e-9));
        default:
            return WearLaw::archard(making.draw.give("coefficient", 1e-3), making.draw.give("hardness", 1e9));
    }
}

void addWear(Making& making) {
    TriangleWall mesh = anyMesh(making);
    mesh.keepWear(anyWear(making));
    making.scene.wallHandler.copyAndAddObject(mesh);
}

void addWornVertices(Making& making) {
    TriangleWall mesh = anyMesh(making);
    mesh.keepWear(anyWear(making), {.interval = making.draw.give("interval", 0.1 * making.scales.duration),
                                    .acceleration = making.draw.give("acceleration", 10)});
    making.scene.wallHandler.copyAndAddObject(mesh);
}

void addMembrane(Making& making) {
    const double edge = making.scales.radius * making.draw.even(0.6, 1.5);
    const Vec3D width = making.highest - making.lowest;
    const int columns = static_cast<int>(width.x() / edge) + 2, rows = static_cast<int>(width.y() / edge) + 2;
    std::vector<Triangle> triangles = membraneSheet(columns, rows, edge);
    Vec3D corner = making.lowest - Vec3D(edge, edge, 0.05 * making.scales.radius);
    if (making.scene.getPeriodicBox().any()) {  // fitted to the periods, so that it goes on at its images
        triangles = membranePeriodicSheet(columns, 2 * rows, 1);
        corner += Vec3D(edge, edge, 0);
        for (Triangle& triangle : triangles)
            for (Vector<double>& point : triangle)
                point.x *= width.x() / columns, point.y *= width.y() / (std::numbers::sqrt3 * rows);
    }
    corner = making.draw.give("corner", corner);
    for (Triangle& triangle : triangles)
        for (Vector<double>& point : triangle) point += toVector(corner);
    Membrane sheet;
    sheet.set(triangles, {.youngsModulus = making.draw.give("modulus", 0.1 * making.scales.modulus),
                          .thickness = making.draw.give("thickness", 0.2 * making.scales.radius),
                          .density = making.draw.give("density", making.scales.density)});
    sheet.setSpecies(making.anyMaterial());
    if (making.draw.oneIn(2)) sheet.holdRim();
    if (making.draw.oneIn(2))
        sheet.setPressure(
            making.draw.give("pressure", 1e-6 * making.scales.modulus * making.draw.even(-1, 1)));
    if (making.draw.oneIn(2)) sheet.setDamping(making.draw.give("damping", 1 / making.scales.duration));
    Membrane* const added = making.scene.wallHandler.copyAndAddObject(sheet);
    if (!making.draw.oneIn(3)) return;
    const double later = making.draw.give("pressure later", 1e-6 * making.scales.modulus);
    making.before(making.someStep(), [added, later] { added->setPressure(later); });
}

}  // namespace

std::vector<Feature> meshFeatures() {
    constexpr unsigned both = momentum | angularMomentum;
    return {
        {.name = "Mesh", .share = 0.1, .add = addMesh, .loses = both, .kinds = {"wall", "parts"}},
        {.name = "HalfSpaces",
         .share = byName,
         .add = addHalfSpaces,
         .loses = both,
         .kinds = {"wall", "parts"}},
        {.name = "MovingMesh",
         .share = 0.07,
         .add = addMovingMesh,
         .loses = both,
         .kinds = {"wall", "parts"}},
        {.name = "Wear",
         .share = 0.06,
         .add = addWear,
         .loses = both,
         .kinds = {"wall", "parts", "wear", "ledger"}},
        {.name = "WornVertices",
         .share = 0.05,
         .add = addWornVertices,
         .loses = both,
         .kinds = {"wall", "parts", "wear", "ledger"}},
        {.name = "Membrane",
         .share = 0.05,
         .add = addMembrane,
         .loses = both,
         .kinds = {"wall", "membrane"},
         .excludes = {"WallThatGoes"}},
    };
}

}  // namespace pendular::fuzz
