#include "Kernel/Features/Meshes/WeldedMesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

using Point = Vector<double>;
using Index = std::uint32_t;

bool isLess(const Point& a, const Point& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Sets of points, each known by its lowest number.
class Sets {
public:
    explicit Sets(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), Index{0}); }
    Index lowest(Index k) {
        while (parent[k] != k) k = parent[k] = parent[parent[k]];
        return k;
    }
    void join(Index a, Index b) {
        const auto [low, high] = std::minmax({lowest(a), lowest(b)});
        parent[high] = low;
    }

private:
    std::vector<Index> parent;
};

/// Two points are no nearer to each other than along a direction; along this one, which is none of those that
/// edges and planes of parts have, few points are as near. False, with nothing joined, where many are: a mesh
/// that is small against the tolerance, as beside a corner that lies astray.
bool joinAlong(std::span<const Point> points, const Point& origin, double distance, Sets& sets) {
    constexpr Point direction{0.7265173980555677, 0.5484317579318064, 0.41399888552313313};  // of length 1
    constexpr std::size_t mostForEach = 64;
    std::vector<double> along(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) along[k] = dot(direction, points[k] - origin);
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return along[a] != along[b] ? along[a] < along[b] : a < b; });
    const double window = 1.001 * distance;  // for round-off, which is 1e-7 of it
    std::size_t pairs = 0;
    for (std::size_t i = 0, end = 0; i < order.size(); ++i) {
        while (end < order.size() && along[order[end]] - along[order[i]] <= window) ++end;
        pairs += end - i;
    }
    if (pairs > mostForEach * points.size()) return false;
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t k = i + 1; k < order.size() && along[order[k]] - along[order[i]] <= window; ++k)
            if (squaredNorm(points[order[k]] - points[order[i]]) <= distance * distance)
                sets.join(order[i], order[k]);
    return true;
}

/// Joins points that are near each other, by cells that are so small that all in one are near each other: of
/// two cells, one pair decides.
void joinByCells(std::span<const Point> points, const Point& origin, double distance, Sets& sets) {
    using Cell = std::array<std::int64_t, 3>;
    const double side = distance / 1.7321;  // over sqrt(3): no diagonal is longer than the distance
    std::map<Cell, std::vector<Index>> cells;
    for (Index k = 0; k < points.size(); ++k) {
        const Point p = (1 / side) * (points[k] - origin);
        cells[{std::llround(p.x), std::llround(p.y), std::llround(p.z)}].push_back(k);
    }
    const auto joinFirst = [&](const std::vector<Index>& first, const std::vector<Index>& second) {
        for (const Index a : first)
            for (const Index b : second) {
                if (sets.lowest(a) == sets.lowest(b)) return;
                if (squaredNorm(points[a] - points[b]) <= distance * distance) return sets.join(a, b);
            }
    };
    for (const auto& [cell, own] : cells) {
        for (const Index k : own) sets.join(own.front(), k);
        for (std::int64_t n = 63; n < 125; ++n) {  // each pair of cells within two sides once
            const auto other =
                cells.find({cell[0] + n / 25 - 2, cell[1] + n / 5 % 5 - 2, cell[2] + n % 5 - 2});
            if (other != cells.end()) joinFirst(own, other->second);
        }
    }
}

/// The lowest number of the set of each point.
std::vector<Index> joinClose(std::span<const Point> points, const Point& origin, double distance) {
    Sets sets(points.size());
    if (!joinAlong(points, origin, distance, sets)) joinByCells(points, origin, distance, sets);
    std::vector<Index> same(points.size());
    for (Index k = 0; k < points.size(); ++k) same[k] = sets.lowest(k);
    return same;
}

}  // namespace

WeldedMesh weld(std::span<const std::array<Point, 3>> triangles, std::string_view owner) {
    WeldedMesh mesh;
    std::vector<Point> all;
    all.reserve(3 * triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (const Point& p : triangles[t]) {
            if (!(squaredNorm(p) <= 1e18))
                throw InputError(
                    fmt::format("{}: a coordinate of triangle {} is not finite or above 1e9 m.", owner, t));
            all.push_back({p.x + 0.0, p.y + 0.0, p.z + 0.0});  // -0 becomes 0
        }
    if (all.empty()) return mesh;
    std::vector<Point> points = all;
    std::sort(points.begin(), points.end(), isLess);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    Point highest = mesh.lowest = points.front();
    for (const Point& p : points) {
        mesh.lowest = {std::min(mesh.lowest.x, p.x), std::min(mesh.lowest.y, p.y),
                       std::min(mesh.lowest.z, p.z)};
        highest = {std::max(highest.x, p.x), std::max(highest.y, p.y), std::max(highest.z, p.z)};
    }
    mesh.size = norm(highest - mesh.lowest);
    const std::vector<Index> same = joinClose(points, mesh.lowest, weldTolerance * mesh.size);
    std::vector<Index> number(points.size());
    for (Index k = 0; k < points.size(); ++k) {
        if (same[k] == k) mesh.vertices.push_back(points[k]);
        number[k] = same[k] == k ? static_cast<Index>(mesh.vertices.size() - 1) : number[same[k]];
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        std::array<Index, 3>& corner = mesh.corners.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = number[static_cast<std::size_t>(
                std::lower_bound(points.begin(), points.end(), all[3 * t + k], isLess) - points.begin())];
    }
    return mesh;
}

}  // namespace pendular
