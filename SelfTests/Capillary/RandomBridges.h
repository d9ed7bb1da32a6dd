#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"

namespace pendular {

/// A bridge between bodies with 2/R = 1/r1 + 1/r2, R = 1, and a gap at which it is stable.
struct RandomBridge {
    BridgeConditions conditions;
    double gap, ruptureGap;
};

/// Random bridges: V* evenly spread in logarithm from 1e-6 to 0.5; radius ratio 0 (a plane) to 1; gap up to
/// mostOfRupture of the rupture distance; one contact angle up to mostAngle (rad) for both, or one each.
inline std::vector<RandomBridge> randomBridges(int count, double mostAngle, double mostOfRupture,
                                               bool likeAngles) {
    std::mt19937_64 random(20260101);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<RandomBridge> bridges;
    while (static_cast<int>(bridges.size()) < count) {
        const double ratio = std::max(0.0, 1.05 * uniform(random) - 0.05),
                     angle = mostAngle * uniform(random);
        const double other = likeAngles ? angle : mostAngle * uniform(random);
        const double volume = 1e-6 * std::pow(0.5e6, uniform(random));
        const double larger = ratio > 0 ? 0.5 * (1 + ratio) / ratio : std::numeric_limits<double>::infinity();
        const BridgeConditions conditions{{0.5 * (1 + ratio), angle}, {larger, other}, volume};
        const double share = mostOfRupture * uniform(random);
        if (const auto rupture = findRupture(conditions))
            bridges.push_back({conditions, share * rupture->last.gap(), rupture->last.gap()});
    }
    return bridges;
}

inline double degrees(double angle) { return angle * std::numbers::pi / 180; }

}  // namespace pendular
