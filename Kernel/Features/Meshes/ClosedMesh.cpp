#include "Kernel/Features/Meshes/ClosedMesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pendular {

std::optional<std::string> objectionToClosed(std::span<const Vector<double>> vertices,
                                             std::span<const std::array<std::uint32_t, 3>> corners) {
    struct Uses {
        int count = 0, balance = 0;  // along an edge; forwards minus backwards
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Uses> edges;
    for (const auto& triangle : corners)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
            Uses& uses = edges[std::minmax(from, to)];
            ++uses.count;
            uses.balance += from < to ? 1 : -1;
        }
    for (const auto& [edge, uses] : edges) {
        const auto [count, balance] = uses;
        if (count == 2 && balance == 0) continue;
        const Vector<double>&a = vertices[edge.first], &b = vertices[edge.second];
        const std::string place = fmt::format("the edge from ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m", a.x,
                                              a.y, a.z, b.x, b.y, b.z);
        if (count == 2)
            return fmt::format("the triangles at {} show different sides; turn one of them.", place);
        return fmt::format("the mesh is not closed, as {} belongs to {} {}; it must belong to two.", place,
                           count, count == 1 ? "triangle" : "triangles");
    }
    return {};
}

}  // namespace pendular
