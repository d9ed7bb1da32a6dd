#include "Kernel/Core/Run/OutputInterval.h"

#include <cmath>

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

OutputInterval::OutputInterval(std::string_view owner, double time) : seconds(time) {
    checkValue(owner, "interval", time, "s", notNegative);
}

bool OutputInterval::isDueAfter(std::size_t step, double timeStep, double timeBefore) {
    const double perStep = timeStep / seconds;
    const auto multipleBefore = [&](double place) {
        return std::floor(timeBefore / seconds + place * perStep);
    };
    const double multiple = multipleBefore(static_cast<double>(step) + 0.5);
    if (std::isnan(told)) told = multipleBefore(static_cast<double>(step) - 0.5);
    if (multiple <= told && perStep < 1) return false;
    told = multiple;
    return true;
}

}  // namespace pendular
