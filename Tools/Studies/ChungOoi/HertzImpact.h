#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pendular::papers {

/// An elastic normal impact by Hertz's theory, in closed form. The energy balance
/// m v^2 (1 - u^(5/2)) = m (dd/dt)^2 of the overlap d = u d_max is solved by u = sin(angle)^(4/5).
struct HertzImpact {
    double modulus, radius, mass;  // E* in Pa, R* in m, m* in kg
    double speed;                  // of approach, m/s

    [[nodiscard]] double largestOverlap() const {  // m
        return std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4);
    }
    [[nodiscard]] double forceAt(double overlap) const {  // N
        return 4.0 / 3.0 * modulus * std::sqrt(radius * overlap) * overlap;
    }
    [[nodiscard]] double largestForce() const { return forceAt(largestOverlap()); }  // N
    [[nodiscard]] double contactTime() const {                                       // s
        return 2 * largestOverlap() / speed * scaledTime(std::pow(std::numbers::pi / 2, 0.8));
    }
    /// The overlap (m) at a time (s) from the start of the touch; 0 after its end.
    [[nodiscard]] double overlapAt(double time) const {
        if (time <= 0 || time >= contactTime()) return 0;
        const double wanted = std::min(time, contactTime() - time) * speed / largestOverlap();
        double s = wanted;  // Newton's method; the slope is between 1 and 1.1
        for (int k = 0; k < 10; ++k) s -= (scaledTime(s) - wanted) / slope(s);
        return largestOverlap() * std::pow(std::sin(std::pow(s, 1.25)), 0.8);
    }

private:
    /// The slope of the time, in d_max / v, over s = angle^(4/5), in which it is smooth.
    static double slope(double s) {
        const double angle = std::pow(s, 1.25);
        return angle > 0 ? std::pow(angle / std::sin(angle), 0.2) : 1;
    }
    /// The time, in d_max / v: the integral of the slope from the start of the touch, by Simpson's rule.
    static double scaledTime(double s) {
        constexpr int intervals = 64;
        double sum = slope(0) + slope(s);
        for (int k = 1; k < intervals; ++k) sum += (k % 2 == 1 ? 4 : 2) * slope(s * k / intervals);
        return sum * s / (3 * intervals);
    }
};

}  // namespace pendular::papers
