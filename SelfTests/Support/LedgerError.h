#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Features/EnergyLedger/EnergyLedger.h"

namespace pendular::support {

/// J, all numbers of an account, without their signs.
inline double turnedOver(const EnergyLedger& ledger) {
    double sum = 0;
    for (const auto& entry : EnergyLedger::entries()) sum += std::abs(ledger.*entry.member);
    return sum;
}

/// J, what an account must not be off by after this many steps. Each step rounds each number of the account,
/// and the motion of each grain, by up to 2^-53 of it; the signs are at random. So after N steps that is
/// sqrt(N) 2^-53 of all that was turned over; five times of it.
inline double roundOff(const EnergyLedger& ledger, int steps) {
    return 5 * std::sqrt(steps) * 0x1p-53 * turnedOver(ledger);
}

/// Begins a scene with its account, which closes to round-off all along.
template <class Scene>
void expectClosedLedger(Scene& scene, int steps) {
    scene.keepEnergyLedger();
    scene.initialise();
    const double start = scene.energyLedger().closed();
    for (int n = 1; n <= steps; ++n) {
        scene.step();
        if (n % 500 != 0) continue;
        EXPECT_LT(std::abs(scene.energyLedger().closed() - start), roundOff(scene.energyLedger(), n)) << n;
    }
}

}  // namespace pendular::support
