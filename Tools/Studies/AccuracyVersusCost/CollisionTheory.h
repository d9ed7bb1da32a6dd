#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

// Head-on collisions whose outcome is known without a contact's integration by the kernel.

namespace pendular::collisionTheory {

/// The damping over the critical one with which the linear oscillator, and Hertz's contact with its dashpot
/// of d^(1/4), rebound with e: |ln e| / sqrt(ln^2 e + pi^2). Source: Antypov and Elliott (2011), EPL 94,
/// 50004.
inline double dampingRatio(double restitution) {
    if (restitution == 0) return 1;
    return -std::log(restitution) / std::hypot(std::log(restitution), std::numbers::pi);
}

/// The restitution of the linear oscillator that is let go where its force is zero, before its dashpot can
/// pull. With the ratio z of its damping to the critical one, force and acceleration vanish at the phase
/// atan2(2 z sqrt(1 - z^2), 2 z^2 - 1). Source: Schwager and Poeschel (2007), Granular Matter 9, 465.
inline double restitutionWithoutPull(double ratio) {
    if (ratio == 1) return std::exp(-2.0);  // the limit from either side
    const double root = std::sqrt(std::abs(1 - ratio * ratio));
    const double phase =
        ratio < 1 ? std::atan2(2 * ratio * root, 2 * ratio * ratio - 1) : 2 * std::atanh(root / ratio);
    return std::exp(-ratio / root * phase);
}

/// What viscoelastic spheres do, in units of the elastic collision: lengths of (m* v^2 / k)^(2/5), times of
/// that over v, with k = 4/3 E* sqrt(R*).
struct ViscoelasticSpheres {
    double restitution = 0, overlap = 0, time = 0;
};

/// d'' = -d^(3/2) - x sqrt(d) d', d(0) = 0, d'(0) = 1, x = 3/2 A (k/m*)^(2/5) v^(1/5). With d = s^2 and dt
/// = 2 s dz the right-hand sides are polynomials, also at both ends of the touch: what is left of
/// steps of h = 1/1000 is h^2/4 of the time and of the overlap, between the last two of them. Source of the
/// law: Brilliantov et al. (1996), Physical Review E 53, 5382.
inline ViscoelasticSpheres collideViscoelasticSpheres(double x) {
    struct State {
        double s, v, t;
        State operator+(const State& o) const { return {s + o.s, v + o.v, t + o.t}; }
        State operator*(double h) const { return {s * h, v * h, t * h}; }
    };
    const auto slope = [x](const State& y) {
        return State{y.v, -2 * y.s * (y.s * y.s * y.s + x * y.s * y.v), 2 * y.s};
    };
    const double h = 1e-3;
    State y{0, 1, 0};
    ViscoelasticSpheres result;
    while (true) {
        const State a = slope(y), b = slope(y + a * (h / 2)), c = slope(y + b * (h / 2)),
                    d = slope(y + c * h);
        const State next = y + (a + b * 2 + c * 2 + d) * (h / 6);
        result.overlap = std::max(result.overlap, next.s * next.s);
        if (next.s <= 0) {
            const double share = y.s / (y.s - next.s);
            return {-(y.v + share * (next.v - y.v)), result.overlap, y.t + share * (next.t - y.t)};
        }
        y = next;
    }
}

/// The restitution of a plastic Hertzian contact without dashpot and cohesion: the square root of the share
/// of the energy that the branch of unloading gives back, l = 1 - k1/k2.
inline double plasticHertzianRestitution(double plasticity) {
    const double l = plasticity;
    if (l == 0) return 1;
    if (l == 1) return 0;
    return std::sqrt((0.4 * (1 - std::pow(l, 5.0 / 3)) - l * (1 - std::pow(l, 2.0 / 3))) / (0.4 * (1 - l)));
}

/// The place, from low on, at which a falling function has a value: by bisection, below the first power of
/// two beyond it.
template <class Function>
double whereFalling(Function&& function, double value, double low) {
    double high = 1;
    while (function(high) > value) high *= 2;
    for (int k = 0; k < 50; ++k) {
        const double middle = 0.5 * (low + high);
        (function(middle) > value ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace pendular::collisionTheory
