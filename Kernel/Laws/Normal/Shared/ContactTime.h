#pragma once

#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/Field.h"

// How long collisions last, in closed form.

namespace pendular {

/// The time (s) that two elastic Hertzian spheres touch when they meet at the given speed (m/s):
/// 2 sqrt(pi) Gamma(7/5)/Gamma(9/10) d_max / v, with the largest overlap d_max = (15 m* v^2 / (16 E*
/// sqrt(R*)))^(2/5).
inline double hertzContactTime(double effectiveModulus, double effectiveRadius, double effectiveMass,
                               double speed) {
    const double overlap = std::pow(
        15 * effectiveMass * speed * speed / (16 * effectiveModulus * std::sqrt(effectiveRadius)), 0.4);
    return 2 * std::sqrt(std::numbers::pi) * std::tgamma(1.4) / std::tgamma(0.9) * overlap / speed;
}

/// The time (s) that two grains joined by a linear spring (N/m) and dashpot (kg/s) touch: half the period of
/// the damped oscillator. Infinite where the dashpot is beyond critical.
inline double linearContactTime(double stiffness, double dissipation, double effectiveMass) {
    const double rate = 0.5 * dissipation / effectiveMass;
    const double frequency2 = stiffness / effectiveMass - rate * rate;
    return frequency2 > 0 ? std::numbers::pi / std::sqrt(frequency2) : infinity;
}

/// A linear spring (N/m) and dashpot (kg/s).
struct CollisionSpring {
    double stiffness, dissipation;
};
/// Those with which two grains of the given mass (kg) each collide for a time (s) and part with the
/// restitution coefficient (0 to 1, 0 excluded): the damped oscillator of the reduced mass.
inline CollisionSpring springOfCollision(std::string_view law, double collisionTime, double restitution,
                                         double mass) {
    checkValue(law, "collision time", collisionTime, "s", positive);
    checkValue(law, "restitution coefficient", restitution, "", positiveUpTo(1));
    checkValue(law, "mass", mass, "kg", positive);
    const double reducedMass = 0.5 * mass;
    const double rate = -std::log(restitution) / collisionTime;
    const double frequency = std::numbers::pi / collisionTime;
    return {reducedMass * (frequency * frequency + rate * rate), 2 * reducedMass * rate};
}
/// The dashpot (kg/s) that gives the restitution coefficient to two grains of the given mass (kg) each.
inline double dashpotOfCollision(std::string_view law, double stiffness, double restitution, double mass) {
    checkValue(law, "restitution coefficient", restitution, "", positiveUpTo(1));
    checkValue(law, "mass", mass, "kg", positive);
    const double logarithm = std::log(restitution);
    const double dampingRatio = -logarithm / std::hypot(logarithm, std::numbers::pi);
    return 2 * dampingRatio * std::sqrt(0.5 * mass * stiffness);
}

/// The time (s) that two grains touch by Hertz's law with the dashpot beta sqrt(m* k) d^(1/4), k = 4/3 E*
/// sqrt(R*); infinite from beta = sqrt(5) on. With ds = sqrt(k/m*) d^(1/4) dt, z = 4/5 d^(5/4) is a damped
/// oscillator (Antypov and Elliott 2011, EPL 94, 50004), z = v sqrt(m*/k) e^(-beta s/2) sin(w s) / w, w^2 =
/// (5 - beta^2)/4. So t is sqrt(m*/k) times the integral of (5 z/4)^(-1/5) over s from 0 to pi/w: over that
/// of beta = 0 it is (2 w / sqrt(5))^(-4/5) e^(pi a/2) |Gamma(9/10)/Gamma(9/10 + i a/2)|^2, a = beta / (10
/// w). Source of the integral: Gradshteyn and Ryzhik, 3.892.1.
inline double dampedHertzContactTime(double effectiveModulus, double effectiveRadius, double effectiveMass,
                                     double speed, double beta) {
    if (beta * beta >= 5) return infinity;
    const double w = 0.5 * std::sqrt(5 - beta * beta), a = 0.1 * beta / w, y2 = 0.25 * a * a;
    constexpr int factors = 1000;  // the others, prod (1 + y2/(n + 9/10)^2), are e^(y2/(factors + 2/5))
    double product = std::exp(y2 / (factors + 0.4));
    for (int n = 0; n < factors; ++n) product *= 1 + y2 / ((n + 0.9) * (n + 0.9));
    return hertzContactTime(effectiveModulus, effectiveRadius, effectiveMass, speed) *
           std::pow(2 * w / std::sqrt(5.0), -0.8) * std::exp(0.5 * std::numbers::pi * a) * product;
}

}  // namespace pendular
