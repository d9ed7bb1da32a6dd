#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "Drivers/Shared/Beverloo.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// The flow of a discharge between two times, and its standard error.
struct MeanFlow {
    double flow;   // kg/s: what has come out over the time
    double error;  // kg/s, by batch means; NaN with fewer than five batches
};

/// The flow of a curve of time (s) and mass that has come out (kg), in the order of time. The error is that
/// of the mean of twenty batches, windows of equal numbers of intervals (of as many as there are, if fewer):
/// s over the root of their number. A line of least squares through the mass has 6/5 of this variance, and
/// its residuals are correlated in time, so the standard error of the fit is far too small. Throws InputError
/// with fewer than two points.
inline MeanFlow meanFlow(std::span<const CurvePoint> curve) {
    if (curve.size() < 2 || !(curve.back().x > curve.front().x))
        throw InputError("A flow needs two points of the discharge at least, at different times.");
    const auto rate = [&](std::size_t from, std::size_t to) {
        return (curve[to].y - curve[from].y) / (curve[to].x - curve[from].x);
    };
    const std::size_t intervals = curve.size() - 1, batches = std::min<std::size_t>(intervals, 20),
                      length = intervals / batches, first = intervals - batches * length;
    double sum = 0, squares = 0;
    for (std::size_t k = 0; k < batches; ++k) sum += rate(first + k * length, first + (k + 1) * length);
    const auto count = static_cast<double>(batches);
    for (std::size_t k = 0; k < batches; ++k) {
        const double off = rate(first + k * length, first + (k + 1) * length) - sum / count;
        squares += off * off;
    }
    return {rate(0, intervals), batches < 5 ? unset : std::sqrt(squares / (count * (count - 1)))};
}

/// The points of a curve from one time (s) to another one.
inline std::span<const CurvePoint> partOf(std::span<const CurvePoint> curve, double from, double to) {
    const auto first = std::ranges::lower_bound(curve, from, {}, &CurvePoint::x);
    const auto end = std::ranges::upper_bound(first, curve.end(), to, {}, &CurvePoint::x);
    return {first, end};
}

}  // namespace pendular
