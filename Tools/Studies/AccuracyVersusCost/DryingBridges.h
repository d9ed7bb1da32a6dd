#pragma once

#include <algorithm>
#include <cmath>

#include "Kernel/Laws/Concepts/Bodies.h"

// A bridge that loses liquid at a gap, prepared again only when its volume has changed by so much.

namespace pendular {

/// The error of the force over the whole time of the bridge.
struct StaleForce {
    double rootMeanSquare = 0, largest = 0;  // error over the force
    double beyondRupture = 0;  // largest share of liquid lost after the bridge should have ended
    double preparations = 0;   // a step
};

/// Grains of 1 mm whose bridge dries from V* = 0.01 to 1e-4 by an equal share in each step, at gaps from 0 to
/// half of the first rupture distance; until it ruptures.
/// @param threshold of the change of volume since the last preparation, over that volume; 0: each step
template <class Law>
StaleForce dryBridges(double threshold, double shareOfStep, int gaps) {
    constexpr double radius = 1e-3, first = 0.01, last = 1e-4;
    const Bodies bodies{radius, radius};
    Law law;
    law.contactAngle = 0, law.surfaceTension = 0.07;
    const auto prepared = [&](double dimensionless) {
        law.liquidBridgeVolume = dimensionless * std::pow(radius, 3);
        return law.prepare(bodies);
    };
    StaleForce found;
    double steps = 0;
    for (int k = 0; k < gaps; ++k) {
        const double gap = 0.5 * prepared(first).range() * k / gaps;
        // Bridges do not begin at one phase of the threshold.
        double held = first * (1 + threshold * (k + 0.5) / gaps);
        auto kept = prepared(held);
        for (double volume = first; volume > last; volume *= 1 - shareOfStep) {
            if (std::abs(volume - held) > threshold * held) {
                kept = prepared(held = volume);
                ++found.preparations;
            }
            const auto exact = prepared(volume);
            if (gap >= kept.range()) break;
            if (gap >= exact.range()) {
                found.beyondRupture = std::max(found.beyondRupture, 1 - volume / held);
                continue;
            }
            const double error = std::abs(kept.force(gap) / exact.force(gap) - 1);
            found.largest = std::max(found.largest, error);
            found.rootMeanSquare += error * error;
            ++steps;
        }
    }
    found.rootMeanSquare = std::sqrt(found.rootMeanSquare / steps);
    found.preparations /= steps;
    return found;
}

}  // namespace pendular
