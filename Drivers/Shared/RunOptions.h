#pragma once

#include <cmath>

#include "Kernel/Species/Field.h"

namespace pendular {

/// Throws InputError, before a scene is made, unless a run with these options can begin.
/// @param endTime s; @param interval s
inline void checkRun(std::string_view driver, std::size_t number, double endTime, double interval,
                     int threads) {
    checkValue(driver, "number of grains", static_cast<double>(number), "", {1, 1e8});
    checkValue(driver, "end time", endTime, "s", notNegative);
    checkValue(driver, "interval", interval, "s", positive);
    checkValue(driver, "number of threads", threads, "", {1, 4096});
}

/// Whole steps nearest to an interval of output, at least one; 0 (no output between) where they are more than
/// 1e15.
/// @param interval s; @param timeStep s
inline std::size_t stepsOf(double interval, double timeStep) {
    const double steps = std::round(interval / timeStep);
    return steps < 1 ? 1 : steps > 1e15 ? 0 : static_cast<std::size_t>(steps);
}

}  // namespace pendular
