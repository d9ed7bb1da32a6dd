#pragma once

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "Kernel/Core/Walls/WallSurface.h"

namespace pendular::snapshot {

/// The edges at which surfaces end or turn by more than 30 degrees. Corners nearer than 1e-6 of the size (m)
/// are one.
inline std::vector<std::pair<Vector<double>, Vector<double>>> sharpEdges(const std::vector<Polygon>& polygons,
                                                                         double size) {
    using Corner = std::array<long long, 3>;
    const auto cornerOf = [&](const Vector<double>& p) {
        return Corner{std::llround(p.x / size * 1e6), std::llround(p.y / size * 1e6),
                      std::llround(p.z / size * 1e6)};
    };
    struct Edge {
        Vector<double> begin, end, normal;  // of the first polygon
        int count = 0;
        bool sharp = false;
    };
    std::map<std::pair<Corner, Corner>, Edge> edges;
    for (const Polygon& polygon : polygons) {
        Vector<double> normal{0, 0, 0};
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
            normal += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
        normal *= 1 / norm(normal);
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vector<double>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
            if (cornerOf(a) == cornerOf(b)) continue;
            Edge& edge = edges[std::minmax(cornerOf(a), cornerOf(b))];
            if (edge.count++ == 0) edge = {a, b, normal, 1, false};
            else edge.sharp = edge.sharp || std::abs(dot(edge.normal, normal)) < std::cos(M_PI / 6);
        }
    }
    std::vector<std::pair<Vector<double>, Vector<double>>> found;
    for (const auto& [corners, edge] : edges)
        if (edge.sharp || edge.count == 1) found.emplace_back(edge.begin, edge.end);
    return found;
}

}  // namespace pendular::snapshot
