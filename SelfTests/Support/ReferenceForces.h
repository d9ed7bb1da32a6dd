#pragma once

#include <map>
#include <vector>

#include "Kernel/Core/Contacts/SampleTiming.h"
#include "Kernel/Core/Motion/TimeIntegration.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/ContactKey.h"

namespace pendular::support {

/// One grain, by its identity.
struct Body {
    Vector<double> position, velocity, spin, acceleration, angularAcceleration;
    double radius, inverseMass;
    int species;
};

inline std::vector<Body> bodiesOf(const ParticleStore& grains) {
    std::vector<Body> bodies;
    for (const std::uint32_t k : grains.place) {
        const TranslationRecord& t = grains.translation[k];
        bodies.push_back({t.position,
                          t.velocity,
                          {0, 0, 0},
                          grains.acceleration[k],
                          {0, 0, 0},
                          t.radius,
                          t.inverseMass,
                          grains.species[k]});
        if (grains.hasSpin) {
            bodies.back().spin = grains.rotation[k].spin;
            bodies.back().angularAcceleration = grains.rotation[k].angularAcceleration;
        }
    }
    return bodies;
}

/// The contact forces of a settling box, one contact after the other, over all pairs, in plain double: what
/// the batched kernel must give. Only the laws (with T = double) and the numbers of the species are the
/// kernel's.
template <class S>
class ReferenceForces {
public:
    using Normal = typename S::Normal;
    using Friction = typename S::Friction;
    using Adhesion = typename S::Adhesion;

    std::vector<Vector<double>> force, torque;  // N and N m, of each grain
    std::vector<double> scale;                  // N, sum of the sizes of the contact forces of each grain

    /// @param bodies at the end of a step (s), with their predicted velocities and spins
    void compute(const scenes::SettlingBox<S>& scene, const std::vector<Body>& bodies, double step) {
        force.assign(bodies.size(), {0, 0, 0});
        torque = force;
        scale.assign(bodies.size(), 0);
        const auto& species = scene.speciesHandler;
        for (std::uint32_t i = 0; i < bodies.size(); ++i) {
            const Body& a = bodies[i];
            for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
                const Body& b = bodies[j];
                const Vector<double> shift = b.position - a.position;
                const double sum = a.radius + b.radius, distance2 = squaredNorm(shift);
                Memory& memory = memories[{-1, i, j}];
                if (distance2 >= sum * sum && !memory.bridged) {
                    memory = {};
                    continue;
                }
                const double distance = sqrt(distance2);
                Geometry g{(1 / distance) * shift,
                           sum - distance,
                           1 / distance,
                           a.radius * b.radius / sum,
                           1 / (a.inverseMass + b.inverseMass),
                           a.velocity - b.velocity,
                           {},
                           a.spin + b.spin,
                           distance2 < sum * sum};
                const double half = 0.5 * g.overlap;
                g.spinLever = (a.radius - half) * a.spin + (b.radius - half) * b.spin;
                const Bodies radii{std::min(a.radius, b.radius), std::max(a.radius, b.radius)};
                const Vector<double> onFirst =
                    contact(species.mixture(a.species, b.species), radii, g, memory, step);
                add(i, onFirst, cross(g.normal, onFirst), a.radius - 0.5 * max(g.overlap, 0.0));
                add(j, -onFirst, cross(g.normal, onFirst), b.radius - 0.5 * max(g.overlap, 0.0));
            }
            for (std::size_t w = 0; w < scene.wallHandler.getSize(); ++w) {
                const auto& plane = scene.planes[w];
                const Vector<double> normal = toVector(plane.normal);
                const double distance = plane.normal.dot(plane.point) - dot(normal, a.position);
                Memory& memory = memories[{static_cast<int>(w), i, i}];
                Geometry g{normal, a.radius - distance, 0, a.radius, 1 / a.inverseMass, a.velocity, {},
                           a.spin, distance < a.radius};
                g.spinLever = (a.radius - 0.5 * g.overlap) * a.spin;
                if (!g.touching && !memory.bridged) {
                    memory = {};
                    continue;
                }
                const Vector<double> onGrain =
                    contact(species.mixture(a.species, plane.species), {a.radius}, g, memory, step);
                add(i, onGrain, cross(g.normal, onGrain), a.radius - 0.5 * max(g.overlap, 0.0));
            }
        }
    }

private:
    struct Geometry {
        Vector<double> normal;
        double overlap, inverseDistance, effectiveRadius, effectiveMass;
        Vector<double> velocity, spinLever, spinSum;
        bool touching;
    };
    struct Memory {
        bool touching = false, bridged = false, closing = false;
        double normalForce = 0;             // N, of the last step
        Vector<double> leverless{0, 0, 0};  // N, n x F of the last step
        typename Friction::template History<double> history{};
    };

    void add(std::uint32_t grain, const Vector<double>& f, const Vector<double>& leverless, double lever) {
        force[grain] += f;
        torque[grain] += lever * leverless;
        scale[grain] += norm(f);
    }

    /// The force (N) on body 1.
    static Vector<double> contact(const typename S::Mixed& laws, const Bodies& radii, const Geometry& g,
                                  Memory& memory, double step) {
        const auto normalLaw = static_cast<const Normal&>(laws).prepare();
        const bool begins = g.touching && !memory.touching;
        double adhesive = 0;
        bool bridged = false;
        if constexpr (Adhesion::acts) {
            const auto bridge = static_cast<const Adhesion&>(laws).prepare(radii);
            const double separation = separationFor<Adhesion>(g.overlap);
            bridged = separation < bridge.range();  // the caller has seen that they touch or are joined
            adhesive = bridged ? bridge.force(separation) : 0;
        }

        const double overlap = max(g.overlap, 0.0);
        const Contact<double> c{overlap, g.effectiveRadius, g.effectiveMass};
        NormalForce<double> law = Normal::force(normalLaw, c);
        if (!g.touching) law.damping = 0;
        const double halfStep = 0.5 * step / g.effectiveMass, predicted = dot(g.velocity, g.normal);
        const auto approachWith = [&](const NormalForce<double>& f) {
            return (predicted - halfStep * (f.elastic - adhesive - memory.normalForce)) /
                   (1 + halfStep * f.damping);
        };
        double approach = approachWith(law);
        const double way = approach * step;
        const double bend =
            -step * step / g.effectiveMass * (law.elastic + law.damping * approach - adhesive);
        const bool closing = g.touching && approach < 0 && g.overlap + way + 0.5 * bend <= 0;
        SampleTiming<double> timing{0.5, 0.5};
        if (begins || closing) {
            if (begins) timing.before = predicted > 0 ? min(g.overlap / (predicted * step), 1.0) : 1;
            if (closing) timing.after = timeToEnd(g.overlap, way, bend);
            if (closing && memory.closing) timing.before = 0;
            law.damping = law.damping * timing.factor(Normal::dampingExponent, begins, closing);
            law.elastic = law.elastic * timing.factor(Normal::elasticExponent, begins, closing);
            approach = approachWith(law);
        }
        const double repulsion = g.touching ? law.elastic + law.damping * approach : 0;

        Vector<double> tangential{0, 0, 0};
        if constexpr (Friction::acts) {
            const auto frictionLaw =
                static_cast<const Friction&>(laws).prepare(static_cast<const Normal&>(laws));
            const Vector<double> sideways = g.velocity - predicted * g.normal;
            memory.history.turn(
                {g.normal, (-step * g.inverseDistance) * sideways, 0.5 * step * dot(g.spinSum, g.normal)});
            // 1/m + r^2/I of a solid sphere is 7/2 of 1/m; the force of the last step in today's tangential
            // plane.
            const double response = 3.5 * 0.5 * step / g.effectiveMass;
            const Vector<double> lastTangential = cross(memory.leverless, g.normal);
            const Slip<double> slip{sideways + cross(g.spinLever, g.normal) - response * lastTangential,
                                    step * (begins ? timing.before : 0.5), 0.5 * step, response};
            tangential = Friction::force(frictionLaw, c, max(repulsion, 0.0), slip, memory.history);
            if (!g.touching) {
                tangential = {0, 0, 0};
                memory.history = {};
            }
        }
        memory.touching = g.touching;
        memory.bridged = bridged;
        memory.closing = closing;
        memory.normalForce = repulsion - adhesive;
        memory.leverless = cross(g.normal, tangential);
        return tangential - memory.normalForce * g.normal;
    }

    std::map<ContactKey, Memory> memories;
};

}  // namespace pendular::support
