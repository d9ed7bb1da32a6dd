#pragma once

#include <cmath>
#include <cstddef>

#include "Kernel/Species/Field.h"

namespace pendular {

/// The steps at which an output is due that has an interval of its own: those nearest to its multiples. They
/// follow from the number of the step alone, so a run that goes on has those of one that was not stopped.
class OutputInterval {
public:
    /// None: the output is due whenever writeOutput() is called.
    OutputInterval() = default;
    /// @param time s; 0: none
    OutputInterval(std::string_view owner, double time) : seconds(time) {
        checkValue(owner, "interval", time, "s", notNegative);
    }

    [[nodiscard]] bool isGiven() const { return seconds > 0; }
    /// Whether a multiple of the interval lies within half a step around this step. Two steps compute the
    /// border between them from the same numbers, so that no multiple is left out or counted twice.
    /// @param timeStep s; @param timeBefore s, of the steps that are not counted: those with another time
    /// step
    [[nodiscard]] bool isDueAfter(std::size_t step, double timeStep, double timeBefore = 0) const {
        const double perStep = timeStep / seconds, place = static_cast<double>(step),
                     before = timeBefore / seconds;
        return perStep >= 1 ||
               std::floor(before + (place + 0.5) * perStep) > std::floor(before + (place - 0.5) * perStep);
    }

private:
    double seconds = 0;
};

}  // namespace pendular
