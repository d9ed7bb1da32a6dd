#pragma once

#include <cmath>

#include "Kernel/Species/Field.h"

namespace pendular {

/// Whole steps nearest to an interval of output, at least one. Throws InputError unless it is positive.
/// @param interval s; @param timeStep s
inline std::size_t stepsOf(double interval, double timeStep) {
    checkValue("the output", "interval", interval, "s", positive);
    const double steps = std::round(interval / timeStep);
    return steps < 1 ? 1 : steps > 1e15 ? 0 : static_cast<std::size_t>(steps);
}

}  // namespace pendular
