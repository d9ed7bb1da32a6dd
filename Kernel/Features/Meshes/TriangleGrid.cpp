#include "Kernel/Features/Meshes/TriangleGrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Kernel/Foundation/Math/Scalar.h"

namespace pendular {

/// The weight of corner a at a point p is dot(2A, (b - p) x (c - p)) / |2A|^2, with 2A = (b - a) x (c - a).
CornerWeights::CornerWeights(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c)
    : last(c) {
    const Vector<double> twice = cross(b - a, c - a);
    const double inverse = 1 / squaredNorm(twice);
    first = inverse * cross(twice, c - b);
    second = inverse * cross(twice, a - c);
}

namespace {

constexpr double squaresOfEach = 4;  // triangle, about
constexpr std::size_t most = 1024;   // squares along an axis

using Corners = std::array<Vector<double>, 3>;

/// m, along two axes.
struct TriangleExtent {
    std::array<double, 2> low{infinity, infinity}, high{-infinity, -infinity};

    void include(const std::array<double, 2>& place) {
        for (std::size_t k = 0; k < 2; ++k) {
            low[k] = std::min(low[k], place[k]);
            high[k] = std::max(high[k], place[k]);
        }
    }
};

/// m. The gradients of two weights on the plane tell the two edges that meet in the last corner.
Corners cornersOf(const CornerWeights& of) {
    // The edge e to corner a has 1 for the first weight, and 0 for the second.
    const double aa = squaredNorm(of.first), bb = squaredNorm(of.second), ab = dot(of.first, of.second),
                 inverse = 1 / (aa * bb - ab * ab);
    return {of.last + inverse * (bb * of.first - ab * of.second),
            of.last + inverse * (aa * of.second - ab * of.first), of.last};
}

/// Whether a triangle reaches into a square, or nearly so: not where one weight is below 0 at all corners.
bool reaches(const CornerWeights& triangle, const std::array<Vector<double>, 4>& square) {
    constexpr double margin = 1e-6;  // of a weight: far above round-off
    std::array<double, 3> largest{-1, -1, -1};
    for (const Vector<double>& corner : square) {
        const std::array<double, 3> weights = triangle.at(corner);
        for (std::size_t k = 0; k < 3; ++k) largest[k] = std::max(largest[k], weights[k]);
    }
    return std::ranges::min(largest) > -margin;
}

}  // namespace

TriangleGrid::TriangleGrid(std::span<const std::uint32_t> triangles, std::span<const CornerWeights> weights) {
    // The plane of the largest triangle, whose gradients are the least.
    const CornerWeights& plane = weights[*std::ranges::min_element(
        triangles, {}, [&](std::uint32_t t) { return squaredNorm(weights[t].first); })];
    const Vector<double> normal = cross(plane.first, plane.second);
    axes[0] = (1 / norm(plane.first)) * plane.first;
    axes[1] = (1 / norm(normal)) * cross(normal, axes[0]);
    TriangleExtent all;
    std::vector<TriangleExtent> extents;  // of each of the triangles
    for (const std::uint32_t t : triangles) {
        TriangleExtent& own = extents.emplace_back();
        for (const Vector<double>& corner : cornersOf(weights[t])) {
            own.include({dot(corner, axes[0]), dot(corner, axes[1])});
            all.include({dot(corner, axes[0]), dot(corner, axes[1])});
        }
    }
    const double foot = dot(plane.last, normal) / squaredNorm(normal);
    origin = all.low[0] * axes[0] + all.low[1] * axes[1] + foot * normal;
    const std::array<double, 2> lengths{all.high[0] - all.low[0], all.high[1] - all.low[1]};
    perLength = std::sqrt(squaresOfEach * static_cast<double>(triangles.size()) / (lengths[0] * lengths[1]));
    for (std::size_t k = 0; k < 2; ++k)
        counts[k] = std::min(most, 1 + static_cast<std::size_t>(lengths[k] * perLength));
    std::vector<std::vector<std::uint32_t>> lists(counts[0] * counts[1]);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const auto range = [&](std::size_t axis) {
            return std::pair(along(extents[k].low[axis] - all.low[axis] - 0.01 / perLength, axis),
                             along(extents[k].high[axis] - all.low[axis] + 0.01 / perLength, axis));
        };
        const auto [firstU, lastU] = range(0);
        const auto [firstV, lastV] = range(1);
        for (std::size_t u = firstU; u <= lastU; ++u)
            for (std::size_t v = firstV; v <= lastV; ++v)
                if (reaches(weights[triangles[k]], squareAt(u, v)))
                    lists[u * counts[1] + v].push_back(triangles[k]);
    }
    for (const std::vector<std::uint32_t>& list : lists) {
        begins.push_back(static_cast<std::uint32_t>(found.size()));
        found.insert(found.end(), list.begin(), list.end());
    }
    begins.push_back(static_cast<std::uint32_t>(found.size()));
}

std::array<Vector<double>, 4> TriangleGrid::squareAt(std::size_t u, std::size_t v) const {
    const auto cornerAt = [&](std::size_t i, std::size_t j) {
        return origin + (static_cast<double>(i) / perLength) * axes[0] +
               (static_cast<double>(j) / perLength) * axes[1];
    };
    return {cornerAt(u, v), cornerAt(u, v + 1), cornerAt(u + 1, v), cornerAt(u + 1, v + 1)};
}

}  // namespace pendular
