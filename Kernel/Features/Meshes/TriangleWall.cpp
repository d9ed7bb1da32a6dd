#include "Kernel/Features/Meshes/TriangleWall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Features/Meshes/ClosedMesh.h"
#include "Kernel/Features/Meshes/FaceSurface.h"
#include "Kernel/Features/Meshes/MeshSolid.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

struct TriangleFace {
    Vector<double> normal;     // unit
    double offset;             // m, normal . (a corner)
    Vector<double> middle;     // m, of its corners
    double radius;             // m, of its corners around the middle
    std::uint32_t begin, end;  // of its sides
};

struct TriangleMesh : FaceSurface<TriangleMesh> {
    std::vector<TriangleFace> faces;
    std::vector<FaceSide> sides;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> smoothPairs;
    Box box;
    double radius = 0;  // m, of all corners around the middle of the box
    std::size_t leftOut = 0;
    MeshTriangles triangles;

    TriangleMesh(std::span<const Triangle> given, CoplanarTriangles coplanar);

    [[nodiscard]] std::span<const FaceSide> sidesOf(const TriangleFace& face) const {
        return std::span(sides).subspan(face.begin, face.end - face.begin);
    }
    [[nodiscard]] ConvexFace faceOf(std::uint32_t part) const {
        return {faces[part].normal, faces[part].offset, sidesOf(faces[part])};
    }
    /// Without a look at the sides of a face that is out of reach.
    [[nodiscard]] WallPoint pointOf(std::uint32_t part, const Vector<double>& centre, double reach) const {
        const TriangleFace& face = faces[part];
        const double distance2 = squaredNorm(face.middle - centre), needed = reach + face.radius;
        if (distance2 > needed * needed) return {face.normal, std::sqrt(distance2) - face.radius, {0, 0, 0}};
        return faceOf(part).nearest(centre);
    }
    [[nodiscard]] bool meetSmoothly(std::uint32_t a, std::uint32_t b) const {
        return std::binary_search(smoothPairs.begin(), smoothPairs.end(),
                                  std::pair(std::min(a, b), std::max(a, b)));
    }
};

TriangleMesh::TriangleMesh(std::span<const Triangle> given, CoplanarTriangles coplanar) {
    MeshParts made = makeMeshParts(given, coplanar);
    smoothPairs = std::move(made.smoothPairs);
    size = made.size;
    leftOut = made.leftOut;
    triangles = std::move(made.triangles);
    std::vector<Box> boxes;
    for (const MeshPart& part : made.parts) {
        Vector<double> middle{0, 0, 0};
        for (const auto& corner : part.corners)
            middle += (1.0 / static_cast<double>(part.corners.size())) * corner;
        double farthest2 = 0;
        for (const auto& corner : part.corners) farthest2 = std::max(farthest2, squaredNorm(corner - middle));
        TriangleFace face{part.normal,          dot(part.normal, part.corners[0]),        middle,
                          std::sqrt(farthest2), static_cast<std::uint32_t>(sides.size()), 0};
        Box around;
        for (std::size_t k = 0; k < part.corners.size(); ++k) {
            const Vector<double> corner = part.corners[k];
            sides.push_back(sideFrom(corner, part.corners[(k + 1) % part.corners.size()], part.normal));
            around.include(corner);
        }
        face.end = static_cast<std::uint32_t>(sides.size());
        faces.push_back(face);
        boxes.push_back(around);
        box.include(around);
    }
    tree = BoxTree(boxes);
    for (const FaceSide& side : sides) radius = std::max(radius, norm(side.corner - box.middle()));
}

void TriangleWall::set(std::span<const Triangle> triangles) {
    given = mesh = std::make_shared<const TriangleMesh>(triangles, CoplanarTriangles::Merge);
    takePlace();
    if (worn) beginWear(worn->law(), motionOfVertices());
}

MassProperties TriangleWall::massProperties() const {
    requireShape("massProperties");
    const MeshTriangles& all = mesh->triangles;
    if (const auto objection = objectionToClosed(all.vertices, all.corners))
        throw InputError(fmt::format(
            "TriangleWall: it has no volume, so that its mass and inertia must be given: {}", *objection));
    std::vector<CornersOfTriangle> triangles;
    for (const auto& corners : all.corners)
        triangles.push_back({all.vertices[corners[0]], all.vertices[corners[1]], all.vertices[corners[2]]});
    return massOfMesh(triangles);
}

void TriangleWall::setFreeBody(double density) {
    requireShape("setFreeBody");
    checkValue("TriangleWall", "density of the free body", density, "kg/m^3", positive);
    const MassProperties solid = massProperties();
    beginFreeBody(density * solid.volume, solid.centre, density * solid.inertia, {});
}

void TriangleWall::keepWear(const WearLaw& law) {
    refuseWearInRun();
    beginWear(law, {});
}

void TriangleWall::keepWear(const WearLaw& law, const VertexMotion& motion) {
    refuseWearInRun();
    beginWear(law, motion);
}

void TriangleWall::refuseWearInRun() const {
    if (!mesh) throw InputError("TriangleWall: there is no shape that wears; call set() before keepWear().");
    if (isInRun())
        throw InputError(
            "TriangleWall: wear is kept from the start of a run or not at all; call keepWear() at set-up.");
}

std::optional<VertexMotion> TriangleWall::motionOfVertices() const {
    return moving ? std::optional(moving->motionOfVertices()) : std::nullopt;
}

void TriangleWall::beginWear(WearLaw law, std::optional<VertexMotion> motion) {
    noted.clear();
    moving.reset();
    worn.emplace(mesh->triangles, law);
    if (!motion) return;
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < worn->size(); ++t) triangles.push_back(worn->triangle(t));
    given = mesh = std::make_shared<const TriangleMesh>(triangles, CoplanarTriangles::Keep);
    worn.emplace(mesh->triangles, law);  // each triangle is a part
    moving.emplace(mesh->triangles, *motion);
    vertices = mesh->triangles.vertices;
}

void TriangleWall::placeVertices(std::vector<Vector<double>> places) {
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : worn->mesh().corners) triangles.push_back({places[a], places[b], places[c]});
    const auto moved = std::make_shared<const TriangleMesh>(triangles, CoplanarTriangles::Keep);
    if (moved->leftOut > 0)
        throw RunError(
            "Wear has taken the area of a triangle of a TriangleWall: end the run before, or take larger "
            "triangles.");
    mesh = moved;
    vertices = std::move(places);
    worn->moveTo(vertices);
}

const WornVertices& TriangleWall::getWornVertices() const {
    if (!moving)
        throw InputError("TriangleWall: its vertices do not move; call keepWear() with a motion at set-up.");
    return *moving;
}

const WornTriangles& TriangleWall::getWear() const {
    if (!worn) throw InputError("TriangleWall: its wear is not kept; call keepWear() at set-up.");
    return *worn;
}

void TriangleWall::takeWear(std::uint32_t partMet, const Vector<double>& point, const ContactWear& done) {
    if (done.slidingWork == 0 && !done.isImpact) return;
    const std::uint32_t part = partOfShape(partMet);
    if (moving && dot(getPose().turn(mesh->faces[part].normal), done.towards) > 0)
        throw RunError(fmt::format(
            "A grain wears triangle {} of a TriangleWall from behind: where vertices move, grains must be on "
            "the side to which the normals point; turn the triangle's corners round, or give the other side "
            "triangles of its own.",
            part));
    noted.push_back({part, getPose().placeBack(point - imageShift(partMet, point)), done});
}

/// The vertices first, which may fail: by what was worn off before this step.
void TriangleWall::finishStep(double time) {
    if (moving && moving->isDue(time)) {
        std::vector<Vector<double>> moved = vertices;
        WornVertices after = *moving;
        shapeShift = after.move(moved, time);
        if (shapeShift > 0) placeVertices(std::move(moved));
        *moving = std::move(after);
    }
    for (const Note& note : noted) {
        const WornTriangles::Place place = worn->add(note.part, note.point, note.done);
        if (moving) moving->add(worn->mesh().corners[place.at.triangle], place.at.weights, place.volume);
    }
    noted.clear();
}

void TriangleWall::join(double time) {
    if (worn) beginWear(worn->law(), motionOfVertices());
    RigidWall::join(time);
}

void TriangleWall::visitState(StateArchive& archive) {
    RigidWall::visitState(archive);
    archive.require(worn || archive.isWriting() || !archive.holds("wear/law"), "wear",
                    "is kept in the file, and the wall of the scene keeps none: call keepWear()");
    archive.require(moving || archive.isWriting() || !archive.holds("wornVertices/acceleration"), "wear",
                    "moves the vertices in the file, and those of the scene stay: call keepWear() with a "
                    "motion");
    if (worn) archive.group("wear", [&] { worn->visitState(archive); });
    if (!moving) return;
    archive.group("wornVertices", [&] { moving->visitState(archive, vertices); });
    if (archive.isReading()) placeVertices(vertices);
}

std::size_t TriangleWall::getNumberOfTriangles() const { return mesh ? mesh->triangles.corners.size() : 0; }
std::size_t TriangleWall::getNumberOfParts() const { return mesh ? mesh->faces.size() : 0; }
std::size_t TriangleWall::getNumberLeftOut() const { return mesh ? mesh->leftOut : 0; }

std::optional<Vector<double>> TriangleWall::facetNormal(std::uint32_t part) const {
    return getPose().turn(mesh->faces[partOfShape(part)].normal);
}

std::vector<OpenEdge> TriangleWall::openEdges() const {
    struct Use {
        std::array<std::uint32_t, 2> ends;
        std::uint32_t triangle;
    };
    const MeshTriangles& triangles = mesh->triangles;
    std::vector<Use> uses;
    for (std::uint32_t t = 0; t < triangles.corners.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangles.corners[t][k], b = triangles.corners[t][(k + 1) % 3];
            uses.push_back({{std::min(a, b), std::max(a, b)}, t});
        }
    std::stable_sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.ends < b.ends; });
    std::vector<OpenEdge> open;
    for (std::size_t k = 0; k < uses.size(); ++k) {
        const auto& [ends, triangle] = uses[k];
        if ((k > 0 && uses[k - 1].ends == ends) || (k + 1 < uses.size() && uses[k + 1].ends == ends))
            continue;
        open.push_back({triangles.partOf[triangle], getPose().place(triangles.vertices[ends[0]]),
                        getPose().place(triangles.vertices[ends[1]])});
    }
    return open;
}

void TriangleWall::listInBody(const Vector<double>& centre, double reach,
                              std::vector<std::uint32_t>& parts) const {
    mesh->listParts(centre, reach, parts);
}

void TriangleWall::findInBody(const Vector<double>& centre, double reach,
                              std::span<const std::uint32_t> parts, std::span<WallPoint> points) const {
    mesh->findPoints(centre, reach, parts, points);
}

bool TriangleWall::isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const {
    return mesh->isCrossed(from, to);
}

void TriangleWall::visitShape(StateArchive& archive) const {
    std::vector<Vector<double>> corners;
    for (const FaceSide& side : given->sides) corners.push_back(side.corner);
    archive.same("shape", "TriangleWall");
    archive.same("parts", given->faces.size());
    archive.same<double>("corners", std::span<const Vector<double>>(corners));
}

SurfaceExtent TriangleWall::extent() const {
    return {.symmetry = SurfaceExtent::Symmetry::None,
            .centre = mesh->box.middle(),
            .radius = mesh->radius,
            .half = 0.5 * (mesh->box.highest - mesh->box.lowest)};
}

WallSurface TriangleWall::surfaceInBody(const SceneSphere&) const {
    WallSurface surface;
    if (worn) {
        for (std::size_t t = 0; t < worn->size(); ++t) {
            const Triangle corners = worn->triangle(t);
            surface.polygons.emplace_back(corners.begin(), corners.end());
        }
        return surface;
    }
    for (const TriangleFace& face : mesh->faces) {
        Polygon& polygon = surface.polygons.emplace_back();
        for (const FaceSide& side : mesh->sidesOf(face)) polygon.push_back(side.corner);
    }
    return surface;
}

}  // namespace pendular
