#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// An axis-parallel box.
struct Box {
    Vector<double> lowest{1e300, 1e300, 1e300};      // m
    Vector<double> highest{-1e300, -1e300, -1e300};  // m

    void include(const Vector<double>& p) {
        lowest = {std::min(lowest.x, p.x), std::min(lowest.y, p.y), std::min(lowest.z, p.z)};
        highest = {std::max(highest.x, p.x), std::max(highest.y, p.y), std::max(highest.z, p.z)};
    }
    void include(const Box& box) {  // by its lowest and highest numbers, so that an empty one changes nothing
        const Vector<double>&low = box.lowest, &high = box.highest;
        lowest = {std::min(lowest.x, low.x), std::min(lowest.y, low.y), std::min(lowest.z, low.z)};
        highest = {std::max(highest.x, high.x), std::max(highest.y, high.y), std::max(highest.z, high.z)};
    }
    [[nodiscard]] Vector<double> middle() const { return 0.5 * (lowest + highest); }
    /// The square (m^2) of the distance of a point outside; 0 inside.
    [[nodiscard]] double squaredDistance(const Vector<double>& p) const {
        const auto out = [](double x, double low, double high) { return std::max({low - x, 0.0, x - high}); };
        return squaredNorm(Vector<double>{out(p.x, lowest.x, highest.x), out(p.y, lowest.y, highest.y),
                                          out(p.z, lowest.z, highest.z)});
    }
};

/// A binary tree over boxes, halved at the median of their middles along the longest side.
class BoxTree {
public:
    BoxTree() = default;
    explicit BoxTree(std::span<const Box> boxes) : order(boxes.size()) {
        std::iota(order.begin(), order.end(), 0u);
        if (!boxes.empty()) build(boxes, 0, static_cast<std::uint32_t>(boxes.size()));
    }

    /// Calls function(number) for each box that may lie within a distance (m) of a point.
    template <class Function>
    void forEachNear(const Vector<double>& point, double distance, Function&& function) const {
        std::uint32_t node = 0;
        while (node <
               nodes.size()) {  // nodes lie in the order of a walk; a subtree that is out of reach is skipped
            const Node& at = nodes[node];
            if (!(at.box.squaredDistance(point) < distance * distance)) {
                node = at.next;
                continue;
            }
            for (std::uint32_t k = at.begin; k < at.end; ++k) function(order[k]);
            ++node;
        }
    }

    /// The same boxes have moved: nodes keep what they hold. Searches find the same; they are slower the more
    /// the boxes have changed their order.
    void refit(std::span<const Box> boxes) {
        for (std::size_t node = nodes.size(); node-- > 0;) {  // those below a node come behind it
            Node& at = nodes[node];
            at.box = {};
            for (std::uint32_t k = at.begin; k < at.end; ++k) at.box.include(boxes[order[k]]);
            for (std::size_t below = node + 1; below < at.next; below = nodes[below].next)
                at.box.include(nodes[below].box);
        }
    }

private:
    struct Node {
        Box box;
        std::uint32_t next;        // the first node after this subtree
        std::uint32_t begin, end;  // of a leaf's boxes in `order`
    };
    static constexpr std::uint32_t leafSize = 4;

    void build(std::span<const Box> boxes, std::uint32_t begin, std::uint32_t end);

    std::vector<std::uint32_t> order;
    std::vector<Node> nodes;
};

}  // namespace pendular
