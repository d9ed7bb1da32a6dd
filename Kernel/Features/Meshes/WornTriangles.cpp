#include "Kernel/Features/Meshes/WornTriangles.h"

#include <algorithm>

namespace pendular {

WornTriangles::WornTriangles(const MeshTriangles& given, const WearLaw& law)
    : triangles(given), wearLaw(law), wear(given.corners.size()) {
    for (std::size_t t = 0; t < wear.size(); ++t) {
        const auto [a, b, c] = triangle(t);
        wear[t].area = 0.5 * norm(cross(b - a, c - a));
        const std::uint32_t part = triangles.partOf[t];
        if (part >= trianglesOf.size()) trianglesOf.resize(part + 1);
        trianglesOf[part].push_back(static_cast<std::uint32_t>(t));
    }
    measure();
}

void WornTriangles::measure() {
    constexpr std::size_t few = 16;  // of which all are looked at
    weights.clear();
    for (std::size_t t = 0; t < triangles.corners.size(); ++t) {
        const auto [a, b, c] = triangle(t);
        weights.emplace_back(a, b, c);
    }
    grids.resize(trianglesOf.size());
    for (std::size_t part = 0; part < grids.size(); ++part)
        if (trianglesOf[part].size() > few) grids[part].emplace(trianglesOf[part], weights);
}

Triangle WornTriangles::triangle(std::size_t number) const {
    const auto& [a, b, c] = triangles.corners[number];
    return {triangles.vertices[a], triangles.vertices[b], triangles.vertices[c]};
}

/// Points on an edge belong to both of its triangles but for round-off: the one with the largest of the
/// smallest weights has them, of equal ones the first.
WornTriangles::Corners WornTriangles::cornersAt(std::uint32_t part, const Vector<double>& point) const {
    constexpr double roundOff = 1e-9;  // of a weight
    Corners best;
    double largest = -infinity;
    const auto consider = [&](std::uint32_t t) {
        const std::array<double, 3> own = weights[t].at(point);
        const double least = std::ranges::min(own);
        if (least < largest || (least == largest && t > best.triangle)) return;
        largest = least;
        best = {t, own};
    };
    if (const std::optional<TriangleGrid>& grid = grids[part]) {
        std::ranges::for_each(grid->near(point), consider);
        if (largest > -roundOff) return best;
    }
    std::ranges::for_each(trianglesOf[part], consider);
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
