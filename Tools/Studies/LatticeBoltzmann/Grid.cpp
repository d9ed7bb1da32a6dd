#include "Tools/Studies/LatticeBoltzmann/Grid.h"

#include <fmt/format.h>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::lattice {

Grid::Grid(const Box& box) : given(box) {
    double sites = 1;
    for (const int nodes : box.nodes) {
        if (nodes < 1)
            throw InputError(
                fmt::format("lattice: a side of the box has {} nodes; it must have at least 1.", nodes));
        sites *= nodes + 2.0;
    }
    if (sites > 2e9)
        throw InputError(fmt::format("lattice: the box has {:.3g} sites; it may have at most 2e9.", sites));
    steps = {1, static_cast<std::size_t>(box.nodes[0]) + 2, 0};
    steps[2] = steps[1] * (static_cast<std::size_t>(box.nodes[1]) + 2);
}

Seen Grid::seenAt(Node node) const {
    Seen seen{node, {false, false, false}};
    for (std::size_t k = 0; k < 3; ++k) {
        const int n = given.nodes[k], at = node[k];
        if (at >= 0 && at < n) continue;
        seen.isMirrored[k] = given.sides[k] == Sides::Mirrored;
        if (seen.isMirrored[k]) seen.node[k] = at < 0 ? -1 - at : 2 * n - 1 - at;
        else seen.node[k] = at < 0 ? at + n : at - n;
    }
    return seen;
}

}  // namespace pendular::lattice
