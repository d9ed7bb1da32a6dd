/// What can be asked of TwoFluids between two steps.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Studies/LatticeBoltzmann/TwoFluids.h"

namespace pendular::lattice {

Densities TwoFluids::densityAt(const Node& node) const {
    const std::size_t site = grid_.at(node);
    return {components[0].density[site], components[1].density[site]};
}

double TwoFluids::pressureAt(const Node& node) const {
    const std::size_t site = grid_.at(node);
    const auto& [first, second] = components;
    return (first.density[site] + second.density[site]) / 3 +
           12 * settings_.coupling * first.psi[site] * second.psi[site];
}

/// Equation 7, at a node of fluid.
Vector<double> TwoFluids::forceOn(std::size_t component, std::size_t site) const {
    const std::vector<double>& other = components[1 - component].psi;
    Vector<double> sum{0, 0, 0};
    for (std::size_t i = 1; i < directions; ++i)
        sum +=
            degeneracy(i) * other[site + static_cast<std::size_t>(grid_.offset(i))] * vectorOf(velocities[i]);
    return -settings_.coupling * components[component].psi[site] * sum;
}

/// The velocities of the equilibria have the whole force, the printed one has half of it.
Vector<double> TwoFluids::velocityAt(const Node& node) const {
    const std::size_t site = grid_.at(node);
    Vector<double> momentum{0, 0, 0};
    double density = 0;
    for (std::size_t c = 0; c < 2; ++c) {
        const auto& [x, y, z] = components[c].velocity;
        const double rho = components[c].density[site];
        momentum += rho * Vector<double>{x[site], y[site], z[site]} - 0.5 * forceOn(c, site);
        density += rho;
    }
    return 1 / density * momentum;
}

double TwoFluids::largestSpeed() const {
    double most = 0;
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) < 0) most = std::max(most, norm(velocityAt(node)));
    });
    return most;
}

Densities TwoFluids::mass() const {
    Densities sum{0, 0};
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) >= 0) return;
        for (std::size_t c = 0; c < 2; ++c) sum[c] += components[c].density[grid_.at(node)];
    });
    return sum;
}

std::vector<SolidForce> TwoFluids::solidForces() const {
    std::vector<SolidForce> forces(solids.size());
    for (const Link& link : links) {
        SolidForce& force = forces[static_cast<std::size_t>(link.solid)];
        const std::size_t i = opposite(link.direction);
        const std::size_t wall = link.site + static_cast<std::size_t>(grid_.offset(i));
        double exchange = 0, pull = 0;
        for (std::size_t c = 0; c < 2; ++c) {
            exchange +=
                2 * population(components[c], i, link.site) + link.factor * components[c].density[link.site];
            pull += components[c].psi[link.site] * components[1 - c].psi[wall];
        }
        force.exchange += exchange * vectorOf(velocities[i]);
        force.reaction += settings_.coupling * degeneracy(i) * pull * vectorOf(velocities[i]);
    }
    return forces;
}

double TwoFluids::thrustThroughSide(std::size_t axis, bool isLast) const {
    const Box& box = grid_.box();
    if (box.sides[axis] != Sides::Mirrored)
        throw InputError(fmt::format(
            "lattice: the sides across axis {} are not mirrored; thrustThroughSide() needs it.", axis));
    double sum = 0;
    grid_.forEachNode([&](const Node& node) {
        if (node[axis] != (isLast ? box.nodes[axis] - 1 : 0) || solidAt(node) >= 0) return;
        const std::size_t site = grid_.at(node);
        for (std::size_t i = 1; i < directions; ++i) {
            const Node beyond = neighbour(node, i);
            if (velocities[i][axis] != (isLast ? 1 : -1) || solidAt(beyond) >= 0) continue;
            for (std::size_t c = 0; c < 2; ++c)
                sum += 2 * population(components[c], i, site) + settings_.coupling * degeneracy(i) *
                                                                    components[c].psi[site] *
                                                                    components[1 - c].psi[grid_.at(beyond)];
        }
    });
    return sum;
}

PressureSums TwoFluids::pressureSums() const {
    PressureSums sum;
    const Component &first = components[0], &second = components[1];  // a lambda takes no structured binding
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) >= 0) return;
        const std::size_t site = grid_.at(node);
        for (std::size_t i = 1; i < directions; ++i) {
            const Vector<double> c = vectorOf(velocities[i]);
            const double pair = settings_.coupling * degeneracy(i) * first.psi[site] *
                                second.psi[grid_.at(neighbour(node, i))];
            const double moved = population(first, i, site) + population(second, i, site) + pair;
            sum.xx += moved * c.x * c.x, sum.yy += moved * c.y * c.y, sum.zz += moved * c.z * c.z;
            sum.xy += moved * c.x * c.y;
        }
    });
    return sum;
}

void TwoFluids::scale(const std::function<Densities(const Node&)>& function) {
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) >= 0) return;
        const Densities factor = function(node);
        for (std::size_t c = 0; c < 2; ++c) {
            components[c].density[grid_.at(node)] *= factor[c];
            components[c].base[grid_.at(node)] *= factor[c];
        }
    });
    fillGhosts();
}

}  // namespace pendular::lattice
