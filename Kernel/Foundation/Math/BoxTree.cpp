#include "Kernel/Foundation/Math/BoxTree.h"

#include <algorithm>

namespace pendular {

void BoxTree::build(std::span<const Box> boxes, std::uint32_t begin, std::uint32_t end) {
    const std::size_t node = nodes.size();
    Box box, middles;
    for (std::uint32_t k = begin; k < end; ++k)
        box.include(boxes[order[k]]), middles.include(boxes[order[k]].middle());
    nodes.push_back({box, 0, begin, begin});
    if (end - begin <= leafSize) {
        nodes[node].end = end;
    } else {
        const Vector<double> side = middles.highest - middles.lowest;
        double Vector<double>::*const along = side.x >= side.y && side.x >= side.z ? &Vector<double>::x
                                              : side.y >= side.z                   ? &Vector<double>::y
                                                                                   : &Vector<double>::z;
        const std::uint32_t half = begin + (end - begin) / 2;
        std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end,
                         [&](std::uint32_t a, std::uint32_t b) {
                             const double x = boxes[a].middle().*along, y = boxes[b].middle().*along;
                             return x < y || (x == y && a < b);
                         });
        build(boxes, begin, half);
        build(boxes, half, end);
    }
    nodes[node].next = static_cast<std::uint32_t>(nodes.size());
}

}  // namespace pendular
