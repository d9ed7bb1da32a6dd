#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/Stiffness.h"
#include "Kernel/Laws/Normal/Shared/ContactTime.h"
#include "Kernel/Laws/Species/Species.h"

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

/// The stiffness of two bodies at an overlap, whose friction sticks. Laws of friction and torque are asked
/// for their force: a dashpot answers a speed, a spring the way; one without a coefficient of friction has
/// neither. An attraction that changes with the overlap (JKR's neck) adds its slope, and a bridge that
/// resists motion the largest that it can.
template <class Mixed>
class StiffnessOf {
public:
    using Normal = typename Mixed::Normal;
    using Friction = typename Mixed::Friction;
    using Adhesion = typename Mixed::Adhesion;

    explicit StiffnessOf(const Mixed& mixed)
        : laws(mixed),
          normal(static_cast<const Normal&>(mixed).prepare()),
          friction(static_cast<const Friction&>(mixed).prepare(static_cast<const Normal&>(mixed))) {}

    ContactStiffness operator()(const PressedPair& pair) const {
        const Contact<double> contact{pair.overlap, pair.bodies.effectiveRadius(), pair.effectiveMass};
        typename NormalHistoryOf<Normal>::template type<double> history{};
        ContactStiffness found;
        found.normal = {Normal::stiffness(normal, contact),
                        normalForce<Normal>(normal, contact, history).damping};
        addAdhesion(pair, found);
        if constexpr (Friction::acts) addFriction(contact, found);
        addBridge(pair, found);
        return found;
    }

private:
    void addAdhesion([[maybe_unused]] const PressedPair& pair,
                     [[maybe_unused]] ContactStiffness& found) const {
        if constexpr (requires { requires Adhesion::readsOverlap; }) {
            const auto interaction = static_cast<const Adhesion&>(laws).prepare(pair.bodies);
            const double shift = 1e-4 * pair.overlap;
            found.normal.spring +=
                (interaction.force(shift - pair.overlap) - interaction.force(-shift - pair.overlap)) /
                (2 * shift);
        }
    }
    void addFriction(const Contact<double>& contact, ContactStiffness& found) const {
        constexpr double sticking = 1e100;  // N
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
                    return Friction::rotationForce(friction, contact, sticking, along,
                                                   Slip<double>{velocity, time, 0}, springs);
                });
            };
            found.rolling = turning(across);
            found.torsion = turning(along);
        }
    }
    void addBridge([[maybe_unused]] const PressedPair& pair, [[maybe_unused]] ContactStiffness& found) const {
        if constexpr (bridgeResists<Adhesion> != BridgeResists::Nothing) {
            const BridgeResistance<double> bridge = resistanceOf(laws, pair);
            found.normal.dashpot += bridge.normal;
            found.sliding.dashpot += bridge.sliding + std::abs(bridge.coupling);
            found.rolling.dashpot += bridge.rolling + std::abs(bridge.coupling);
            found.implicitNeighbours = implicitNeighbours<Adhesion>;
        }
    }

    /// The largest that the law can have, or, where it grows with the overlap, that of now.
    static BridgeResistance<double> resistanceOf(const Adhesion& law, const PressedPair& pair) {
        if constexpr (requires { law.resistanceAt(pair.bodies, pair.overlap); })
            return law.resistanceAt(pair.bodies, pair.overlap);
        else return law.largestResistance(pair.bodies);
    }

    const Mixed& laws;
    typename Normal::Prepared normal;
    typename Friction::Prepared friction;
};

/// The stiffness of a contact at the largest sound overlap.
/// @param effectiveMass kg, m1 m2 / (m1 + m2)
template <class Mixed>
ContactStiffness contactStiffness(const Mixed& laws, const Bodies& bodies, double effectiveMass) {
    return StiffnessOf<Mixed>(laws)(
        {bodies, effectiveMass, largestSoundOverlap * std::min(bodies.radius1, bodies.radius2)});
}

/// The square of R* over the smaller radius: 1/4 of equal grains, 1 at a wall. It is at most this share of
/// 5/2 / m* by which a torque of the contact's own moves R* times the relative spin.
inline double squaredLeverOfRotation(const Bodies& bodies) {
    const double lever = bodies.effectiveRadius() / std::min(bodies.radius1, bodies.radius2);
    return lever * lever;
}

/// The stiffest spring (N/m) of friction against a motion of two grains: 7/2 k_t of sliding, 5/2 with the
/// lever of rotation of rolling and torsion.
inline double fastestOfPair(const ContactStiffness& contact, const Bodies& bodies) {
    const double turn = 2.5 * squaredLeverOfRotation(bodies);
    return std::max(
        {3.5 * contact.sliding.spring, turn * contact.rolling.spring, turn * contact.torsion.spring});
}

/// Half a period (s) of the fastest oscillation of a pair at the largest sound overlap, without damping: the
/// time that a touch lasts, pi / omega, or less where sliding (7/2 k_t / m*) or rolling is stiffer.
/// @param effectiveMass kg, m1 m2 / (m1 + m2)
template <class Mixed>
double halfPeriod(const Mixed& laws, const Bodies& bodies, double effectiveMass) {
    const ContactStiffness contact = contactStiffness(laws, bodies, effectiveMass);
    return std::numbers::pi *
           std::sqrt(effectiveMass / std::max(contact.normal.spring, fastestOfPair(contact, bodies)));
}

}  // namespace pendular
