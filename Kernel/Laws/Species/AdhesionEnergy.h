#pragma once

#include <cmath>

namespace pendular {

/// J: minus the work that an interaction still does from a separation (m) to its range, by Simpson's rule in
/// the square root of the separation, dense towards contact; in contact the force stays what it is there.
template <class Interaction>
double adhesionEnergyOf(const Interaction& interaction, double separation) {
    const double range = interaction.range();
    if (!(separation < range)) return 0;
    constexpr int intervals = 200;
    const double nearest = separation > 0 ? separation : 0;
    const double first = std::sqrt(nearest), width = (std::sqrt(range) - first) / intervals;
    double sum = 0;
    for (int k = 0; k <= intervals; ++k) {
        const double root = first + k * width;
        const double weight = k == 0 || k == intervals ? 1 : k % 2 == 1 ? 4 : 2;
        sum += weight * 2 * root * interaction.force(root * root);
    }
    return -sum * width / 3 + (separation < 0 ? separation * interaction.force(0.0) : 0);
}

}  // namespace pendular
