#include "Kernel/Walls/WornTriangles.h"

#include <algorithm>

namespace pendular {

WornTriangles::WornTriangles(const MeshTriangles& given, const WearLaw& law)
    : triangles(given), wearLaw(law), wear(given.corners.size()) {
    makeTree();
    for (std::size_t t = 0; t < wear.size(); ++t) {
        const auto [a, b, c] = triangle(t);
        wear[t].area = 0.5 * norm(cross(b - a, c - a));
    }
}

void WornTriangles::makeTree() {
    std::vector<Box> boxes(triangles.corners.size());
    Box all;
    for (std::size_t t = 0; t < boxes.size(); ++t)
        for (const Vector<double>& corner : triangle(t)) boxes[t].include(corner), all.include(corner);
    tree = BoxTree(boxes);
    // Points lie on the surface but for round-off; where a grain has just left it, triangleAt() looks
    // farther.
    tolerance = 1e3 * meshTolerance * norm(all.highest - all.lowest);
}

Triangle WornTriangles::triangle(std::size_t number) const {
    const auto& [a, b, c] = triangles.corners[number];
    return {triangles.vertices[a], triangles.vertices[b], triangles.vertices[c]};
}

std::array<double, 3> WornTriangles::weightsAt(std::size_t number, const Vector<double>& point) const {
    const auto [a, b, c] = triangle(number);
    const Vector<double> twice = cross(b - a, c - a);
    const double inverse = 1 / squaredNorm(twice);
    const double ofA = inverse * dot(twice, cross(b - point, c - point)),
                 ofB = inverse * dot(twice, cross(c - point, a - point));
    return {ofA, ofB, 1 - ofA - ofB};
}

/// Points on an edge belong to both of its triangles but for round-off: the one with the largest of the
/// smallest weights has them, of equal ones the first.
std::uint32_t WornTriangles::triangleAt(std::uint32_t part, const Vector<double>& point) const {
    std::uint32_t best = 0;
    double largest = -infinity;
    const auto consider = [&](std::uint32_t t) {
        if (triangles.partOf[t] != part) return;
        const double least = std::ranges::min(weightsAt(t, point));
        if (least < largest || (least == largest && t > best)) return;
        largest = least;
        best = t;
    };
    tree.forEachNear(point, tolerance, consider);
    if (largest == -infinity)
        for (std::uint32_t t = 0; t < triangles.corners.size(); ++t) consider(t);
    return best;
}

WornTriangles::Place WornTriangles::add(std::uint32_t part, const Vector<double>& point,
                                        const ContactWear& done) {
    const std::uint32_t number = triangleAt(part, point);
    SurfaceWear& sums = wear[number];
    const double volume = wearLaw.volume(done);
    sums.slidingWork += done.slidingWork;
    sums.volume += volume;
    if (done.isImpact) {
        sums.impactWork += done.impactWork();
        sums.impacts += 1;
    }
    return {number, weightsAt(number, point), volume};
}

void WornTriangles::moveTo(const std::vector<Vector<double>>& vertices) {
    triangles.vertices = vertices;
    makeTree();
}

SurfaceWear WornTriangles::sum() const {
    SurfaceWear all;
    for (const SurfaceWear& each : wear) {
        all.slidingWork += each.slidingWork;
        all.impactWork += each.impactWork;
        all.impacts += each.impacts;
        all.volume += each.volume;
        all.area += each.area;
    }
    return all;
}

void WornTriangles::visitState(StateArchive& archive) {
    wearLaw.visitState(archive);
    const std::size_t count = wear.size();
    std::vector<double> areas;  // m^2
    for (const SurfaceWear& each : wear) areas.push_back(each.area);
    archive.column<double>("triangles", wear);
    archive.require(wear.size() == count, "triangles", "has not one row for each triangle");
    archive.requireFinite("triangles", wear);
    archive.require(std::ranges::equal(areas, wear, {}, {}, &SurfaceWear::area), "triangles",
                    "has other areas than the triangles of the scene");
}

}  // namespace pendular
