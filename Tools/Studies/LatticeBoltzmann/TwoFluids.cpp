#include "Tools/Studies/LatticeBoltzmann/TwoFluids.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Math/ElementaryFunctions.h"
#include "Kernel/Foundation/Math/Pack.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular::lattice {

namespace {

/// Short gaps in a span, of ghosts or solid, are computed with it.
constexpr std::size_t longestGap = 8;
constexpr std::size_t longestSpan = 256;
/// Spans and ghosts worth a thread.
constexpr std::size_t spansWorth = 4, ghostsWorth = 4096;
constexpr auto lanes = static_cast<std::size_t>(Pack::lanes);

template <Number T>
[[gnu::always_inline]] inline T effectiveMass(const T& density) {
    return 1.0 - exponential2(-std::numbers::log2e * density);
}

/// Eight numbers from any address.
[[gnu::always_inline]] inline Pack packAt(const double* address) {
    std::array<double, lanes> values;
    std::memcpy(values.data(), address, sizeof values);
    return Pack::fromLanes(values);
}
[[gnu::always_inline]] inline void put(const Pack& pack, double* address) {
    const std::array<double, lanes> values = pack.toLanes();
    std::memcpy(address, values.data(), sizeof values);
}

/// The equilibrium of second order over its weight. @param base density (1 - 1.5 velocity^2)
template <Number T>
[[gnu::always_inline]] inline T equilibrium(const T& density, const T& base, const T& along) {
    return fma(density * along, fma(4.5, along, T(3.0)), base);
}

}  // namespace

TwoFluids::TwoFluids(const Box& box, std::vector<Solid> given, const FluidSettings& settings,
                     const std::function<Densities(const Vector<double>&)>& begin)
    : grid_(box), solids(std::move(given)), settings_(settings) {
    checkValue("lattice", "coupling", settings.coupling, "", notNegative);
    for (Component& component : components) {
        const Field zeros(grid_.size() + lanes, 0);  // the last pack may reach beyond the last node
        component.density = component.psi = component.base = component.nextDensity = zeros;
        component.velocity.fill(zeros), component.nextMomentum.fill(zeros);
    }
    layOut();
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) < 0) setEquilibrium(grid_.at(node), begin(placeOf(node)));
    });
    findPsi();
    fillGhosts();
}

void TwoFluids::setEquilibrium(std::size_t site, const Densities& rho, const Vector<double>& velocity) {
    for (std::size_t c = 0; c < 2; ++c) {
        Component& own = components[c];
        own.density[site] = rho[c];
        own.base[site] = rho[c] * (1 - 1.5 * squaredNorm(velocity));
        own.velocity[0][site] = velocity.x, own.velocity[1][site] = velocity.y,
        own.velocity[2][site] = velocity.z;
    }
}

/// Which nodes are solid, also beyond the sides, and what lies beyond them.
void TwoFluids::findSolids() {
    solidOf.assign(grid_.size(), -1);
    ghosts.clear();
    grid_.forEachNode([&](const Node& node) {
        for (std::size_t k = 0; k < solids.size(); ++k)
            if (solids[k].contains(placeOf(node))) solidOf[grid_.at(node)] = static_cast<int>(k);
    });
    grid_.forEachNode(
        [&](const Node& node) {
            const Seen seen = grid_.seenAt(node);
            const std::size_t site = grid_.at(node), real = grid_.at(seen.node);
            if (site == real) return;
            solidOf[site] = solidOf[real];
            ghosts.push_back({site, real, {}});
            for (std::size_t k = 0; k < 3; ++k) ghosts.back().sign[k] = seen.isMirrored[k] ? -1 : 1;
        },
        1);
}

/// Rows of fluid, shells of solids, and what is thrown back where.
void TwoFluids::layOut() {
    findSolids();
    spans.clear(), holes.clear(), shells.clear(), shellNeighbours.clear(), links.clear();
    grid_.forEachNode([&](const Node& node) {
        if (solidAt(node) >= 0) {
            addShell(node);
            return;
        }
        addToSpans(node);
        addLinks(node);
    });
    std::vector<bool> isFluid(grid_.size() + lanes, false);
    grid_.forEachNode([&](const Node& node) { isFluid[grid_.at(node)] = solidAt(node) < 0; });
    for (Span& span : spans) {
        span.firstHole = holes.size();
        for (std::size_t site = span.begin; site < span.begin + span.count; ++site)
            if (!isFluid[site]) holes.push_back(site);
        span.holes = holes.size() - span.firstHole;
    }
    for (std::size_t site = 0; site < isFluid.size(); ++site) {
        if (isFluid[site]) continue;
        setEquilibrium(site, {0, 0});
        for (Component& own : components) {
            own.nextDensity[site] = 0;
            for (Field& momentum : own.nextMomentum) momentum[site] = 0;
        }
    }
}

void TwoFluids::addToSpans(const Node& node) {
    const std::size_t site = grid_.at(node);
    if (!spans.empty()) {
        Span& last = spans.back();
        const std::size_t reach = (site - last.begin) / lanes * lanes + lanes;
        const std::size_t gap = site - std::min(site, last.begin + last.count);
        if (reach <= std::max(last.count, longestSpan) && gap <= longestGap) {
            last.count = std::max(last.count, reach);
            return;
        }
    }
    spans.push_back({site, lanes, 0, 0, links.size(), 0});
}

void TwoFluids::addLinks(const Node& node) {
    for (std::size_t i = 1; i < directions; ++i) {
        const int solid = solidAt(neighbour(node, opposite(i)));
        if (solid < 0) continue;
        const Vector<double>& u = solids[static_cast<std::size_t>(solid)].velocity;
        links.push_back({grid_.at(node), i, solid, 6 * weight(i) * dot(vectorOf(velocities[i]), u)});
        ++spans.back().links;
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

void TwoFluids::forEachSpan(const std::function<void(const Span&)>& function) const {
    inParts(
        spans.size(), settings_.threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) function(spans[k]);
        },
        spansWorth);
}

/// What arrives at each node: its density and momentum.
void TwoFluids::stream(const Span& span) {
    std::array<std::ptrdiff_t, directions> behind;
    for (std::size_t i = 0; i < directions; ++i) behind[i] = -grid_.offset(i);
    for (Component& own : components) {
        for (std::size_t s = span.begin; s < span.begin + span.count; s += lanes) {
            Pack axes(0.0), diagonals(0.0);
            std::array<Pack, 3> ofAxes{axes, axes, axes}, ofDiagonals = ofAxes;
            forEachDirection([&](auto direction) {
                constexpr std::size_t i = direction;
                const auto from = static_cast<std::ptrdiff_t>(s) + behind[i];
                const auto load = [&](const Field& field) { return packAt(field.data() + from); };
                const Pack u =
                    along<i>(std::array{load(own.velocity[0]), load(own.velocity[1]), load(own.velocity[2])});
                const Pack f = equilibrium(load(own.density), load(own.base), u);
                (i < 7 ? axes : diagonals) = (i < 7 ? axes : diagonals) + f;
                std::array<Pack, 3>& momentum = i < 7 ? ofAxes : ofDiagonals;
                for (std::size_t k = 0; k < 3; ++k) {
                    if (velocities[i][k] > 0) momentum[k] = momentum[k] + f;
                    if (velocities[i][k] < 0) momentum[k] = momentum[k] - f;
                }
            });
            const Pack density =
                weight(0) * packAt(own.base.data() + s) + weight(1) * axes + weight(7) * diagonals;
            put(density, own.nextDensity.data() + s);
            for (std::size_t k = 0; k < 3; ++k)
                put(weight(1) * ofAxes[k] + weight(7) * ofDiagonals[k], own.nextMomentum[k].data() + s);
        }
        throwBack(own, span);
    }
}

double TwoFluids::population(const Component& own, std::size_t direction, std::size_t site) const {
    double speed = 0;
    for (std::size_t k = 0; k < 3; ++k) speed += velocities[direction][k] * own.velocity[k][site];
    return weight(direction) * equilibrium(own.density[site], own.base[site], speed);
}

void TwoFluids::throwBack(Component& own, const Span& span) const {
    for (std::size_t k = span.firstLink; k < span.firstLink + span.links; ++k) {
        const Link& link = links[k];
        const double thrown =
            population(own, opposite(link.direction), link.site) + link.factor * own.density[link.site];
        own.nextDensity[link.site] += thrown;
        for (std::size_t axis = 0; axis < 3; ++axis)
            own.nextMomentum[axis][link.site] += velocities[link.direction][axis] * thrown;
    }
}

/// Of all nodes that a force is asked of: fluid, shells, ghosts.
void TwoFluids::findPsi() {
    forEachSpan([&](const Span& span) {
        for (Component& own : components)
            for (std::size_t s = span.begin; s < span.begin + span.count; s += lanes)
                put(effectiveMass(packAt(own.density.data() + s)), own.psi.data() + s);
    });
    for (Component& own : components) {
        const double sign = &own == components.data() ? 1 : -1;
        for (const Shell& shell : shells) {
            double sum = 0;
            for (std::size_t k = 0; k < shell.neighbours; ++k)
                sum += own.density[shellNeighbours[shell.firstNeighbour + k]];
            const double mean = sum / static_cast<double>(shell.neighbours);
            own.psi[shell.site] = effectiveMass(std::max(0.0, mean + sign * shell.wetting));
        }
        for (const Ghost& ghost : ghosts) own.psi[ghost.to] = own.psi[ghost.from];
    }
}

/// u' of the two components, then for each the velocity of its equilibrium.
void TwoFluids::collide(const Span& span) {
    std::array<std::ptrdiff_t, directions> ahead;
    for (std::size_t i = 0; i < directions; ++i) ahead[i] = grid_.offset(i);
    for (std::size_t s = span.begin; s < span.begin + span.count; s += lanes) {
        auto& [first, second] = components;
        const std::array density{packAt(first.density.data() + s), packAt(second.density.data() + s)};
        std::array<std::array<Pack, 3>, 2> pull;  // the sum of g psi c of the neighbours
        for (std::size_t c = 0; c < 2; ++c) {
            pull[c].fill(Pack(0.0));
            forEachDirection([&](auto direction) {
                constexpr std::size_t i = direction;
                const Pack psi = packAt(components[c].psi.data() + static_cast<std::ptrdiff_t>(s) + ahead[i]);
                for (std::size_t k = 0; k < 3; ++k)
                    if (velocities[i][k] != 0)
                        pull[c][k] = fma(degeneracy(i) * velocities[i][k], psi, pull[c][k]);
            });
        }
        const Pack share = (1.0 - settings_.friction) / (density[0] + density[1]);
        std::array<Pack, 3> common;
        for (std::size_t k = 0; k < 3; ++k)
            common[k] =
                (packAt(first.velocity[k].data() + s) + packAt(second.velocity[k].data() + s)) * share;
        for (std::size_t c = 0; c < 2; ++c) {
            Component& own = components[c];
            const Pack factor = settings_.coupling * packAt(own.psi.data() + s) / density[c];
            Pack squares(0.0);
            for (std::size_t k = 0; k < 3; ++k) {
                const Pack u = common[k] - factor * pull[1 - c][k];
                squares = fma(u, u, squares);
                put(u, own.velocity[k].data() + s);
            }
            put(density[c] * (1.0 - 1.5 * squares), own.base.data() + s);
        }
    }
    for (std::size_t k = span.firstHole; k < span.firstHole + span.holes; ++k)
        setEquilibrium(holes[k], {0, 0});
}

void TwoFluids::fillGhosts() {
    inParts(
        ghosts.size(), settings_.threads,
        [&](int, std::size_t begin, std::size_t end) {
            for (Component& own : components)
                for (std::size_t g = begin; g < end; ++g) {
                    const auto& [to, from, sign] = ghosts[g];
                    own.density[to] = own.density[from], own.base[to] = own.base[from];
                    for (std::size_t k = 0; k < 3; ++k) own.velocity[k][to] = sign[k] * own.velocity[k][from];
                }
        },
        ghostsWorth);
}

void TwoFluids::step() {
    forEachSpan([&](const Span& span) { stream(span); });
    for (Component& own : components) {
        std::swap(own.density, own.nextDensity);
        std::swap(own.velocity, own.nextMomentum);
    }
    findPsi();
    forEachSpan([&](const Span& span) { collide(span); });
    fillGhosts();
}

void TwoFluids::steps(std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) step();
}

}  // namespace pendular::lattice
