#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace pendular {

/// The factor by which to enlarge cells, so that a box has no more than a number of them.
/// @param lengths m, of the box; @param size m, of a cell
[[nodiscard]] inline double enlargementOfCells(const std::array<double, 3>& lengths, double size,
                                               double most) {
    double factor = 1;
    const auto cells = [&] {
        double product = 1;
        for (const double length : lengths) product *= std::floor(length / (size * factor)) + 1;
        return product;
    };
    while (cells() > most) factor *= 1.25;
    return factor;
}

/// How many grains a grain finds in its own cell, itself included: the mean. 0 without grains.
/// @param begins where each cell begins in the sorted grains, and one more
[[nodiscard]] inline double crowdingOfCells(std::span<const std::uint32_t> begins) {
    double pairs = 0;
    for (std::size_t cell = 1; cell < begins.size(); ++cell) {
        const double grains = begins[cell] - begins[cell - 1];
        pairs += grains * grains;
    }
    return pairs > 0 ? pairs / static_cast<double>(begins.back() - begins.front()) : 0;
}

/// Some ten of the smallest grains of a level fit into a cell; with so many in the mean, a search looks at
/// too many pairs.
inline constexpr double crowded = 40;

}  // namespace pendular
