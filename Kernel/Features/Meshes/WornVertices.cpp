#include "Kernel/Features/Meshes/WornVertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {
namespace {

using Points = std::span<const Vector<double>>;

/// m^2, the area of a triangle times its normal.
Vector<double> areaOf(const std::array<std::uint32_t, 3>& c, Points p) {
    return 0.5 * cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]);
}

}  // namespace

/// While its corners go straight, the velocity in a triangle is linear, so that its flux is that of the mean
/// of the corners; the area is of second order in time, for which Simpson's rule is exact.
double sweptVolume(std::span<const std::array<std::uint32_t, 3>> corners, Points from, Points to) {
    std::vector<Vector<double>> middle(from.size());
    for (std::size_t v = 0; v < from.size(); ++v) middle[v] = 0.5 * (from[v] + to[v]);
    double sum = 0;
    for (const auto& c : corners) {
        Vector<double> way{0, 0, 0};
        for (const std::uint32_t v : c) way += (1.0 / 3) * (to[v] - from[v]);
        sum -= dot(way, (1.0 / 6) * (areaOf(c, from) + 4.0 * areaOf(c, middle) + areaOf(c, to)));
    }
    return sum;
}

WornVertices::WornVertices(const MeshTriangles& mesh, const VertexMotion& given)
    : motion(given), triangles(mesh.corners), waiting(mesh.vertices.size()) {
    checkValue("TriangleWall", "interval between two moves of vertices", motion.interval, "s", positive);
    checkValue("TriangleWall", "acceleration of wear", motion.acceleration, "", positive);
    checkValue("TriangleWall", "largest share of an edge", motion.largestShare, "", positiveUpTo(0.5));
    checkValue("TriangleWall", "smoothing of wear", motion.smoothing, "", fromZeroTo(1));
    listEdges();
}

void WornVertices::listEdges() {
    std::map<std::array<std::uint32_t, 2>, std::size_t> sides;  // from corner to corner, and their triangles
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::array<std::uint32_t, 2> side{triangles[t][k], triangles[t][(k + 1) % 3]};
            const auto [found, isNew] = sides.emplace(side, t);
            if (!isNew)
                throw InputError(fmt::format(
                    "TriangleWall: triangles {} and {} share an edge and have their normals to different "
                    "sides, or a third one shares it; vertices move only in a surface that has its "
                    "material on one side.",
                    found->second, t));
        }
    edgesAt.resize(waiting.size());
    for (const auto& [side, triangle] : sides) {
        if (side[0] > side[1] && sides.contains({side[1], side[0]})) continue;
        edges.push_back(side);
        ++edgesAt[side[0]], ++edgesAt[side[1]];
    }
}

void WornVertices::add(const Corners& corners, const std::array<double, 3>& weights, double volume) {
    std::array<double, 3> share;  // beside the triangle: of the nearest corners
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += share[k] = std::max(weights[k], 0.0);
    for (std::size_t k = 0; k < 3; ++k) waiting[corners[k]] += motion.acceleration * volume * share[k] / sum;
}

bool WornVertices::isDue(double time) const {
    return std::floor(time / motion.interval) > static_cast<double>(moves);
}

double WornVertices::pending() const {
    double sum = 0;
    for (const double volume : waiting) sum += volume;
    return sum;
}

std::vector<Vector<double>> WornVertices::areasAround(Points vertices) const {
    std::vector<Vector<double>> areas(vertices.size(), {0, 0, 0});
    for (const Corners& c : triangles)
        for (const std::uint32_t v : c) areas[v] += (1.0 / 3) * areaOf(c, vertices);
    return areas;
}

std::vector<double> WornVertices::shortestEdges(Points vertices) const {
    std::vector<double> shortest(vertices.size(), infinity);
    for (const auto& [a, b] : edges)
        for (const std::uint32_t v : {a, b})
            shortest[v] = std::min(shortest[v], norm(vertices[a] - vertices[b]));
    return shortest;
}

/// Diffusion of the depths along the edges, which keeps the sum of the volumes. A vertex gives to each of its
/// neighbours at most its part of half its volume, so that no depth changes its sign.
void WornVertices::smooth(Points areas) {
    if (motion.smoothing == 0) return;
    std::vector<double> change(waiting.size());
    const auto reach = [&](std::uint32_t v) { return norm(areas[v]) / edgesAt[v]; };
    for (const auto& [a, b] : edges) {
        if (!(norm(areas[a]) > 0 && norm(areas[b]) > 0)) continue;
        const double difference = waiting[a] / norm(areas[a]) - waiting[b] / norm(areas[b]);
        const double flow = 0.5 * motion.smoothing * std::min(reach(a), reach(b)) * difference;
        change[a] -= flow, change[b] += flow;
    }
    for (std::size_t v = 0; v < waiting.size(); ++v) waiting[v] += change[v];
}

/// To first order a vertex that goes a depth h against its normal takes off h times its area; where
/// neighbours move too, all depths are scaled until the volume is right.
double WornVertices::move(std::span<Vector<double>> vertices, double time) {
    moves = static_cast<std::uint64_t>(std::floor(time / motion.interval));
    const std::vector<Vector<double>> from(vertices.begin(), vertices.end()), areas = areasAround(from);
    const std::vector<double> edge = shortestEdges(from);
    smooth(areas);
    std::vector<double> depth(from.size()), taken(from.size());  // m, m^3
    double asked = 0;
    for (std::size_t v = 0; v < from.size(); ++v) {
        const double area = norm(areas[v]), most = motion.largestShare * edge[v];
        if (!(area > 0)) continue;
        depth[v] = std::clamp(waiting[v] / area, -most, most);
        taken[v] = depth[v] * area;
        asked += taken[v];
    }
    if (!(asked > 0)) return 0;
    constexpr int mostScalings = 20;  // each leaves the square of the curvature over the edge of the error
    double scale = 1, swept = 0;
    for (int k = 0; k < mostScalings; ++k) {
        for (std::size_t v = 0; v < from.size(); ++v)
            if (depth[v] != 0) vertices[v] = from[v] - (scale * depth[v] / norm(areas[v])) * areas[v];
        swept = sweptVolume(triangles, from, vertices);
        if (!(swept > 0) || std::abs(swept - asked) <= 1e-14 * asked) break;
        scale *= asked / swept;
    }
    if (!(swept > 0)) {  // so wavy that they would add volume: they wait
        std::ranges::copy(from, vertices.begin());
        return 0;
    }
    refuseTurned(from, vertices);
    double farthest = 0;
    for (std::size_t v = 0; v < from.size(); ++v) {
        waiting[v] -= taken[v] * (swept / asked);
        farthest = std::max(farthest, norm(vertices[v] - from[v]));
    }
    volumeRemoved += swept;
    return farthest;
}

void WornVertices::refuseTurned(Points before, Points after) const {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const Vector<double> then = areaOf(triangles[t], before), now = areaOf(triangles[t], after);
        // In one move: by less than 60 degrees, and not to a tenth of its area.
        if (dot(then, now) > 0.5 * norm(then) * norm(now) && norm(now) > 0.1 * norm(then)) continue;
        throw RunError(fmt::format(
            "Wear has turned triangle {} of a TriangleWall by more than 60 degrees in one move, or taken "
            "its area: end the run before, take a smaller share of an edge for a move, more "
            "smoothing, or larger triangles.",
            t));
    }
}

void WornVertices::visitState(StateArchive& archive, std::vector<Vector<double>>& vertices) {
    archive.same("moveInterval", motion.interval, "s");
    archive.same("acceleration", motion.acceleration);
    archive.same("largestShare", motion.largestShare);
    archive.same("smoothing", motion.smoothing);
    const std::size_t count = waiting.size();
    archive.column<double>("vertices", vertices);
    archive.column<double>("waiting", waiting);
    archive.require(vertices.size() == count && waiting.size() == count, "vertices",
                    "has not one row for each vertex");
    archive.requireFinite("vertices", vertices);
    archive.requireFinite("waiting", waiting);
    archive.finite("volumeRemoved", volumeRemoved);
    archive.value("moves", moves);
}

}  // namespace pendular
