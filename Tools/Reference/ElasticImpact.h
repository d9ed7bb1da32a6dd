#pragma once

#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <numbers>

#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Reference/PartialSlipContact.h"

namespace pendular {

/// Something that has a tangential force: PartialSlipContact, or a friction law to be compared with it.
template <class Contact>
concept TangentialContact = requires(Contact contact, double overlap, const Vector<double>& slip) {
    contact.move(overlap, slip);
    { contact.tangentialForce() } -> std::convertible_to<Vector<double>>;
};

/// The elastic impact of a solid sphere of the mass m* on a plane: Hertz's normal force with a dashpot, any
/// tangential law; the contact point is at the radius r from the centre (the overlap is small against it).
struct ElasticImpact {
    PartialSlipConditions conditions;
    double mass = 1;         // m*, kg
    double approach = 1;     // m/s, speed along the normal
    double restitution = 1;  // of the normal speed
    static constexpr int mostContactTimes = 100;

    struct Motion {
        Vector<double> velocity;  // m/s, of the centre, tangential
        Vector<double> rim;       // m/s, of the contact point against the centre, tangential
        double normal;            // m/s, away from the plane

        [[nodiscard]] Vector<double> slip() const { return velocity + rim; }
    };

    /// Johnson (1985), Contact Mechanics, equation 11.23.
    [[nodiscard]] double largestOverlap() const {
        return std::pow(15 * mass * approach * approach /
                            (16 * conditions.elasticModulus * std::sqrt(conditions.effectiveRadius)),
                        0.4);
    }
    [[nodiscard]] double contactTime() const { return 2.9432 * largestOverlap() / approach; }  // s

    /// Solves the impact by the leapfrog, with `steps` for the time of an elastic contact: second order.
    /// @param before tangential motion; its normal speed is that of the approach
    /// Throws InputError where the bodies do not part.
    /// @param each called after each move with the overlap (m), the slip (m) of the move and the force (N)
    template <TangentialContact Contact, class Watch>
    Motion solve(Motion before, Contact& contact, int steps, Watch each) const {
        const double h = contactTime() / steps, inverseMass = 1 / mass;
        // Tsuji, Tanaka and Ishida (1992): the dashpot beta sqrt(m* k) with k = 4/3 E* a.
        const double logarithm = std::log(restitution);
        const double beta = restitution == 0
                                ? std::sqrt(5.0)
                                : -std::sqrt(5.0) * logarithm / std::hypot(logarithm, std::numbers::pi);
        double overlap = 0, speed = approach, normalForce = 0;
        Motion motion = before;
        Vector<double> force{0, 0, 0};
        const auto kick = [&] {  // half a step; I = 2/5 m r^2
            speed -= 0.5 * h * inverseMass * normalForce;
            motion.velocity += (0.5 * h * inverseMass) * force;
            motion.rim += (0.5 * h * 2.5 * inverseMass) * force;
        };
        // A restitution of 0 or nearly 0 has no end: the body creeps out ever more slowly.
        for (int step = 0;; ++step) {
            if (step >= mostContactTimes * steps)
                throw InputError(fmt::format(
                    "ElasticImpact: restitution = {:.6g}: the bodies have not parted after {} contact times; "
                    "it must be larger, and at most 1.",
                    restitution, mostContactTimes));
            kick();
            overlap += h * speed;
            if (overlap <= 0) break;
            const Vector<double> slip = h * motion.slip();
            contact.move(overlap, slip);
            force = contact.tangentialForce();
            const double stiffness =
                4.0 / 3.0 * conditions.elasticModulus * conditions.contactRadius(overlap);
            normalForce = stiffness * overlap + beta * std::sqrt(mass * stiffness) * speed;
            each(overlap, slip, force);
            kick();
        }
        motion.normal = -speed;
        return motion;
    }
    template <TangentialContact Contact>
    Motion solve(Motion before, Contact& contact, int steps) const {
        return solve(before, contact, steps, [](double, const Vector<double>&, const Vector<double>&) {});
    }
};

}  // namespace pendular
