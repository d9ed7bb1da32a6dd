#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Species/Species.h"

namespace pendular {

/// The time (s) in which a Rayleigh wave passes a grain: pi r sqrt(rho / G) / (0.1631 nu + 0.8766).
/// Common practice for Hertzian contacts is a step of 0.1 to 0.2 of it. Source: Thornton and Randall (1988).
/// @param radius m; @param shearModulus Pa; @param density kg/m^3
inline double rayleighTime(double radius, double shearModulus, double poissonRatio, double density) {
    return std::numbers::pi * radius * std::sqrt(density / shearModulus) / (0.1631 * poissonRatio + 0.8766);
}

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

/// An overlap (of the smaller radius) that a sound scene does not exceed; the stiffness of Hertz's law grows
/// with it.
inline constexpr double largestSoundOverlap = 0.05;

/// The time step (s) above which the contact of two grains is no longer integrated stably: 2 / omega for the
/// stiffest of its oscillations at the largest sound overlap, the normal one, k_n / m*, and the tangential
/// one, 7/2 k_t / m* (a solid sphere's spin adds 5/2 / m), those of rolling and torsion, at most 5/2 k / m*,
/// halved because the stiffest oscillation of a grain
/// among many neighbours is up to twice as fast.
/// @param effectiveMass kg, m1 m2 / (m1 + m2)
template <class Mixed>
double stabilityLimit(const Mixed& laws, const Bodies& bodies, double effectiveMass) {
    using Normal = typename Mixed::Normal;
    using Friction = typename Mixed::Friction;
    const double overlap = largestSoundOverlap * std::min(bodies.radius1, bodies.radius2);
    const double radius = bodies.effectiveRadius();
    const Contact<double> contact{overlap, radius, effectiveMass};
    const auto& normal = static_cast<const Normal&>(laws);
    double stiffness = Normal::stiffness(normal.prepare(), contact);
    if constexpr (Friction::acts)
        stiffness =
            std::max(stiffness,
                     3.5 * Friction::stiffness(static_cast<const Friction&>(laws).prepare(normal), contact));
    if constexpr (HasContactTorque<Friction>)
        stiffness = std::max(
            stiffness, 2.5 * Friction::rotationStiffness(static_cast<const Friction&>(laws).prepare(normal)));
    return std::sqrt(effectiveMass / stiffness);
}

}  // namespace pendular
