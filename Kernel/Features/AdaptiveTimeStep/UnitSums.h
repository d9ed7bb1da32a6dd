#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// Rounds to the nearest multiple of the unit, a power of two, for values below 2^51 units: exact in sums of
/// a few thousand, so that no bit depends on their order.
inline double inUnits(double value, double unit) {
    constexpr double rounds = 0x1.8p52;
    return (value + rounds * unit) - rounds * unit;
}
/// 2^-40 of the power of two above the value.
inline double unitOf(double largest) { return largest > 0 ? std::ldexp(1.0, std::ilogb(largest) - 39) : 0; }

/// Adds factor x slip slip^T to a symmetric matrix of six rows, given by its lower half.
inline void addSquare(std::array<double, 21>& to, double factor, const std::array<double, 6>& slip,
                      double unit) {
    std::size_t k = 0;
    for (std::size_t row = 0; row < 6; ++row)
        for (std::size_t column = 0; column <= row; ++column)
            to[k++] += inUnits(factor * slip[row] * slip[column], unit);
}

inline constexpr std::array axesOfSpace{Vector<double>{1, 0, 0}, Vector<double>{0, 1, 0},
                                        Vector<double>{0, 0, 1}};

}  // namespace pendular
