#include "Kernel/Features/LiquidBridges/Shared/ExactBridge.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "Kernel/Foundation/State/Random.h"

namespace pendular {

std::vector<BridgeCase> BridgePopulation::draw(std::size_t count, std::uint64_t seed) const {
    UniformRandom random(seed);
    const auto between = [&](const Range& range) { return random.logarithmic(range.lowest, range.highest); };
    std::vector<BridgeCase> bridges(count);
    for (BridgeCase& bridge : bridges) {
        bridge.bodies.radius1 = between(radius);
        bridge.bodies.radius2 = between(radius);
        if (random.uniform(0, 1) < wallShare) bridge.bodies.radius2 = infinity;
        const double length = 2 * bridge.bodies.effectiveRadius();  // R
        bridge.volume = between(dimensionlessVolume) * length * length * length;
        bridge.contactAngle = random.uniform(contactAngle.lowest, contactAngle.highest);
    }
    return bridges;
}

std::optional<ExactBridge> solveExactly(const BridgeCase& bridge) {
    const auto [bodies, volume, angle] = bridge;
    const BridgeConditions conditions{{bodies.radius1, angle}, {bodies.radius2, angle}, volume};
    const auto rupture = findRupture(conditions);
    if (!rupture) return {};
    ExactBridge exact{.bridge = bridge,
                      .forces = {},
                      .forceScale = 4 * std::numbers::pi * bodies.effectiveRadius(),
                      .largestForce = 0,
                      .ruptureDistance = rupture->last.gap(),
                      .ruptureWork = 0};
    // F is the derivative of the energy by the gap, so the work between two gaps needs no quadrature; where
    // F < 0, the equilibrium force does none.
    std::optional<CapillaryBridge> last;
    const auto addWorkTo = [&](const CapillaryBridge& next) {
        if (last) exact.ruptureWork += std::max(next.energy() - last->energy(), 0.0);
    };
    for (std::size_t k = 0; k < ExactBridge::points; ++k) {
        const double root = static_cast<double>(k) / (ExactBridge::points - 1);
        const double gap = ExactBridge::shareOfRupture * exact.ruptureDistance * root * root;
        const auto next = solveBridge(conditions, gap, last ? &*last : nullptr);
        if (!next) return {};
        addWorkTo(*next);
        exact.forces[k] = {gap, next->pinnedForce()};
        exact.largestForce = std::max(exact.largestForce, next->force());
        last = next;
    }
    addWorkTo(rupture->last);
    return exact;
}

std::vector<ExactBridge> solveExactly(const std::vector<BridgeCase>& bridges) {
    std::vector<ExactBridge> solved;
    solved.reserve(bridges.size());
    for (const BridgeCase& bridge : bridges)
        if (const auto exact = solveExactly(bridge)) solved.push_back(*exact);
    return solved;
}

}  // namespace pendular
