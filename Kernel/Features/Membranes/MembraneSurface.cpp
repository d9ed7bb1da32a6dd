#include "Kernel/Features/Membranes/MembraneSurface.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

TriangleWeights::TriangleWeights(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c,
                                 const Vector<double>& point) {
    const Vector<double> twice = cross(b - a, c - a);
    const double squared = squaredNorm(twice);
    normal = (1 / std::sqrt(squared)) * twice;
    gradient = {(1 / squared) * cross(twice, c - b), (1 / squared) * cross(twice, a - c),
                (1 / squared) * cross(twice, b - a)};
    share[0] = dot(gradient[0], point - b);
    share[1] = dot(gradient[1], point - c);
    share[2] = 1 - share[0] - share[1];
}

/// The gradients g have sum g = 0 and sum x g^T = 1 in the plane: so forces n (g.q) with q = n x couple have
/// the couple q x n, and forces n x g have the couple 2 n.
std::array<Vector<double>, 3> TriangleWeights::forces(const Vector<double>& force,
                                                      const Vector<double>& couple) const {
    const Vector<double> arm = cross(normal, couple);
    const double around = 0.5 * dot(normal, couple);
    std::array<Vector<double>, 3> result;
    for (std::size_t k = 0; k < 3; ++k)
        result[k] = share[k] * force + dot(gradient[k], arm) * normal + around * cross(normal, gradient[k]);
    return result;
}

MembraneSurface::MembraneSurface(std::vector<Corners> triangles,
                                 std::span<const std::array<std::uint32_t, 2>> neighbours,
                                 std::span<const Point> at)
    : corners(std::move(triangles)) {
    for (const auto& [a, b] : neighbours) pairs.push_back({std::min(a, b), std::max(a, b)});
    std::sort(pairs.begin(), pairs.end());
    update(at);
    tree = BoxTree(boxes);
}

void MembraneSurface::update(std::span<const Point> at, int threads) {
    constexpr std::size_t worthAThread = 512;
    faces.resize(corners.size()), boxes.resize(corners.size());
    inParts(
        corners.size(), threads,
        [&](int, std::size_t first, std::size_t end) {
            for (std::size_t t = first; t < end; ++t) {
                const auto& [a, b, c] = corners[t];
                faces[t] = faceBetween(at[a], at[b], at[c]);
                boxes[t] = {};
                for (const std::uint32_t v : {a, b, c}) boxes[t].include(at[v]);
            }
        },
        worthAThread);
    all = {};
    for (const Box& box : boxes) all.include(box);
    size = norm(all.highest - all.lowest);
    tree.refit(boxes);
}

MembraneSurface::Face MembraneSurface::faceBetween(const Point& a, const Point& b, const Point& c) {
    const Point across = cross(b - a, c - a), normal = (1 / norm(across)) * across;
    return {normal, dot(normal, a), {sideFrom(a, b, normal), sideFrom(b, c, normal), sideFrom(c, a, normal)}};
}

bool MembraneSurface::meetSmoothly(std::uint32_t a, std::uint32_t b) const {
    return dot(faces[a].normal, faces[b].normal) > smoothCosine &&
           std::binary_search(pairs.begin(), pairs.end(), std::array{std::min(a, b), std::max(a, b)});
}

std::optional<MembraneSurface::Crossing> MembraneSurface::findCrossing(
    std::span<const std::array<std::uint32_t, 2>> edges, std::span<const Point> at) const {
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const std::uint32_t a = edges[e][0], b = edges[e][1];
        const Point &from = at[a], &to = at[b];
        std::optional<Crossing> found;
        tree.forEachNear(0.5 * (from + to), 0.5 * norm(to - from), [&](std::uint32_t part) {
            const auto hasCorner = [&](std::uint32_t v) { return std::ranges::count(corners[part], v) > 0; };
            if (hasCorner(a) || hasCorner(b) || (found && found->triangle < part)) return;
            if (const auto place = faceOf(part).crossing(from, to, 0)) found = {e, part, *place};
        });
        if (found) return found;
    }
    return {};
}

}  // namespace pendular
