#pragma once

#include "Kernel/Laws/Species/Species.h"

namespace pendular {

/// A sphere, or a wall through its position, perpendicular to its normal.
struct Body {
    Vector<double> position{0, 0, 0}, velocity{0, 0, 0}, spin{0, 0, 0};
    double radius = infinity;        // m
    double mass = infinity;          // kg
    Vector<double> normal{0, 0, 0};  // of a wall, unit, out of it
};

/// One contact as its first body sees it, in plain double, with explicit steps: what composes the laws here
/// is next to nothing, so that a test can have every combination of them.
template <class S>
class SeenContact {
public:
    using Normal = typename S::Normal;
    using Friction = typename S::Friction;
    using Adhesion = typename S::Adhesion;

    struct Action {
        Vector<double> force{0, 0, 0};   // N, on the first body
        Vector<double> torque{0, 0, 0};  // N m, on the first body, about its centre
        Vector<double> own{0, 0, 0};     // N m, of it the contact's own
    };

    explicit SeenContact(const typename S::Mixed& mixed) : laws(mixed) {}

    Action compute(const Body& a, const Body& b, double step) {
        const bool isWall = b.mass == infinity;
        const Vector<double> shift = b.position - a.position;
        const double distance = isWall ? -dot(shift, b.normal) : norm(shift);
        const Vector<double> normal = isWall ? -b.normal : (1 / distance) * shift;
        const double overlap = (isWall ? a.radius : a.radius + b.radius) - distance;
        const Bodies bodies{std::min(a.radius, b.radius), std::max(a.radius, b.radius)};
        const double mass = isWall ? a.mass : a.mass * b.mass / (a.mass + b.mass);
        const Contact<double> contact{max(overlap, 0.0), bodies.effectiveRadius(), mass};
        const Vector<double> velocity = a.velocity - b.velocity;

        Action action;
        const auto& normalLaw = static_cast<const Normal&>(laws);
        double force = 0;
        if (overlap > 0) {
            const auto f = normalForce<Normal>(normalLaw.prepare(), contact, normalHistory);
            force = f.elastic + f.damping * dot(velocity, normal);
        } else {
            normalHistory = {};
        }
        action.force = -force * normal;
        if constexpr (Adhesion::acts) {
            const auto interaction = static_cast<const Adhesion&>(laws).prepare(bodies);
            const double separation = separationFor<Adhesion>(overlap);
            joined = (overlap > 0 || joined || !Adhesion::formsAtContact) && separation < interaction.range();
            if (joined) action.force += interaction.force(separation) * normal;
        }
        if constexpr (Friction::acts) {
            const double lever1 = a.radius - 0.5 * overlap, lever2 = isWall ? 0 : b.radius - 0.5 * overlap;
            const Vector<double> sideways = velocity - dot(velocity, normal) * normal;
            history.turn({normal, normal - lastNormal, 0.5 * step * dot(a.spin + b.spin, normal)});
            lastNormal = normal;
            if (overlap > 0) {
                const auto law = static_cast<const Friction&>(laws).prepare(normalLaw);
                const double limit = max(force, 0.0);
                const Slip<double> slip{sideways + cross(lever1 * a.spin + lever2 * b.spin, normal),
                                        0.5 * step, 0.5 * step};
                const Vector<double> tangential = Friction::force(law, contact, limit, slip, history);
                action.force += tangential;
                action.torque = lever1 * cross(normal, tangential);
                if constexpr (HasContactTorque<Friction>) {
                    const Slip<double> turning{contact.effectiveRadius * (a.spin - b.spin), 0.5 * step,
                                               0.5 * step};
                    action.own = contact.effectiveRadius *
                                 Friction::rotationForce(law, contact, limit, normal, turning, history);
                    action.torque += action.own;
                }
            } else {
                history = {};
            }
        }
        return action;
    }

private:
    const typename S::Mixed& laws;
    typename Friction::template History<double> history{};
    typename NormalHistoryOf<Normal>::template type<double> normalHistory{};
    Vector<double> lastNormal{0, 0, 0};
    bool joined = false;
};

inline void push(Body& body, const Vector<double>& force, const Vector<double>& torque, double step) {
    body.velocity += (step / body.mass) * force;
    body.spin += (2.5 * step / (body.mass * body.radius * body.radius)) * torque;
    body.position += step * body.velocity;
}

}  // namespace pendular
