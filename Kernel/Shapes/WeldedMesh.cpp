#include "Kernel/Shapes/WeldedMesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "Kernel/InputError.h"

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

/// For each point the lowest number of its set. Two points are no nearer to each other than along a
/// direction; along this one, which is none of those that edges and planes of parts have, few points are as
/// near.
std::vector<Index> joinClose(std::span<const Point> points, const Point& origin, double distance) {
    constexpr Point direction{0.7265173980555677, 0.5484317579318064, 0.41399888552313313};  // of length 1
    std::vector<double> along(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) along[k] = dot(direction, points[k] - origin);
    std::vector<Index> order(points.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(),
              [&](Index a, Index b) { return along[a] != along[b] ? along[a] < along[b] : a < b; });
    Sets sets(points.size());
    const double window = 1.001 * distance;  // for round-off, which is 1e-7 of it
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t k = i + 1; k < order.size() && along[order[k]] - along[order[i]] <= window; ++k)
            if (squaredNorm(points[order[k]] - points[order[i]]) <= distance * distance)
                sets.join(order[i], order[k]);
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
