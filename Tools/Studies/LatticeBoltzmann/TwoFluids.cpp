#include "Tools/Studies/LatticeBoltzmann/TwoFluids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Base/InputError.h"
#include "Kernel/Base/Parallel.h"
#include "Kernel/Math/ElementaryFunctions.h"
#include "Kernel/Species/Field.h"

namespace pendular::lattice {

namespace {

/// Short gaps in a span, of ghosts or solid, are computed with it: nobody reads what comes out there.
constexpr std::size_t longestGap = 24;
/// Spans worth a thread.
constexpr std::size_t spansWorth = 4;

double effectiveMass(double density) { return 1.0 - exponential2(-std::numbers::log2e * density); }

}  // namespace

TwoFluids::TwoFluids(const Box& box, std::vector<Solid> given, const FluidSettings& settings,
                     const std::function<Densities(const Vector<double>&)>& begin)
    : grid_(box), solids(std::move(given)), settings_(settings) {
    checkValue("lattice", "coupling", settings.coupling, "", notNegative);
    checkValue("lattice", "relaxation", settings.relaxation, "steps", {0.5, infinity, false, false});
    for (Component& component : components) {
        for (std::size_t i = 0; i < directions; ++i)
            component.moving.insert(component.moving.end(), grid_.size(), weight(i));
        if (settings.relaxation != 1) component.arrived = component.moving;
        component.density.assign(grid_.size(), 1);
        component.psi.assign(grid_.size(), 0);
        component.momentum.fill(component.psi);
    }
    layOut();
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) < 0) setEquilibrium(grid_.at(node), begin(placeOf(node)));
    });
    findForces();
}

/// To first order in the velocity.
void TwoFluids::setEquilibrium(std::size_t site, const Densities& rho, const Vector<double>& velocity) {
    for (std::size_t c = 0; c < 2; ++c) {
        components[c].density[site] = rho[c];
        for (std::size_t i = 0; i < directions; ++i)
            components[c].moving[slot(i, site)] =
                weight(i) * rho[c] * (1 + 3 * dot(vectorOf(velocities[i]), velocity));
    }
}

/// Which nodes are solid; rows of fluid; what is copied where in each step.
void TwoFluids::layOut() {
    slots.clear(), ghosts.clear(), spans.clear(), shells.clear(), shellNeighbours.clear();
    links.clear(), movingLinks.clear();
    solidOf.assign(grid_.size(), -1);
    grid_.forEachNode([&](const Node& node) {
        for (std::size_t k = 0; k < solids.size(); ++k)
            if (solids[k].contains(placeOf(node))) solidOf[grid_.at(node)] = static_cast<int>(k);
    });
    grid_.forEachNode(
        [&](const Node& node) {
            const std::size_t site = grid_.at(node), real = grid_.at(grid_.seenAt(node).node);
            if (site == real) return;
            solidOf[site] = solidOf[real];
            ghosts.push_back({site, real});
        },
        1);
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) >= 0) {
            addShell(node);
            return;
        }
        const std::size_t site = grid_.at(node);
        const std::size_t reach = spans.empty() ? 0 : site + 1 - spans.back().begin;
        if (!spans.empty() && reach <= longestSpan && reach - spans.back().count <= longestGap)
            spans.back().count = reach;
        else spans.push_back({site, 1});
        addLinks(node);
    });
}

/// A population comes to a node from the node behind it. Where that is a ghost or solid, its slot there is
/// filled before it is read: with what the real node sends, or with what the node itself has sent to the
/// solid.
void TwoFluids::addLinks(const Node& node) {
    const std::size_t site = grid_.at(node);
    for (std::size_t i = 1; i < directions; ++i) {
        const Node behind = neighbour(node, opposite(i));
        const Seen seen = grid_.seenAt(behind);
        const int solid = solidAt(behind);
        if (solid < 0) {
            if (seen.node != behind)
                slots.push_back(
                    {slot(i, grid_.at(behind)), slot(mirrored(i, seen.isMirrored), grid_.at(seen.node))});
            continue;
        }
        const std::size_t outgoing = slot(opposite(i), site);
        const Vector<double>& u = solids[static_cast<std::size_t>(solid)].velocity;
        const double factor = 6 * weight(i) * dot(vectorOf(velocities[i]), u);
        slots.push_back({slot(i, grid_.at(behind)), outgoing});
        if (factor != 0) movingLinks.push_back({slot(i, grid_.at(behind)), site, factor});
        links.push_back({site, outgoing, solid, factor});
    }
}

void TwoFluids::addShell(const Node& node) {
    Shell shell{grid_.at(node), shellNeighbours.size(), 0,
                solids[static_cast<std::size_t>(solidAt(node))].wetting};
    for (std::size_t i = 1; i < directions; ++i) {
        const Node beside = neighbour(node, i);
        if (solidAt(beside) >= 0) continue;
        shellNeighbours.push_back(grid_.at(grid_.seenAt(beside).node));
        ++shell.neighbours;
    }
    if (shell.neighbours > 0) shells.push_back(shell);
}

void TwoFluids::fillSlots() {
    for (Component& component : components) {
        inParts(
            slots.size(), settings_.threads,
            [&](int, std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k)
                    component.moving[slots[k].to] = component.moving[slots[k].from];
            },
            4096);
        for (const MovingLink& link : movingLinks)
            component.moving[link.slot] += link.factor * component.density[link.site];
    }
}

void TwoFluids::stream() {
    inParts(
        spans.size(), settings_.threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) streamSpan(spans[k]);
        },
        spansWorth);
}

void TwoFluids::streamSpan(const Span& span) {
    for (Component& component : components) {
        double* const rho = component.density.data() + span.begin;
        std::array<double*, 3> momentum{};
        for (std::size_t k = 0; k < 3; ++k) {
            momentum[k] = component.momentum[k].data() + span.begin;
            std::fill_n(momentum[k], span.count, 0.0);
        }
        std::fill_n(rho, span.count, 0.0);
        for (std::size_t i = 0; i < directions; ++i) {
            const double* const from = component.moving.data() + slot(i, span.begin) - grid_.offset(i);
            for (std::size_t s = 0; s < span.count; ++s) rho[s] += from[s];
            for (std::size_t k = 0; k < 3; ++k) {
                const double c = velocities[i][k];
                double* const sum = momentum[k];
                if (c != 0)
                    for (std::size_t s = 0; s < span.count; ++s) sum[s] += c * from[s];
            }
            if (!component.arrived.empty())
                std::copy_n(from, span.count, component.arrived.data() + slot(i, span.begin));
        }
    }
}

/// psi of all nodes that a force is asked of: fluid, shells, ghosts.
void TwoFluids::findForces() {
    for (Component& component : components) {
        inParts(
            spans.size(), settings_.threads,
            [&](int, std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k)
                    for (std::size_t s = spans[k].begin; s < spans[k].begin + spans[k].count; ++s)
                        component.psi[s] = effectiveMass(component.density[s]);
            },
            spansWorth);
        const double sign = &component == components.data() ? 1 : -1;
        for (const Shell& shell : shells) {
            double sum = 0;
            for (std::size_t k = 0; k < shell.neighbours; ++k)
                sum += component.density[shellNeighbours[shell.firstNeighbour + k]];
            const double mean = sum / static_cast<double>(shell.neighbours);
            component.density[shell.site] = std::max(0.0, mean + sign * shell.wetting);
            component.psi[shell.site] = effectiveMass(component.density[shell.site]);
        }
        for (const Copy& ghost : ghosts) component.psi[ghost.to] = component.psi[ghost.from];
    }
}

void TwoFluids::collide() {
    inParts(
        spans.size(), settings_.threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) collideSpan(spans[k]);
        },
        spansWorth);
}

/// u' of the two components, then for each the velocity of its equilibrium.
void TwoFluids::collideSpan(const Span& span) {
    const std::size_t n = span.count, begin = span.begin;
    std::array<Row, 3> common, pull, velocity;
    const auto& [first, second] = components;
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t s = 0; s < n; ++s)
            common[k][s] = (first.momentum[k][begin + s] + second.momentum[k][begin + s]) /
                           (first.density[begin + s] + second.density[begin + s]);
    for (std::size_t c = 0; c < 2; ++c) {
        sumNeighbours(components[1 - c], span, pull);
        const double* const rho = components[c].density.data() + begin;
        const double* const psi = components[c].psi.data() + begin;
        const double factor = settings_.relaxation * settings_.coupling;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t s = 0; s < n; ++s)
                velocity[k][s] = common[k][s] - factor * psi[s] / rho[s] * pull[k][s];
        relax(components[c], span, velocity);
    }
}

/// The sum of g psi c over the neighbours.
void TwoFluids::sumNeighbours(const Component& other, const Span& span, std::array<Row, 3>& sums) const {
    for (Row& sum : sums) std::fill_n(sum.begin(), span.count, 0.0);
    for (std::size_t i = 1; i < directions; ++i) {
        const double* const psi = other.psi.data() + span.begin + grid_.offset(i);
        for (std::size_t k = 0; k < 3; ++k) {
            const double g = degeneracy(i) * velocities[i][k];
            if (g != 0)
                for (std::size_t s = 0; s < span.count; ++s) sums[k][s] += g * psi[s];
        }
    }
}

/// Populations go 1/tau of the way to the equilibrium of second order, equation 6.
void TwoFluids::relax(Component& own, const Span& span, const std::array<Row, 3>& u) const {
    const std::size_t n = span.count;
    const double* const rho = own.density.data() + span.begin;
    Row squared, goal;
    for (std::size_t s = 0; s < n; ++s)
        squared[s] = 1.5 * (u[0][s] * u[0][s] + u[1][s] * u[1][s] + u[2][s] * u[2][s]);
    for (std::size_t i = 0; i < directions; ++i) {
        const double cx = velocities[i][0], cy = velocities[i][1], cz = velocities[i][2], w = weight(i);
        for (std::size_t s = 0; s < n; ++s) {
            const double along = cx * u[0][s] + cy * u[1][s] + cz * u[2][s];
            goal[s] = w * rho[s] * (1 + 3 * along + 4.5 * along * along - squared[s]);
        }
        double* const moving = own.moving.data() + slot(i, span.begin);
        if (own.arrived.empty()) {
            std::copy_n(goal.begin(), n, moving);
            continue;
        }
        const double* const arrived = own.arrived.data() + slot(i, span.begin);
        for (std::size_t s = 0; s < n; ++s)
            moving[s] = arrived[s] + (goal[s] - arrived[s]) / settings_.relaxation;
    }
}

void TwoFluids::step() {
    fillSlots();
    stream();
    findForces();
    collide();
}

void TwoFluids::steps(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) step();
}

}  // namespace pendular::lattice
