/// Solids that move through the lattice.

#include <fmt/format.h>

#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Studies/LatticeBoltzmann/TwoFluids.h"

namespace pendular::lattice {

/// @param before which solid had each site
void TwoFluids::uncover(const Node& node, const std::vector<int>& before) {
    Densities sum{0, 0};
    double count = 0;
    for (std::size_t i = 1; i < directions; ++i) {
        const std::size_t beside = grid_.at(grid_.seenAt(neighbour(node, i)).node);
        if (before[beside] >= 0 || solidOf[beside] >= 0) continue;
        for (std::size_t c = 0; c < 2; ++c) sum[c] += components[c].density[beside];
        count += 1;
    }
    const std::size_t site = grid_.at(node);
    if (count == 0)
        throw InputError(fmt::format(
            "lattice: node ({}, {}, {}) was uncovered by a solid with no fluid beside it; move it less.",
            node[0], node[1], node[2]));
    setEquilibrium(site, {sum[0] / count, sum[1] / count},
                   solids[static_cast<std::size_t>(before[site])].velocity);
}

Densities TwoFluids::moveSolids(std::vector<Solid> moved, const Densities& wanted) {
    if (moved.size() != solids.size())
        throw InputError(
            fmt::format("lattice: {} solids for {}; give each of them.", moved.size(), solids.size()));
    const std::vector<int> before = solidOf;
    solids = std::move(moved);
    layOut();
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) < 0 && before[grid_.at(node)] >= 0) uncover(node, before);
    });
    const Densities has = mass();
    Densities where{0, 0};  // mass of each component where it prevails
    const auto prevails = [&](const Node& node) -> std::size_t {
        const Densities rho = densityAt(node);
        return rho[0] > rho[1] ? 0 : 1;
    };
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) >= 0) return;
        const std::size_t c = prevails(node);
        where[c] += components[c].density[grid_.at(node)];
    });
    const Densities lack{wanted[0] - has[0], wanted[1] - has[1]};
    scale([&](const Node& node) -> Densities {
        const std::size_t c = prevails(node);
        Densities factor{1, 1};
        factor[c] = 1 + lack[c] / where[c];
        return factor;
    });
    findPsi();
    return lack;
}

}  // namespace pendular::lattice
