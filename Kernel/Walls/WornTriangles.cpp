#include "Kernel/Walls/WornTriangles.h"

#include <algorithm>

namespace pendular {

WornTriangles::WornTriangles(const MeshTriangles& given, const WearLaw& law)
    : triangles(given), wearLaw(law), wear(given.corners.size()) {
    measure();
    for (std::size_t t = 0; t < wear.size(); ++t) {
        const auto [a, b, c] = triangle(t);
        wear[t].area = 0.5 * norm(cross(b - a, c - a));
        const std::uint32_t part = triangles.partOf[t];
        if (part >= trianglesOf.size()) trianglesOf.resize(part + 1);
        trianglesOf[part].push_back(static_cast<std::uint32_t>(t));
    }
}

void WornTriangles::measure() {
    std::vector<Box> boxes(triangles.corners.size());
    Box all;
    gradients.resize(boxes.size());
    for (std::size_t t = 0; t < boxes.size(); ++t) {
        gradients[t] = gradientsOf(t);
        for (const Vector<double>& corner : triangle(t)) boxes[t].include(corner), all.include(corner);
    }
    tree = BoxTree(boxes);
    // Points lie on the surface but for round-off; where a grain has just left it, cornersAt() looks
    // farther.
    tolerance = 1e3 * meshTolerance * norm(all.highest - all.lowest);
}

Triangle WornTriangles::triangle(std::size_t number) const {
    const auto& [a, b, c] = triangles.corners[number];
    return {triangles.vertices[a], triangles.vertices[b], triangles.vertices[c]};
}

/// The weight of corner a at a point p is dot(2A, (b - p) x (c - p)) / |2A|^2, with 2A = (b - a) x (c - a).
WornTriangles::Gradients WornTriangles::gradientsOf(std::size_t number) const {
    const auto [a, b, c] = triangle(number);
    const Vector<double> twice = cross(b - a, c - a);
    const double inverse = 1 / squaredNorm(twice);
    return {inverse * cross(twice, c - b), inverse * cross(twice, a - c), c};
}

std::array<double, 3> WornTriangles::weightsAt(std::size_t number, const Vector<double>& point) const {
    const Gradients& of = gradients[number];
    const Vector<double> way = point - of.last;
    const double a = dot(of.first, way), b = dot(of.second, way);
    return {a, b, 1 - a - b};
}

/// Points on an edge belong to both of its triangles but for round-off: the one with the largest of the
/// smallest weights has them, of equal ones the first.
WornTriangles::Corners WornTriangles::cornersAt(std::uint32_t part, const Vector<double>& point) const {
    constexpr std::size_t few = 16;  // of which all are looked at
    Corners best;
    double largest = -infinity;
    const auto consider = [&](std::uint32_t t) {
        if (triangles.partOf[t] != part) return;
        const std::array<double, 3> weights = weightsAt(t, point);
        const double least = std::ranges::min(weights);
        if (least < largest || (least == largest && t > best.triangle)) return;
        largest = least;
        best = {t, weights};
    };
    const std::vector<std::uint32_t>& all = trianglesOf[part];
    if (all.size() > few) tree.forEachNear(point, tolerance, consider);
    if (largest == -infinity) std::ranges::for_each(all, consider);
    return best;
}

WornTriangles::Place WornTriangles::add(std::uint32_t part, const Vector<double>& point,
                                        const ContactWear& done) {
    const Corners at = cornersAt(part, point);
    SurfaceWear& sums = wear[at.triangle];
    const double volume = wearLaw.volume(done);
    sums.slidingWork += done.slidingWork;
    sums.volume += volume;
    if (done.isImpact) {
        sums.impactWork += done.impactWork();
        sums.impacts += 1;
    }
    return {at, volume};
}

void WornTriangles::moveTo(const std::vector<Vector<double>>& vertices) {
    triangles.vertices = vertices;
    measure();
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
