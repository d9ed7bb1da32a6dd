#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Core/Ranks/Exchange.h"
#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// Which part of space belongs to which rank, by recursive coordinate bisection: space is cut in two so that
/// the weights on both sides are as the numbers of ranks there, and so is each side again; across the axis
/// along which a layer of points at the cut is thickest: there are fewest of them there, and so fewest
/// ghosts. (Across the axis along which its points are widest, as in the source, parts of a drum have up to
/// 1.4 times as many.) No bit of the results depends on it.
/// Source: Berger, Bokhari, "A partitioning strategy for nonuniform problems on multiprocessors", IEEE Trans.
/// Comput. C-36 (1987) 570.
class Bisection {
public:
    struct Point {
        Vector<double> position;  // m
        double weight;
    };
    /// Cuts space anew, for points of which each rank gives some.
    /// @param shares of the weight that each rank is to get
    void cut(Exchange& exchange, std::span<const Point> own, std::span<const double> shares);
    void cut(std::vector<Point> points, std::span<const double> shares);

    [[nodiscard]] std::size_t ownerOf(const Vector<double>& position) const;
    /// Calls function(rank) at least for each rank whose part of space is nearer to a position than so far
    /// (m).
    template <class Function>
    void forEachNear(const Vector<double>& position, double far, Function&& function) const {
        std::vector<std::uint32_t> open{0};
        while (!open.empty()) {
            const Node node = nodes[open.back()];
            open.pop_back();
            if (node.axis == leaf) {
                function(static_cast<std::size_t>(node.low));
                continue;
            }
            const double place = position.*vectorAxes[node.axis];
            if (place - far < node.border) open.push_back(node.low);
            if (place + far >= node.border) open.push_back(node.high);
        }
    }

private:
    static constexpr std::uint32_t leaf = 3;
    struct Node {
        std::uint32_t axis = leaf;
        double border = 0;                // m; what is below it is on the low side
        std::uint32_t low = 0, high = 0;  // nodes; of a leaf: the rank
    };
    std::uint32_t cutPart(std::span<Point> points, std::span<const double> shares, std::uint32_t firstRank);

    std::vector<Node> nodes;  // the first one is all of space
};

}  // namespace pendular
