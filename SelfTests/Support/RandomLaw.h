#pragma once

#include <stdexcept>
#include <string>

#include "SelfTests/Support/Draw.h"

namespace pendular::support {

/// A value for a field, of a size that is usual for its unit, within its range.
template <class Law>
double randomValue(Draw& draw, const Field<Law>& field) {
    const auto sized = [&]() -> double {
        if (field.unit == "Pa") return draw.logarithmic(1e5, 1e11);
        if (field.unit == "N/m") return draw.logarithmic(1, 1e6);
        if (field.unit == "s") return draw.logarithmic(1e-8, 1e-4);
        if (field.unit == "m") return draw.logarithmic(1e-9, 1e-4);
        if (field.unit == "") return field.range.lowest + draw.uniform(0.1, 1);
        return draw.uniform(0.1, 1);
    };
    const double value = sized();
    if (!field.range.contains(value)) throw std::logic_error("randomValue: " + std::string(field.name));
    return value;
}

template <class Law>
Law randomLaw(Draw& draw) {
    Law law;
    for (const auto& field : Law::fields()) law.*field.member = randomValue(draw, field);
    return law;
}

}  // namespace pendular::support
