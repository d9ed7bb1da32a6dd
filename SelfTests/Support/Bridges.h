#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "Kernel/Scene/BridgeLaws.h"

namespace pendular::support {

inline constexpr double tension = 0.5 / std::numbers::pi;  // N/m: 2 pi R gamma = 1 N, so F* = F

inline double radians(double degrees) {
    return std::min(degrees * (std::numbers::pi / 180), std::numbers::pi);
}

/// V in m^3.
template <class Law>
Law bridge(double volume, double degrees) {
    Law law;
    law.setLiquidBridgeVolume(volume);
    law.setContactAngle(radians(degrees));
    law.setSurfaceTension(tension);
    return law;
}

/// Separations from 0 to the end, dense towards both 0 and the end.
inline std::vector<double> separations(double end) {
    std::vector<double> all{0};
    for (double decade = -20; decade < -2; decade += 0.25) all.push_back(end * std::pow(10, decade));
    for (int k = 4; k <= 400; ++k) all.push_back(end * (k / 400.0));
    return all;
}

/// The largest relative step of a function between neighbouring numbers, found by bisection of [a, b] towards
/// the half with the larger change: about rounding if the function is continuous, the jump if there is one.
template <class Function>
double jump(Function&& f, double a, double b) {
    double fa = f(a), fb = f(b);
    while (true) {
        const double middle = 0.5 * (a + b);
        if (!(a < middle && middle < b))
            return std::abs(fa - fb) / std::max({std::abs(fa), std::abs(fb), 1e-300});
        const double fm = f(middle);
        if (std::abs(fm - fa) > std::abs(fb - fm)) b = middle, fb = fm;
        else a = middle, fa = fm;
    }
}

/// A place at which a function of [a, b] is not finite or jumps by more than a bound; nothing if there is
/// none. Every interval over which it changes by more than the bound is halved until it does not, or until no
/// number lies between its ends. (Two jumps that cancel within an interval of the start are not seen.)
template <class Function>
std::optional<double> findJump(Function&& f, double a, double b, double bound) {
    struct Interval {
        double a, fa, b, fb;
    };
    std::vector<Interval> open{{a, f(a), b, f(b)}};
    while (!open.empty()) {
        const Interval i = open.back();
        open.pop_back();
        if (!std::isfinite(i.fa) || !std::isfinite(i.fb)) return std::isfinite(i.fa) ? i.b : i.a;
        if (std::abs(i.fb - i.fa) <= bound) continue;
        const double middle = i.a + 0.5 * (i.b - i.a);
        if (!(i.a < middle && middle < i.b)) return middle;
        const double value = f(middle);
        open.push_back({i.a, i.fa, middle, value});
        open.push_back({middle, value, i.b, i.fb});
        const bool leftIsSteeper = std::abs(value - i.fa) > std::abs(i.fb - value);
        if (leftIsSteeper) std::swap(open[open.size() - 2], open.back());  // a pole is met at once
    }
    return {};
}

}  // namespace pendular::support
