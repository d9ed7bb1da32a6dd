#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Analysis/Output/FieldName.h"

namespace pendular::snapshot {

/// sRGB, each from 0 to 1.
struct Colour {
    double red, green, blue;
};

constexpr Colour fromBytes(unsigned code) {
    return {(code >> 16 & 255) / 255.0, (code >> 8 & 255) / 255.0, (code & 255) / 255.0};
}

/// Points of a colour map at equal distances; between them it is linear.
struct ColourMap {
    std::string_view name;
    std::array<unsigned, 9> points;

    [[nodiscard]] Colour at(double share) const {
        const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(points.size() - 1);
        const auto k = std::min(static_cast<std::size_t>(place), points.size() - 2);
        const double part = place - static_cast<double>(k);
        const Colour a = fromBytes(points[k]), b = fromBytes(points[k + 1]);
        return {a.red + part * (b.red - a.red), a.green + part * (b.green - a.green),
                a.blue + part * (b.blue - a.blue)};
    }
};

/// viridis: van der Walt and Smith (matplotlib, CC0), even steps of lightness; coolwarm: Moreland, "Diverging
/// color maps for scientific visualization" (2009).
inline constexpr std::array<ColourMap, 3> colourMaps{
    {{"viridis", {0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725}},
     {"coolwarm", {0x3b4cc0, 0x6282ea, 0x8db0fe, 0xb8d0f9, 0xdddddd, 0xf5c4ad, 0xf49a7b, 0xde604d, 0xb40426}},
     {"grey", {0x202020, 0x383838, 0x505050, 0x686868, 0x808080, 0x989898, 0xb0b0b0, 0xc8c8c8, 0xe0e0e0}}}};

/// The colours of whole numbers that are names: Okabe and Ito, "Color universal design" (2008), without
/// black.
inline constexpr std::array<unsigned, 7> namedColours{0xe69f00, 0x56b4e9, 0x009e73, 0xf0e442,
                                                      0x0072b2, 0xd55e00, 0xcc79a7};

/// "velocity_m_per_s" as a person writes it: "velocity (m/s)".
inline std::string label(std::string_view field) {
    auto [name, unit] = splitFieldName(field);
    std::replace(name.begin(), name.end(), '_', ' ');
    return unit.empty() ? name : fmt::format("{} ({})", name, unit);
}

/// Three to nine round numbers in [lowest, highest]: multiples of 1, 2 or 5 times a power of ten.
inline std::vector<double> ticks(double lowest, double highest) {
    const double largest = std::max(std::abs(lowest), std::abs(highest));
    if (!(highest - lowest > 1e-12 * largest)) return {lowest};  // numbers of ticks are whole below that
    const double rough = (highest - lowest) / 8, power = std::pow(10, std::floor(std::log10(rough)));
    double step = power;
    for (const double factor : {2.0, 5.0, 10.0})
        if (step < rough) step = factor * power;
    std::vector<double> found;
    for (double k = std::ceil(lowest / step - 1e-9); k * step <= highest + 1e-9 * step; ++k)
        found.push_back(k * step + 0.0);  // no negative zero
    return found;
}

/// The significant digits that tell equidistant numbers apart; 4 of a single number.
inline int digitsOf(const std::vector<double>& numbers) {
    if (numbers.size() < 2) return 4;
    const auto decade = [](double number) { return static_cast<int>(std::floor(std::log10(number))); };
    const double largest = std::max(std::abs(numbers.front()), std::abs(numbers.back()));
    return std::clamp(decade(largest) - decade(numbers[1] - numbers[0]) + 1, 1, 17);
}

}  // namespace pendular::snapshot
