#include "Kernel/Features/Insertion/MeshRegion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Features/Meshes/ClosedMesh.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

namespace {

using Point = Vector<double>;

bool isBefore(const Point& a, const Point& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Whether a ray along -x from (x, y) crosses an edge, seen along z. The edge is taken in the same direction
/// for both its triangles, so that a point is on one side of it for both.
bool crossesEdge(Point a, Point b, double x, double y) {
    if ((a.y > y) == (b.y > y)) return false;
    if (isBefore(b, a)) std::swap(a, b);
    return x > a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
}

/// Whether a point is in a triangle, seen along z; of triangles that share an edge one has a point on it.
bool covers(const Triangle& t, double x, double y) {
    return crossesEdge(t[0], t[1], x, y) != (crossesEdge(t[1], t[2], x, y) != crossesEdge(t[2], t[0], x, y));
}

std::size_t columnAlong(double x, double low, double length, std::size_t columns) {
    const double share = length > 0 ? (x - low) / length : 0;
    return static_cast<std::size_t>(
        std::clamp(share * static_cast<double>(columns), 0.0, static_cast<double>(columns - 1)));
}

Point areaOf(const Triangle& t) { return 0.5 * cross(t[1] - t[0], t[2] - t[0]); }

}  // namespace

MeshRegion::MeshRegion(std::span<const Triangle> given) {
    WeldedMesh mesh = weld(given, "MeshRegion");
    std::erase_if(mesh.corners, [](const auto& c) { return c[0] == c[1] || c[1] == c[2] || c[2] == c[0]; });
    for (const auto& [a, b, c] : mesh.corners)
        triangles.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    for (const Triangle& t : triangles)
        for (const Point& p : t) box.include(p);
    surface.set(triangles);  // throws where there is no area
    refuseUnlessClosed(mesh);
    // Gauss' law, from a corner, so that a mesh far away loses nothing.
    for (const Triangle& t : triangles) size += dot(t[0] - box.lowest, areaOf(t)) / 3;
    if (size < 0) {
        for (Triangle& t : triangles) std::swap(t[1], t[2]);
        size = -size;
    }
    makeColumns();
    refuseIfThroughItself();
}

void MeshRegion::refuseUnlessClosed(const WeldedMesh& mesh) {
    if (const auto objection = objectionToClosed(mesh.vertices, mesh.corners))
        throw InputError(fmt::format("MeshRegion: {}", *objection));
}

void MeshRegion::makeColumns() {
    columns = std::clamp<std::size_t>(
        static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles.size()))), 1, 1024);
    const Point side = box.highest - box.lowest;
    const auto columnOf = [&](double x, double low, double length) {
        return columnAlong(x, low, length, columns);
    };
    const auto forColumns = [&](const Triangle& t, auto&& function) {
        Box around;
        for (const Point& p : t) around.include(p);
        const std::size_t x1 = columnOf(around.highest.x, box.lowest.x, side.x),
                          y1 = columnOf(around.highest.y, box.lowest.y, side.y);
        for (std::size_t y = columnOf(around.lowest.y, box.lowest.y, side.y); y <= y1; ++y)
            for (std::size_t x = columnOf(around.lowest.x, box.lowest.x, side.x); x <= x1; ++x)
                function(y * columns + x);
    };
    begins.assign(columns * columns + 1, 0);
    for (const Triangle& t : triangles) forColumns(t, [&](std::size_t c) { ++begins[c + 1]; });
    for (std::size_t c = 0; c < columns * columns; ++c) begins[c + 1] += begins[c];
    members.resize(begins.back());
    std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        forColumns(triangles[t], [&](std::size_t c) { members[next[c]++] = t; });
}

std::span<const std::uint32_t> MeshRegion::column(double x, double y) const {
    const Point side = box.highest - box.lowest;
    const std::size_t c = columnAlong(y, box.lowest.y, side.y, columns) * columns +
                          columnAlong(x, box.lowest.x, side.x, columns);
    return std::span(members).subspan(begins[c], begins[c + 1] - begins[c]);
}

int MeshRegion::windings(const Point& p) const {
    if (!(box.squaredDistance(p) == 0)) return 0;
    int sum = 0;
    for (const std::uint32_t k : column(p.x, p.y)) {
        const Triangle& t = triangles[k];
        if (!covers(t, p.x, p.y)) continue;
        const Point area = areaOf(t);
        // Above the point if the point is below the triangle's plane.
        const double above = dot(area, t[0] - p);
        if (area.z > 0 && above > 0) ++sum;
        if (area.z < 0 && above < 0) --sum;
    }
    return sum;
}

void MeshRegion::refuseIfThroughItself() const {
    constexpr std::uint32_t points = 4096;
    const CountedRandom random(1);
    for (std::uint32_t k = 0; k < points; ++k) {
        const Point p = candidateOf(*this, random, k, 0, 0, 0);
        if (const int found = windings(p); found != 0 && found != 1)
            throw InputError(fmt::format(
                "MeshRegion: the mesh goes through itself, as it winds {} times around ({:g}, {:g}, {:g}) m; "
                "take one surface that does not, or one region for each part.",
                found, p.x, p.y, p.z));
    }
}

bool MeshRegion::contains(const Point& point, double margin) const {
    if (windings(point) != 1) return false;
    if (margin == 0) return true;
    thread_local std::vector<std::uint32_t> parts;
    parts.clear();
    surface.listParts(point, withRoundOff(margin), parts);
    return parts.empty();
}

/// Half of what all triangles cover: exact for a convex mesh, more for others.
double MeshRegion::areaAcross(const Point& direction) const {
    double sum = 0;
    for (const Triangle& t : triangles) sum += 0.5 * std::abs(dot(areaOf(t), direction));
    return sum;
}

/// A sphere in it has no more volume.
double MeshRegion::largestSphere() const { return std::cbrt(0.75 * size / std::numbers::pi); }

Point MeshRegion::inwards(const Point& centre, double radius) const {
    thread_local std::vector<std::uint32_t> parts;
    thread_local std::vector<WallPoint> points;
    parts.clear();
    surface.listParts(centre, radius, parts);
    if (parts.empty()) return {0, 0, 0};
    points.assign(parts.size(), {});
    surface.findPoints(centre, radius, parts, points);
    // Outside, the way in leads through the surface.
    const bool inside = windings(centre) == 1;
    Point sum{0, 0, 0};
    for (const WallPoint& point : points)
        if (point.distance < radius)
            sum +=
                inside ? -(radius - point.distance) * point.normal : (radius + point.distance) * point.normal;
    return sum;
}

std::shared_ptr<const Region> MeshRegion::in(const PeriodicBox& periodic) const {
    static_cast<void>(goesRound("MeshRegion", box, periodic));
    return std::make_shared<MeshRegion>(*this);
}

void MeshRegion::visitState(StateArchive& archive) const {
    archive.same("shape", "MeshRegion");
    archive.same("volume", size, "m^3");
    archive.sameRecord<double>("lowest", box.lowest);
    archive.sameRecord<double>("highest", box.highest);
}

}  // namespace pendular
