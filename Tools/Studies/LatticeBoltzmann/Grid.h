#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "Tools/Studies/LatticeBoltzmann/Directions.h"

namespace pendular::lattice {

/// What is beyond the two sides of a box along an axis.
enum class Sides {
    Periodic,
    Mirrored  ///< mirror planes half a node beyond the first and the last node
};

struct Box {
    Node nodes;
    std::array<Sides, 3> sides;
};

/// Which node of the box is seen at a place in or just beyond it.
struct Seen {
    Node node;
    std::array<bool, 3> isMirrored;
};

/// The nodes of a box with one layer of ghosts around them, x fastest. Node (i, j, k) lies at (i + 1/2, j +
/// 1/2, k + 1/2): a mirror plane is at 0.
class Grid {
public:
    /// Throws InputError for sides of less than one node, or more than two thousand million sites.
    explicit Grid(const Box& box);

    [[nodiscard]] const Box& box() const { return given; }
    /// With the ghosts.
    [[nodiscard]] std::size_t size() const {
        return steps[2] * (static_cast<std::size_t>(given.nodes[2]) + 2);
    }
    [[nodiscard]] std::size_t at(const Node& node) const {
        return static_cast<std::size_t>(node[0] + 1) + steps[1] * static_cast<std::size_t>(node[1] + 1) +
               steps[2] * static_cast<std::size_t>(node[2] + 1);
    }
    /// How far the neighbour in a direction is in memory.
    [[nodiscard]] std::ptrdiff_t offset(std::size_t direction) const {
        const Node& c = velocities[direction];
        return c[0] + c[1] * static_cast<std::ptrdiff_t>(steps[1]) +
               c[2] * static_cast<std::ptrdiff_t>(steps[2]);
    }
    [[nodiscard]] Seen seenAt(Node node) const;

    /// Calls function(node) for all nodes of the box, and with `layers` = 1 for the ghosts too.
    template <class Function>
    void forEachNode(Function&& function, int layers = 0) const {
        for (int k = -layers; k < given.nodes[2] + layers; ++k)
            for (int j = -layers; j < given.nodes[1] + layers; ++j)
                for (int i = -layers; i < given.nodes[0] + layers; ++i) function(Node{i, j, k});
    }

private:
    Box given;
    std::array<std::size_t, 3> steps;
};

inline Node neighbour(const Node& node, std::size_t direction) {
    const Node& c = velocities[direction];
    return {node[0] + c[0], node[1] + c[1], node[2] + c[2]};
}

inline Vector<double> placeOf(const Node& node) { return vectorOf(node) + Vector<double>{0.5, 0.5, 0.5}; }

}  // namespace pendular::lattice
