#pragma once

#include <array>
#include <cmath>

#include "Kernel/Math/Pack.h"

namespace pendular {

/// The force of one bridge over its gap S, as a rational function of y = S / L, L = sqrt(2 V / (pi R)):
///     F = N(y) / (((1 + c y)^2 + y^2) (1 + y) (e - y)),   N of degree 7.
/// Derjaguin's force of a small bridge, D = 1 - y / sqrt(1 + y^2) (times 2 pi R gamma cos(theta)), branches
/// at y = +-i, and the exact force has a square root at the rupture distance: poles beside the former and
/// beyond the latter let one division do what would take two square roots otherwise. All poles are given
/// beforehand, and none is at a gap between contact and rupture.
template <class T>
struct RationalBridge {
    static constexpr int terms = 8;

    std::array<T, terms> numerator;
    T inverseLength;  // 1/L
    T end;            // e

    [[nodiscard]] T at(T gap) const { return atReduced(gap * inverseLength); }
    [[nodiscard]] T atReduced(T y) const {
        T sum = numerator[terms - 1];
        for (int k = terms - 2; k >= 0; --k) sum = sum * y + numerator[static_cast<std::size_t>(k)];
        return sum / denominator(y, end);
    }

    static T denominator(T y, T end) {
        constexpr double c = 0.16;  // by search: the least largest error over 60 bridges
        return (T(1) + y * (T(2 * c) + T(1 + c * c) * y)) * (T(1) + y) * (end - y);
    }
};

/// Derjaguin's D(y), the force of a small bridge over that at contact.
inline double derjaguinForce(double y) { return 1 / (std::sqrt(1 + y * y) * (std::sqrt(1 + y * y) + y)); }

/// The eight reduced gaps y at which a curve is held. They are dense towards contact, and the last one is 95
/// % of `reach`.
inline std::array<double, RationalBridge<double>::terms> curveNodes(double reach) {
    constexpr int count = RationalBridge<double>::terms;
    std::array<double, count> nodes;
    const double scale = std::asinh(0.95 * reach);
    for (int i = 0; i < count; ++i)
        nodes[static_cast<std::size_t>(i)] =
            std::sinh(scale * 0.5 * (1 - std::cos(std::numbers::pi * i / (count - 1))));
    return nodes;
}

/// Where the pole beyond the rupture is put, for a (roughly known) rupture distance at y = reach.
inline double endPole(double reach) { return 1.06 * reach; }

/// The curve with the given values of F / (D 2 pi R gamma) at its nodes.
/// @param reach (approximate) rupture distance / L; @param length L, m; @param forceScale 2 pi R gamma, N
inline RationalBridge<double> curveThrough(
    const std::array<double, RationalBridge<double>::terms>& forceOverDerjaguin, double reach, double length,
    double forceScale) {
    constexpr std::size_t count = RationalBridge<double>::terms;
    const auto nodes = curveNodes(reach);
    RationalBridge<double> curve{{}, 1 / length, endPole(reach)};
    std::array<double, count> difference;  // Newton's divided differences of N
    for (std::size_t i = 0; i < count; ++i)
        difference[i] = forceScale * forceOverDerjaguin[i] * derjaguinForce(nodes[i]) *
                        RationalBridge<double>::denominator(nodes[i], curve.end);
    for (std::size_t k = 1; k < count; ++k)
        for (std::size_t i = count - 1; i >= k; --i)
            difference[i] = (difference[i] - difference[i - 1]) / (nodes[i] - nodes[i - k]);
    auto& n = curve.numerator;
    n = {difference[count - 1]};
    for (std::size_t k = count - 1; k-- > 0;) {  // n(y) <- n(y) (y - node k) + difference k
        for (std::size_t j = count - 1; j > 0; --j) n[j] = n[j - 1] - nodes[k] * n[j];
        n[0] = difference[k] - nodes[k] * n[0];
    }
    return curve;
}

}  // namespace pendular
