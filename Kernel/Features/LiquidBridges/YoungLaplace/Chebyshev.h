#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

namespace pendular {

/// Node i of n: the zeros of T_n, descending in (-1, 1).
inline double chebyshevNode(int i, int n) { return std::cos(std::numbers::pi * (i + 0.5) / n); }

/// T_0(x) ... T_(count - 1)(x).
template <std::size_t count>
std::array<double, count> chebyshevPolynomials(double x) {
    std::array<double, count> t{1, x};
    for (std::size_t k = 2; k < count; ++k) t[k] = 2 * x * t[k - 1] - t[k - 2];
    return t;
}

/// Coefficients of the Chebyshev series that takes the given values at the nodes: in place, along one of the
/// dimensions of an array in which neighbours along it lie `stride` apart.
inline void toChebyshevSeries(std::span<double> values, std::size_t count, std::size_t stride) {
    std::array<double, 32> series{};
    const std::size_t block = count * stride;
    for (std::size_t begin = 0; begin < values.size(); begin += block)
        for (std::size_t offset = begin; offset < begin + stride; ++offset) {
            for (std::size_t k = 0; k < count; ++k) {
                double sum = 0;
                for (std::size_t i = 0; i < count; ++i)
                    sum += values[offset + i * stride] * std::cos(std::numbers::pi * k * (i + 0.5) / count);
                series[k] = sum * (k == 0 ? 1.0 : 2.0) / count;
            }
            for (std::size_t k = 0; k < count; ++k) values[offset + k * stride] = series[k];
        }
}

/// A vector of `values` numbers as a product of Chebyshev series in two variables in [-1, 1].
template <std::size_t first, std::size_t second, std::size_t values>
struct ChebyshevPlane {
    std::array<double, first * second * values> coefficients;

    /// The product at a place; only terms up to T_(largest - 1) in each variable count, if that is given.
    [[nodiscard]] std::array<double, values> at(double x, double y, std::size_t largest = 32) const {
        const auto tx = chebyshevPolynomials<first>(x);
        const auto ty = chebyshevPolynomials<second>(y);
        std::array<double, second * values> line{};
        for (std::size_t i = 0; i < std::min(first, largest); ++i)
            for (std::size_t k = 0; k < second * values; ++k)
                line[k] += tx[i] * coefficients[i * second * values + k];
        std::array<double, values> sum{};
        for (std::size_t j = 0; j < std::min(second, largest); ++j)
            for (std::size_t v = 0; v < values; ++v) sum[v] += ty[j] * line[j * values + v];
        return sum;
    }
};

/// A vector of `values` numbers as a product of Chebyshev series in three variables; coefficients are
/// integers, in units of `unit`.
template <std::size_t first, std::size_t second, std::size_t third, std::size_t values>
struct ChebyshevProduct {
    static constexpr std::array<std::size_t, 3> shape{first, second, third};
    static constexpr std::size_t valueCount = values;
    static constexpr double unit = 1e-6;

    std::array<std::int32_t, first * second * third * values> coefficients;

    /// The product at a value of the first variable; only terms up to T_(largest - 1) in it, if that is
    /// given.
    [[nodiscard]] ChebyshevPlane<second, third, values> at(double x, std::size_t largest = 32) const {
        constexpr std::size_t size = second * third * values;
        const auto tx = chebyshevPolynomials<first>(x);
        ChebyshevPlane<second, third, values> plane{};
        for (std::size_t i = 0; i < std::min(first, largest); ++i)
            for (std::size_t k = 0; k < size; ++k)
                plane.coefficients[k] += unit * tx[i] * coefficients[i * size + k];
        return plane;
    }
};

}  // namespace pendular
