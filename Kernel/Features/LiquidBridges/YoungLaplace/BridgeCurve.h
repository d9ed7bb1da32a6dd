#pragma once

#include <array>
#include <cmath>
#include <functional>

#include "Kernel/Foundation/Math/Pack.h"

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
        for (int k = terms - 2; k >= 0; --k) sum = fma(sum, y, numerator[static_cast<std::size_t>(k)]);
        return sum / denominator(y, end);
    }

    static T denominator(T y, T end) {
        constexpr double c = 0.16;  // by search: the least largest error over 60 bridges
        return fma(y, fma(T(1 + c * c), y, T(2 * c)), T(1)) * (T(1) + y) * (end - y);
    }
};

/// Values of F / D at the nodes of a curve.
using CurveValues = std::array<double, RationalBridge<double>::terms>;

/// Derjaguin's D(y), the force of a small bridge over that at contact.
inline double derjaguinForce(double y) { return 1 / (std::sqrt(1 + y * y) * (std::sqrt(1 + y * y) + y)); }

/// The eight reduced gaps y at which a curve is held. They are dense towards contact, and the last one is 95
/// % of `reach`, the (roughly known) rupture distance / L.
CurveValues curveNodes(double reach);

/// The curve with the given values of F / (D x force scale) at its nodes; its pole beyond the rupture is
/// at 1.06 reach.
/// @param length L, m; @param forceScale N
RationalBridge<double> curveThrough(const CurveValues& forceOverDerjaguin, double reach, double length,
                                    double forceScale);

/// The values of the curve that fits a force best from contact to y = most: least squares, of the error
/// relative to the force (or, where that is small beside D, to 1.5 % of D).
/// @param force F(y) / force scale; called for growing y
CurveValues fitCurve(const std::function<double(double)>& force, double most, double reach);

}  // namespace pendular
