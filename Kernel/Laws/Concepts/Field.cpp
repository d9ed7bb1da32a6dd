#include "Kernel/Laws/Concepts/Field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/ApartTexts.h"
#include "Kernel/Laws/Concepts/DomainLimit.h"

namespace pendular {

std::string Range::text(std::string_view unit) const {
    if (std::isinf(lowest) && std::isinf(highest))
        return "a finite number" + (unit.empty() ? std::string() : fmt::format(" of {}", unit));
    const std::string space = unit.empty() ? "" : " ";
    const std::string low =
        fmt::format("{} {}{}{}", lowestIncluded ? "at least" : "greater than", lowest, space, unit);
    if (std::isinf(highest)) return low + " and finite";
    return fmt::format("{} and {} {}{}{}", low, highestIncluded ? "at most" : "less than", highest, space,
                       unit);
}

std::string DomainLimit::text() const {
    const double limit = value < range.lowest ? range.lowest : range.highest;
    return fmt::format("{} = {}{}{}; it is made for {}", quantity, apartTexts(value, limit)[0],
                       unit.empty() ? "" : " ", unit, range.text(unit));
}

void checkValue(std::string_view owner, std::string_view field, double value, std::string_view unit,
                const Range& range) {
    if (range.contains(value)) return;
    const std::string allowed = range.text(unit);
    if (std::isnan(value))
        throw InputError(
            fmt::format("{}: {} is not set or not a number; it must be {}.", owner, field, allowed));
    throw InputError(fmt::format("{}: {} = {}{}{} is out of range; it must be {}.", owner, field, value,
                                 unit.empty() ? "" : " ", unit, allowed));
}

double mix(Mixing rule, double a, double b) {
    if (a == b) return a;
    switch (rule) {
        case Mixing::Arithmetic:
            return 0.5 * (a + b);
        case Mixing::Geometric:
            return std::sqrt(a * b);
        case Mixing::Harmonic:
            return 2 * a * b / (a + b);
        case Mixing::Largest:
            return isSet(b) ? std::max(a, b) : b;
        case Mixing::MeanCosine:
            return std::acos(0.5 * (std::cos(a) + std::cos(b)));
    }
    return unset;
}

std::string_view formula(Mixing rule) {
    switch (rule) {
        case Mixing::Arithmetic:
            return "(a + b) / 2";
        case Mixing::Geometric:
            return "sqrt(a b)";
        case Mixing::Harmonic:
            return "2 a b / (a + b)";
        case Mixing::Largest:
            return "max(a, b)";
        case Mixing::MeanCosine:
            return "arccos((cos a + cos b) / 2)";
    }
    return {};
}

}  // namespace pendular
