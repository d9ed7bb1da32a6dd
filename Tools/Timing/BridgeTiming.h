#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <string_view>
#include <typeindex>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Features/LiquidBridges/Shared/ExactBridge.h"
#include "Kernel/Scene/BridgeLaws.h"
#include "Tools/Timing/Timing.h"

// What the liquid bridge laws cost: force in the form of the contact kernel, eight bridges at a time from
// columns in the first-level cache; and prepare.

namespace pendular {

template <class Law>
typename Law::template Interaction<double> prepared(const BridgeCase& bridge) {
    Law law;
    law.liquidBridgeVolume = bridge.volume;
    law.contactAngle = bridge.contactAngle;
    law.surfaceTension = 0.07;
    return law.prepare(bridge.bodies);
}

/// Nanoseconds for the force of one bridge.
template <class Law>
double forceTime(const std::vector<BridgeCase>& bridges, int runs) {
    const std::size_t blocks = bridges.size() / Pack::lanes;
    MemoryColumns memory{columnsOf<Law::template Interaction>, {}};
    memory.resize(blocks);
    std::vector<LaneColumn> separations(blocks), forces(blocks);
    for (std::size_t k = 0; k < blocks * Pack::lanes; ++k) {
        const auto interaction = prepared<Law>(bridges[k]);
        ContactNumbers numbers;
        putMemory(interaction, numbers.data());
        memory.set(k, numbers.data());
        const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(bridges.size());
        separations[k / Pack::lanes].lane[k % Pack::lanes] = share * interaction.range();
    }
    constexpr int rounds = 100;
    const auto computeForces = [&] {
        for (int round = 0; round < rounds; ++round) {
            for (std::size_t b = 0; b < blocks; ++b) {
                const auto bridge = memory.load<Law::template Interaction>(b);
                const Pack separation = Pack::load(separations[b].lane.data());
                select(separation < bridge.range(), bridge.force(separation), Pack(0))
                    .store(forces[b].lane.data());
            }
            use(forces.data());
        }
    };
    return fastest(runs, computeForces) / static_cast<double>(rounds * blocks * Pack::lanes);
}

/// Nanoseconds for the preparation of one bridge. What takes long is timed for each bridge by itself, so that
/// no other program need interrupt it.
template <class Law>
double prepareTime(const std::vector<BridgeCase>& bridges, int runs) {
    const auto timeOf = [](std::span<const BridgeCase> some, int times) {
        return fastest(times, [&] {
            for (const BridgeCase& bridge : some) {
                const auto interaction = prepared<Law>(bridge);
                use(&interaction);
            }
        });
    };
    constexpr double clock = 20;  // ns, that it takes to read the clock
    const auto count = static_cast<double>(bridges.size());
    const bool isLong = timeOf(bridges, 1) / count > 100 * clock;
    if (!isLong) return timeOf(bridges, runs) / count;
    double sum = 0;
    for (const BridgeCase& bridge : bridges) sum += timeOf({&bridge, 1}, runs);
    return sum / count;
}

struct BridgeCost {
    std::string_view law;
    std::size_t numbers;        // that each contact stores, of 8 bytes
    double force = infinity;    // ns, of one bridge
    double prepare = infinity;  // ns, of one bridge
};

/// The costs of all bridge laws, in the order of forEachBridgeLaw. The laws take turns, so that a clock that
/// is faster for a while is so for all. Laws that store the same numbers have the same force in machine code,
/// and so the same time.
/// @param runs of which the fastest counts
inline std::vector<BridgeCost> measureBridgeCosts(int runs) {
    constexpr std::size_t count = 16 * Pack::lanes;  // so that all stays in the first-level cache
    // Equal spheres, which all laws take.
    const auto bridges = BridgePopulation{{1e-3, 1e-3}, 0, {1e-5, 0.1}, {0.3, 0.3}}.draw(count, 1);
    std::vector<BridgeCost> costs;
    forEachBridgeLaw([&]<class Law>() {
        costs.push_back({Law::name, columnsOf<Law::template Interaction>});
    });
    std::map<std::type_index, double> forces;  // ns, of each kind of numbers that a contact stores
    const int runsOfTurn = std::min(runs, 10);
    const auto forceOf = [&]<class Law>() -> double& {
        return forces.emplace(typeid(typename Law::template Interaction<double>), infinity).first->second;
    };
    for (int run = 0; run < runs; run += runsOfTurn)
        forEachBridgeLaw([&]<class Law>() {
            double& force = forceOf.template operator()<Law>();
            force = std::min(force, forceTime<Law>(bridges, runsOfTurn));
        });
    auto next = costs.begin();
    forEachBridgeLaw([&]<class Law>() { (next++)->force = forceOf.template operator()<Law>(); });
    for (int run = 0; run < runs; run += 10 * runsOfTurn) {
        auto cost = costs.begin();
        forEachBridgeLaw([&]<class Law>() {
            cost->prepare = std::min(cost->prepare, prepareTime<Law>(bridges, runsOfTurn));
            ++cost;
        });
    }
    return costs;
}

}  // namespace pendular
