#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Species/Stiffness.h"
#include "Kernel/Species/Normal/Shared/ContactTime.h"
#include "Kernel/Species/Species.h"

namespace pendular {

/// The time (s) in which a Rayleigh wave passes a grain: pi r sqrt(rho / G) / (0.1631 nu + 0.8766).
/// Common practice for Hertzian contacts is a step of 0.1 to 0.2 of it. Source: Thornton and Randall (1988).
/// @param radius m; @param shearModulus Pa; @param density kg/m^3
inline double rayleighTime(double radius, double shearModulus, double poissonRatio, double density) {
    return std::numbers::pi * radius * std::sqrt(density / shearModulus) / (0.1631 * poissonRatio + 0.8766);
}

/// An overlap (of the smaller radius) that a sound scene does not exceed; the stiffness of Hertz's law grows
/// with it.
inline constexpr double largestSoundOverlap = 0.05;

/// The stiffness of two bodies at the largest sound overlap, whose friction sticks. Laws of friction and
/// torque are asked for their force: a dashpot answers a speed, a spring the way; one without a coefficient
/// of friction has neither. An attraction that changes with the overlap (JKR's neck) adds its slope.
/// @param effectiveMass kg, m1 m2 / (m1 + m2)
template <class Mixed>
ContactStiffness contactStiffness(const Mixed& laws, const Bodies& bodies, double effectiveMass) {
    using Normal = typename Mixed::Normal;
    using Friction = typename Mixed::Friction;
    using Adhesion = typename Mixed::Adhesion;
    const Contact<double> contact{largestSoundOverlap * std::min(bodies.radius1, bodies.radius2),
                                  bodies.effectiveRadius(), effectiveMass};
    const auto& normal = static_cast<const Normal&>(laws);
    const auto prepared = normal.prepare();
    typename NormalHistoryOf<Normal>::template type<double> history{};
    ContactStiffness found;
    found.normal = {Normal::stiffness(prepared, contact),
                    normalForce<Normal>(prepared, contact, history).damping};
    if constexpr (requires { requires Adhesion::readsOverlap; }) {
        const auto interaction = static_cast<const Adhesion&>(laws).prepare(bodies);
        const double shift = 1e-4 * contact.overlap;
        found.normal.spring +=
            (interaction.force(shift - contact.overlap) - interaction.force(-shift - contact.overlap)) /
            (2 * shift);
    }
    BridgeResistance<double> bridge;
    if constexpr (bridgeResists<Adhesion> != BridgeResists::Nothing)
        bridge = static_cast<const Adhesion&>(laws).largestResistance(bodies);
    if constexpr (Friction::acts) {
        constexpr double sticking = 1e100;  // N
        const auto friction = static_cast<const Friction&>(laws).prepare(normal);
        const auto ask = [](auto&& force) {
            const double dashpot = norm(force(0.0)), both = norm(force(1.0));
            return SpringAndDashpot{both - dashpot, dashpot};
        };
        const Vector<double> along{1, 0, 0}, across{0, 1, 0};
        found.sliding = ask([&](double time) {
            typename Friction::template History<double> springs{};
            return Friction::force(friction, contact, sticking, Slip<double>{across, time, 0}, springs);
        });
        if constexpr (HasContactTorque<Friction>) {
            const auto turning = [&](const Vector<double>& velocity) {
                return ask([&](double time) {
                    typename Friction::template History<double> springs{};
                    return Friction::rotationForce(friction, sticking, along, Slip<double>{velocity, time, 0},
                                                   springs);
                });
            };
            found.rolling = turning(across);
            found.torsion = turning(along);
        }
    }
    found.normal.dashpot += bridge.normal;
    found.sliding.dashpot += bridge.sliding + std::abs(bridge.coupling);
    found.rolling.dashpot += bridge.rolling + std::abs(bridge.coupling);
    return found;
}

/// The square of R* over the smaller radius: 1/4 of equal grains, 1 at a wall. It is at most this share of
/// 5/2 / m* by which a torque of the contact's own moves R* times the relative spin.
inline double squaredLeverOfRotation(const Bodies& bodies) {
    const double lever = bodies.effectiveRadius() / std::min(bodies.radius1, bodies.radius2);
    return lever * lever;
}

/// Half a period (s) of the fastest oscillation of a pair at the largest sound overlap, without damping: the
/// time that a touch lasts, pi / omega, or less where sliding (7/2 k_t / m*) or rolling is stiffer.
/// @param effectiveMass kg, m1 m2 / (m1 + m2)
template <class Mixed>
double halfPeriod(const Mixed& laws, const Bodies& bodies, double effectiveMass) {
    const ContactStiffness contact = contactStiffness(laws, bodies, effectiveMass);
    const double turn = 2.5 * squaredLeverOfRotation(bodies);
    const double stiffest = std::max({contact.normal.spring, 3.5 * contact.sliding.spring,
                                      turn * contact.rolling.spring, turn * contact.torsion.spring});
    return std::numbers::pi * std::sqrt(effectiveMass / stiffest);
}

}  // namespace pendular
