#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include "Kernel/Laws/Concepts/Field.h"

// Times of this program, means and medians.

namespace pendular {

/// Seconds that the processor has spent on this program: others do not count.
inline double processorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

inline double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// A mean, and its standard error from the scatter.
struct MeanAndError {
    double mean = unset, error = unset;
};
inline MeanAndError meanOf(const std::vector<double>& values) {
    if (values.size() < 2) return {values.empty() ? unset : values[0], unset};
    const auto count = static_cast<double>(values.size());
    double mean = 0, squares = 0;
    for (const double value : values) mean += value / count;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (count * (count - 1)))};
}

/// The median over the rounds of the times / those of another law in the same round.
inline double timeOver(const std::vector<double>& times, const std::vector<double>& reference) {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < std::min(times.size(), reference.size()); ++k)
        ratios.push_back(times[k] / reference[k]);
    return ratios.empty() ? unset : median(ratios);
}

}  // namespace pendular
