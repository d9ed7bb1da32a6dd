#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "Drivers/Shared/SphereImpact.h"
#include "Tools/Studies/ChungOoi/HertzImpact.h"
#include "Tools/Studies/ChungOoi/IndependentImpact.h"

namespace pendular::papers {

constexpr int stepsOfContact = 200;
/// Relative error of an impulse: velocity Verlet's (w dt)^2 / 24 with w dt = 4.03 / steps for Hertz's period,
/// and the first moments of a touch, some dt^(5/4) (DryCollisionTest): 0.002 at 50 steps.
inline const double schemeError = 0.002 * std::pow(50.0 / stepsOfContact, 1.25);
/// The error of the slip: where the contact sticks, its spring swings through up to half a turn, and the slip
/// at the end is its phase. Its period and the end of the touch err like an impulse, and count with up to pi
/// each.
inline const double slipError = 2 * std::numbers::pi * schemeError;
/// The error of r x spin, in which an impulse counts 5/2 times as much: I = 2/5 m r^2.
inline const double rimError = 2.5 * slipError;
/// The error of Hertz's force over time, in largest forces: a shift in time, by which a touch of 2.94 d_max /
/// v may err like an impulse, and the steepest slope of the force, 1.5 F_max v / d_max at most.
inline const double forceError = 2.94 * 1.5 * schemeError;

/// One impact, and what becomes of it: as simulated, by theory, and where the contact slides throughout.
struct ImpactCase {
    using Sphere = scenes::SphereImpact::Sphere;
    using Motion = PlanarImpact::End;  // of the upper sphere, in the plane of the impact

    std::string material{};
    scenes::ImpactMaterial contact;
    Sphere upper;
    std::optional<Sphere> lower{};  // none: a rigid plane

    [[nodiscard]] double contactRadius() const {  // R*, m
        return lower ? 1 / (1 / upper.radius + 1 / lower->radius) : upper.radius;
    }
    /// 2 where the other body is the upper sphere's mirror image, 1 where it is held: the relative motion in
    /// motions of the upper sphere.
    [[nodiscard]] double share() const { return lower && !lower->fixed ? 2 : 1; }
    [[nodiscard]] double inverseMass() const {  // of the contact, 1/kg
        return share() * upper.inverseMass(contact.density);
    }
    [[nodiscard]] double slip() const {  // of the contact point before, m/s, per share
        return upper.velocity.x() - upper.radius * upper.spin.y();
    }
    /// The tangential speed (m/s) that friction takes where the contact slides throughout: mu times the
    /// change of the normal speed while the bodies press on each other. That is (1 + e) v_n without damping;
    /// a dashpot pulls at the end of a touch, and friction has no part in that. With y = overlap^(5/4) and a
    /// time scaled by overlap^(1/4) the damped touch is a linear oscillator (Antypov and Elliott (2011), EPL
    /// 94, 50004) with e = exp(-pi tan g), whose force is zero at the phase pi - 2 g and the speed
    /// e exp(2 g tan g) v_n.
    [[nodiscard]] double slidingImpulse() const {
        const double slope = -std::log(contact.restitution) / std::numbers::pi;
        const double parting = contact.restitution * std::exp(2 * std::atan(slope) * slope);
        return contact.friction * (1 + parting) * -upper.velocity.z();
    }
    /// The slip that friction takes at most, m/s: full sliding 7/2 of that impulse, sticking all of it.
    [[nodiscard]] double slipTaken() const { return std::min(std::abs(slip()), 3.5 * slidingImpulse()); }

    [[nodiscard]] scenes::SphereImpact scene() const {
        if (lower) return scenes::SphereImpact(contact, upper, *lower, stepsOfContact);
        return scenes::SphereImpact(contact, upper, stepsOfContact);
    }
    [[nodiscard]] Motion simulated() const {
        auto impact = scene();
        impact.setQuiet();
        impact.finish();
        const Sphere after = impact.sphere();
        return {after.velocity.z(), after.velocity.x(), after.radius * after.spin.y()};
    }
    /// The motion after the impact, by the independent integration of Hertz's and Mindlin's laws.
    [[nodiscard]] Motion integrated() const {
        // Tsuji, Tanaka and Ishida (1992): sqrt(5) (-ln e) / sqrt(ln^2 e + pi^2).
        const double logarithm = std::log(contact.restitution);
        const auto end =
            PlanarImpact{.radius = contactRadius(),
                         .inverseMass = inverseMass(),
                         .modulus = contact.modulus,
                         .shearModulus = contact.shearModulus,
                         .damping = -std::sqrt(5.0) * logarithm / std::hypot(logarithm, std::numbers::pi),
                         .friction = contact.friction,
                         .springFactor = contact.springFactor,
                         .sphereRadius = upper.radius,
                         .approach = -share() * upper.velocity.z(),
                         .sideways = share() * upper.velocity.x(),
                         .rim = share() * upper.radius * upper.spin.y()}
                .solve();
        return {end.parting / share(), end.sideways / share(), end.rim / share()};
    }
    /// The closed form of a contact that slides throughout, with its lever taken as the radius; none where
    /// that would turn the slip round.
    [[nodiscard]] std::optional<Motion> sliding() const {
        if (std::abs(slip()) < 3.5 * slidingImpulse()) return {};
        const double taken = std::copysign(slidingImpulse(), slip());
        return Motion{-contact.restitution * upper.velocity.z(), upper.velocity.x() - taken,
                      upper.radius * upper.spin.y() + 2.5 * taken};
    }
    /// The closed form of an elastic normal impact.
    [[nodiscard]] HertzImpact hertz() const {
        return {contact.modulus, contactRadius(), 1 / inverseMass(), -share() * upper.velocity.z()};
    }

    struct Moment {
        double time, overlap, force;  // s, m, N
    };
    /// The steps of the touch.
    [[nodiscard]] std::vector<Moment> history() const {
        auto impact = scene();
        impact.setQuiet();
        impact.initialise();
        std::vector<Moment> moments;
        do {
            impact.step();
            moments.push_back({impact.getTime(), std::max(impact.overlap(), 0.0),
                               impact.particleHandler.getObject(0).getForce().z()});
        } while (impact.overlap() > 0);
        return moments;
    }
};

}  // namespace pendular::papers
