#pragma once

#include "Kernel/Core/Contacts/MemoryColumns.h"
#include "Tools/Studies/AccuracyVersusCost/FrictionLaws.h"
#include "Tools/Timing/Timing.h"

// What friction laws cost: the force in the form of the contact kernel, eight contacts at a time, with their
// memory in columns in the first-level cache.

namespace pendular::friction {

/// Nanoseconds for one contact: its memory is loaded, turned, asked for the force and stored.
template <class Named>
double forceTime(const Named& named, int runs) {
    using Law = typename Named::Law;
    constexpr std::size_t blocks = 16;
    const PartialSlipConditions conditions{1e-3, 1e9, 0.2e9, 0.3};
    const auto prepared = lawOf(named, conditions, 1e-6).prepare(AnyNormalLaw{});
    MemoryColumns memory{columnsOf<Law::template History>, {}};
    memory.resize(blocks);
    std::vector<LaneColumn> forces(blocks), overlaps(blocks);
    for (std::size_t k = 0; k < blocks * Pack::lanes; ++k)
        overlaps[k / Pack::lanes].lane[k % Pack::lanes] = 1e-6 * (0.5 + 0.003 * static_cast<double>(k));
    const Vector<Pack> normal{Pack(0), Pack(0), Pack(1)};
    const auto computeForces = [&](double way) {
        for (std::size_t b = 0; b < blocks; ++b) {
            const Contact<Pack> contact(Pack::load(overlaps[b].lane.data()) * Pack(1 + 1e4 * way), Pack(1e-3),
                                        Pack(1e-6));
            const Slip<Pack> slip{.velocity = {Pack(way), Pack(0), Pack(0)},
                                  .timeBefore = Pack(0.5),
                                  .timeAfter = Pack(0.5),
                                  .response = Pack(0.1)};
            auto history = memory.load<Law::template History>(b);
            history.turn({normal, {Pack(way), Pack(0), Pack(0)}, Pack(way)});
            const auto force = Law::slide(prepared, contact, Pack(0.5), slip, history);
            memory.store<Law::template History>(b, history);
            (force.force.x + force.force.y + force.force.z).store(forces[b].lane.data());
        }
        use(forces.data());
    };
    constexpr int rounds = 100;
    const auto run = [&] {
        // The motion goes to and fro, so that some contacts slide.
        for (int round = 0; round < rounds; ++round) computeForces(round % 20 < 10 ? 1e-8 : -1e-8);
    };
    return fastest(runs, run) / static_cast<double>(rounds * blocks * Pack::lanes);
}

struct FrictionCost {
    std::size_t numbers;      // that each contact stores, of 8 bytes
    double force = infinity;  // ns, of one contact
};

/// In the order of forEachLaw. The laws take turns, so that a clock that is faster for a while is so for all.
inline std::vector<FrictionCost> measureFrictionCosts(int runs) {
    std::vector<FrictionCost> costs;
    forEachLaw(
        [&]<class Named>(const Named&) { costs.push_back({columnsOf<Named::Law::template History>}); });
    const int runsOfTurn = std::min(runs, 10);
    for (int run = 0; run < runs; run += runsOfTurn) {
        auto cost = costs.begin();
        forEachLaw([&](const auto& law) {
            cost->force = std::min(cost->force, forceTime(law, runsOfTurn));
            ++cost;
        });
    }
    return costs;
}

}  // namespace pendular::friction
