#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "Kernel/Scene/Scene.h"

namespace pendular::energy {

/// J, the largest of all entries: what sums are rounded against.
inline double largestOf(const EnergyLedger& ledger) {
    double largest = 0;
    for (const EnergyLedger::Entry& entry : EnergyLedger::entries())
        largest = std::max(largest, std::abs(ledger.*entry.member));
    return largest;
}

/// The largest change of the closed account by a change and over so many steps, over what round-off allows:
/// in a step each contact and each grain adds up to 20 numbers, none of them larger than the largest entry,
/// each rounded by 2^-53 of it.
template <class Scene>
double openness(Scene& scene, const std::function<void(Scene&)>& change, int steps) {
    const EnergyLedger& ledger = scene.energyLedger();
    const double closed = ledger.closed();
    change(scene);
    double largest = 0, scale = largestOf(ledger);
    std::size_t added = 0;  // numbers
    for (int k = 0; k < steps; ++k) {
        scene.step();
        added += 20 * (scene.interactions().size() + scene.particleHandler.getSize());
        scale = std::max(scale, largestOf(ledger));
        largest = std::max(
            largest, std::abs(ledger.closed() - closed) / (static_cast<double>(added) * 0x1p-53 * scale));
    }
    return largest;
}

}  // namespace pendular::energy
