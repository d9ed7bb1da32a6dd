#pragma once

#include <algorithm>

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

inline Contact<double> contactAt(double overlap, double radius, double mass) {
    return {overlap, radius, mass};
}

struct Rebound {
    double speed, time, largestOverlap;
};

/// The law's own collision of two grains by the classical Runge-Kutta method, in steps of 1/4000 of the
/// elastic contact time and the end by interpolation. The dashpot's d^(1/4) at either end limits the order:
/// see the tolerances.
template <class Law>
Rebound collide(const Law& law, double radius, double mass, double speed, double contactTime) {
    const auto prepared = law.prepare();
    typename NormalHistoryOf<Law>::template type<double> history{};
    const auto acceleration = [&](double overlap, double approach) {
        auto tried = history;  // the stages of a step do not count
        const auto force = normalForce<Law>(prepared, contactAt(std::max(overlap, 0.0), radius, mass), tried);
        return -(force.elastic + force.damping * approach) / mass;
    };
    const double h = contactTime / 4000;
    double d = 0, v = speed, time = 0, largest = 0;
    while (true) {
        const double a1 = acceleration(d, v), v2 = v + h / 2 * a1;
        const double a2 = acceleration(d + h / 2 * v, v2), v3 = v + h / 2 * a2;
        const double a3 = acceleration(d + h / 2 * v2, v3), v4 = v + h * a3;
        const double a4 = acceleration(d + h * v3, v4);
        const double nextD = d + h / 6 * (v + 2 * v2 + 2 * v3 + v4),
                     nextV = v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
        if (v > 0 && nextV <= 0) largest = d + 0.5 * v * h * v / (v - nextV);  // a parabola at its top
        if (nextD <= 0) {
            const double share = d / (d - nextD);
            return {-(v + share * (nextV - v)), time + share * h, largest};
        }
        d = nextD, v = nextV, time += h;
        normalForce<Law>(prepared, contactAt(d, radius, mass), history);
    }
}

}  // namespace pendular
