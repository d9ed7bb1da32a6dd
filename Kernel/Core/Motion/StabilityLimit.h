#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Laws/Concepts/Stiffness.h"
#include "Kernel/Laws/Species/TimeStepAdvice.h"

namespace pendular {

/// The contacts that a grain has along a direction and across it: the sums of the squared cosines and sines
/// between their normals and the direction; 4 and 8 in the densest packings of equal grains (twelve contacts,
/// alike in all directions). A single contact moves sliding grains by 7/2 of 1/m, 1 for the centre and 5/2
/// for the rim; those around a grain move either its centre or its rim.
struct Neighbours {
    double along, across;

    explicit Neighbours(std::size_t contacts)
        : along(std::min(static_cast<double>(contacts), 4.0)),
          across(std::min(1.4 * static_cast<double>(contacts), 8.0)) {}
};
inline constexpr std::size_t contactsInDensestBed = 12;

/// The share of the exact limit that is given: contacts may crowd along one direction (two at the poles, each
/// with five more at 60 degrees from it, are 4.5 along it: 6 %), and stiffness grows with the overlap.
inline constexpr double stabilityMargin = 0.9;

/// The limit of an integrator for the fastest motion that it can follow, one that changes its sign from step
/// to step (the root -1): it stands while spring (h w)^2 + dashpot h g <= 1, with the squared frequency w^2
/// and the dashpot over the mass g. The two are 1/4 and 1/2 for velocity Verlet, for the default 1/4 and 1
/// (less what is implicit).
struct SignChange {
    double spring, dashpot;

    explicit constexpr SignChange(const Integrator& i) {
        const double velocity =
            0.5 * (i.corrector * (1 + i.now + i.earlier) - (i.velocity0 - i.velocity1));  // over h a
        dashpot = velocity + i.velocity0 - i.velocity1;
        spring = 0.5 * (velocity + i.position0 - i.position1);
    }

    /// The largest step, s.
    [[nodiscard]] double limit(const SpringAndDashpot& mode) const {
        const double slope = dashpot * mode.dashpot;
        return 2 / (slope + std::sqrt(slope * slope + 4 * spring * mode.spring));
    }
};

/// The largest step (s) for turning motions with the given squared frequency (1/s^2) against tangential
/// springs that are kept half a step ahead, by predicted velocities. In the default scheme what lacks to the
/// right ones feeds an oscillation by a share (h w)^4 / 8 a step, and a dashpot takes h w^2 g / (2 k): the
/// step must be so short that the latter is more. A bed that lacks dashpots has no stable step; its springs
/// are moved otherwise (see lacksDashpots). The third-order scheme stands h w < 1.15, where two complex roots
/// leave the unit circle.
/// @param relaxation g / k (s) of the least damped spring
inline double springsAheadLimit(double squaredFrequency, double relaxation, const Integrator& integrator) {
    const double frequency = std::sqrt(squaredFrequency);
    if (!integrator.contacts.implicitForces) return 1.15 / frequency;
    return std::max(0.42 / frequency, std::cbrt(4 * relaxation / squaredFrequency));
}

/// Whether springs lack the dashpots to stop what the default scheme feeds them at h w = 0.42, 2.8-fold in
/// 400 steps at the stability limit: a damping ratio w g / (2 k) of the turning motion below 0.42^3 / 8 =
/// 0.0093. In such a bed the springs of the default are those of integrators::springsInStep.
inline bool lacksDashpots(double squaredFrequency, double relaxation) {
    return std::sqrt(squaredFrequency) * relaxation < 0.25 * 0.42 * 0.42 * 0.42;
}

/// The largest step (s) for springs beside dashpots that are implicit for n contacts of a grain. The velocity
/// that such a dashpot reads is found as if the last change of the spring's force, h k v, had moved the pair
/// n times as far: in a slow motion it is v (1 - n h^2 k / (2 m*)), and the dashpot drives the motion where
/// that is negative. Sliding, which the rims of spheres share, has 7/2 k_t.
/// @param effectiveMass kg, m1 m2 / (m1 + m2)
inline double implicitNeighboursLimit(const ContactStiffness& contact, double effectiveMass) {
    if (contact.implicitNeighbours == 1) return infinity;  // the limits of sign changes are below it
    const double spring = std::max(contact.normal.spring, 3.5 * contact.sliding.spring);  // N/m
    return std::sqrt(2 * effectiveMass / (contact.implicitNeighbours * spring));
}

/// The spring and dashpot that make grains turn against each other: 5/2 k_t / m* (of a solid sphere, 5/2 / m
/// at its rim) if neighbours turn in one sense, or that of rolling if they turn in the opposite one, and that
/// of torsion.
/// @param effectiveMass kg; the result is over a mass: squared frequency and rate
inline SpringAndDashpot turningAmong(const Neighbours& met, const ContactStiffness& contact,
                                     const Bodies& bodies, double effectiveMass) {
    const double rim = 2.5 / effectiveMass, turn = rim * squaredLeverOfRotation(bodies);
    return met.across * larger(rim * contact.sliding, turn * contact.rolling) +
           met.along * turn * contact.torsion;
}

/// The steps (infinite: never) in which the fastest turning motion of grains doubles, because its springs are
/// kept half a step ahead by predicted velocities, and lack the dashpots to stop it: see springsAheadLimit.
/// @param step s
template <class Mixed>
double stepsToDouble(const Mixed& laws, const Bodies& bodies, double effectiveMass,
                     const Integrator& integrator, std::size_t contacts, double step) {
    const ContactTiming& timing = integrator.contacts;
    if (!timing.implicitForces || timing.springsInStep || contacts == 1) return infinity;
    const ContactStiffness contact = contactStiffness(laws, bodies, effectiveMass);
    const double squared =
        step * step * turningAmong(Neighbours(contacts), contact, bodies, effectiveMass).spring;
    const double fed =
        squared * squared / 8 - 0.5 * squared * contact.shortestRelaxation() / step;  // share a step
    return fed > 0 ? std::numbers::ln2 / fed : infinity;
}

/// Whether the friction of grains with so many contacts lacks dashpots in the default scheme; see above.
template <class Mixed>
bool lacksDashpots(const Mixed& laws, const Bodies& bodies, double effectiveMass,
                   const Integrator& integrator, std::size_t contacts) {
    if (!integrator.contacts.implicitForces || contacts == 1) return false;
    const ContactStiffness contact = contactStiffness(laws, bodies, effectiveMass);
    const double squared = turningAmong(Neighbours(contacts), contact, bodies, effectiveMass).spring;
    return squared > 0 && lacksDashpots(squared, contact.shortestRelaxation());
}

/// The springs and dashpots that walls which forces move add to those of a grain, over the masses of the
/// walls: to its shifts, and to its turns.
struct WallResponse {
    SpringAndDashpot shift{}, spin{};

    friend WallResponse operator+(const WallResponse& a, const WallResponse& b) {
        return {a.shift + b.shift, a.spin + b.spin};
    }
    friend WallResponse operator*(double factor, const WallResponse& a) {
        return {factor * a.shift, factor * a.spin};
    }
};

/// The time step (s) above which grains with so many contacts, at the largest sound overlap, are no longer
/// integrated stably. The squared frequency of any motion of a bed is at most that of a pair times a count of
/// neighbours: the work of a contact, k (n.(v1 - v2))^2 <= k/m* (m1 (n.v1)^2 + m2 (n.v2)^2), is shared by its
/// grains as their kinetic energies are. So grains that shift in a bed have at most (along k_n + across k_t)
/// / m*; grains that turn have across (5/2) k_t / m* (of a solid sphere, 5/2 / m at its rim) if neighbours
/// turn in one sense, or that of rolling if they turn in the opposite one, and that of torsion. Dashpots
/// count in the same way. Of those that the integrator makes implicit, that of the pair is free; a single
/// contact has no others, and its tangential springs are implicit too: only its normal spring counts. (A pair
/// stands 2 / omega, but from sqrt(2) / omega on, a slow opening may be taken for the end of the touch.)
///
/// Rigid bodies have limits of their own (BodyLimits.h).
/// @param effectiveMass kg, m1 m2 / (m1 + m2)
/// @param ofWalls n contacts of a piston, the mass M, share it, so that by the same inequality each counts
/// for its grain with k (1/m + n/M), n k / M more than at a wall that is held; a wall that turns has its
/// mobility where it is touched in place of 1/M
/// @param heldDamping dashpots that follow from the mass are made for so many times it, where grains are held
/// along some axes; none of them is taken as implicit then
template <class Mixed>
double stabilityLimit(const Mixed& laws, const Bodies& bodies, double effectiveMass,
                      const Integrator& integrator = integrators::predictedVelocityVerlet,
                      std::size_t contacts = contactsInDensestBed, double heldDamping = 1,
                      const WallResponse& ofWalls = {}) {
    const Neighbours met(contacts);
    const ContactStiffness contact = contactStiffness(laws, bodies, heldDamping * effectiveMass);
    const double centre = 1 / effectiveMass;  // 1/kg
    SpringAndDashpot shift =
        centre * (met.along * contact.normal + met.across * contact.sliding) + ofWalls.shift;
    const SpringAndDashpot spin = turningAmong(met, contact, bodies, effectiveMass) + ofWalls.spin;

    const SignChange signChange(integrator);
    if (!integrator.contacts.timesTouches)
        return stabilityMargin * std::min(signChange.limit(shift), signChange.limit(spin));
    const bool isImplicit = integrator.contacts.implicitForces;
    const bool isOfPair = isImplicit && heldDamping == 1;
    const double neighbours = isImplicit ? implicitNeighboursLimit(contact, effectiveMass) : infinity;
    if (isOfPair && contacts == 1) {
        double squared = contact.normal.spring;
        if (integrator.contacts.springsInStep)  // those of friction are explicit
            squared = std::max(squared, fastestOfPair(contact, bodies));
        return std::min(
            stabilityMargin * std::sqrt(0.5) *
                signChange.limit({centre * squared + ofWalls.shift.spring, ofWalls.shift.dashpot}),
            stabilityMargin * neighbours);
    }
    if (isOfPair) shift.dashpot -= centre * contact.normal.dashpot;
    if (integrator.contacts.springsInStep)
        return stabilityMargin * std::min({neighbours, signChange.limit(shift), signChange.limit(spin)});
    return stabilityMargin *
           std::min({neighbours, signChange.limit(shift), signChange.limit({0, spin.dashpot}),
                     springsAheadLimit(spin.spring, contact.shortestRelaxation(), integrator)});
}

}  // namespace pendular
