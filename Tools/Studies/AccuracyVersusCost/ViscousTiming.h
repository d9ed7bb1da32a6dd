#pragma once

#include <vector>

#include "Kernel/Core/Contacts/MemoryColumns.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousPair.h"
#include "Tools/Timing/Timing.h"

// What the force of a viscous bridge costs in the form of the contact kernel: eight bridges at a time, with
// what they remember in columns in the first-level cache.

namespace pendular {

/// Nanoseconds for the normal force, and with that against slip and rolling if asked, of one bridge and step;
/// the capillary force is not in it. Half of the bridges move in, half out, by a roughness in a step.
inline double viscousTime(ViscousScheme scheme, TangentialLubrication tangential, int runs) {
    using Law = ViscousLiquidBridgeWillett;
    constexpr std::size_t blocks = 16;
    constexpr double radius = 1e-3, roughness = 1e-6, speed = 0.1;
    Law law;
    law.setLiquidBridgeVolume(1e-11), law.setContactAngle(0), law.setSurfaceTension(0.07);
    law.setViscosity(1e-3), law.setRoughness(roughness);
    law.setViscousScheme(scheme), law.setTangentialLubrication(tangential);
    MemoryColumns memory{columnsOf<Law::Interaction>, {}};
    memory.resize(blocks);
    std::vector<LaneColumn> gaps(blocks), forces(blocks);
    ContactNumbers numbers;
    putMemory(law.prepare({radius, radius}), numbers.data());
    for (std::size_t k = 0; k < blocks * Pack::lanes; ++k) {
        memory.set(k, numbers.data());
        gaps[k / Pack::lanes].lane[k % Pack::lanes] = roughness * (2 + 0.7 * static_cast<double>(k));
    }
    BridgeMotion<Pack> motion{};
    motion.step = motion.coming = Pack(roughness / speed);
    motion.effectiveRadius = Pack(0.5 * radius);
    motion.inverseMass = Pack(1 / (2.0 / 3 * std::numbers::pi * std::pow(radius, 3) * 2500));
    motion.push = motion.last = motion.asymmetry = Pack(0);
    motion.forms = Pack(0) > Pack(1);
    const auto computeForces = [&](double way) {
        for (std::size_t b = 0; b < blocks; ++b) {
            motion.separation = Pack::load(gaps[b].lane.data()) + Pack(0.5 * way * roughness);
            motion.approach = Pack(way * speed);
            auto bridge = memory.load<Law::Interaction>(b);
            const BridgeResistance<Pack> found = bridge.resist(law, motion);
            memory.store<Law::Interaction>(b, bridge);
            (found.normal + found.force + found.sliding + found.rolling).store(forces[b].lane.data());
        }
        use(forces.data());
    };
    constexpr int rounds = 100;
    const auto run = [&] {
        for (int round = 0; round < rounds; ++round) computeForces(round % 2 == 0 ? 1 : -1);
    };
    return fastest(runs, run) / static_cast<double>(rounds * blocks * Pack::lanes);
}

}  // namespace pendular
