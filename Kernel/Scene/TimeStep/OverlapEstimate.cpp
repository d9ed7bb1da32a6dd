#include "Kernel/Scene/TimeStep/OverlapEstimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Foundation/Math/Halving.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {
namespace {

/// kg, of the heaviest rigid body; 0 without any
double heaviestBody(const ParticleStore& grains) {
    double heaviest = 0;
    forEachRigidBody(grains, [&](double mass, const Vector<double>&, const Vector<double>&) {
        heaviest = std::max(heaviest, mass);
    });
    return heaviest;
}

/// The force and energy of a normal law at an overlap, by the integrals of its slope.
class NormalCurve {
public:
    NormalCurve(const PairLaws& laws, const Bodies& of) : pair(laws), bodies(of) {}

    [[nodiscard]] double stiffness(double overlap) const {  // N/m
        return pair.laws.normalStiffness(pair.a, pair.b, bodies, overlap);
    }
    [[nodiscard]] double force(double overlap) const {  // N
        return integral(overlap, [](double) { return 1.0; });
    }
    [[nodiscard]] double energy(double overlap) const {  // J
        return integral(overlap, [&](double x) { return overlap - x; });
    }
    /// m, where a function of the overlap that grows reaches a value; at most the smaller radius.
    template <class Function>
    [[nodiscard]] double overlapAt(double value, Function&& function) const {
        const double most = std::min(bodies.radius1, bodies.radius2);
        return turningPoint(
                   0, most, [&](double overlap) { return function(overlap) < value; }, 60)
            .fails;
    }

private:
    /// The integral is taken by the middles of intervals that grow from the touch on, as s^2: Hertz's slope
    /// is smooth in s.
    template <class Weight>
    [[nodiscard]] double integral(double overlap, Weight&& weight) const {
        constexpr int intervals = 64;
        double sum = 0;
        for (int k = 0; k < intervals; ++k) {
            const double s = (k + 0.5) / intervals, x = s * s * overlap;
            sum += 2 * s * overlap / intervals * stiffness(x) * weight(x);
        }
        return sum;
    }

    PairLaws pair;
    Bodies bodies;
};

/// The stiffness of a contact at an overlap, for stabilityLimit().
struct StiffnessThere {
    ContactStiffness contact;
};
ContactStiffness contactStiffness(const StiffnessThere& there, const Bodies& /*bodies*/, double /*mass*/) {
    return there.contact;
}
ContactStiffness stiffnessAt(const PairLaws& pair, const Bodies& bodies, double mass, double overlap) {
    const PressedPair pressed{bodies, mass, overlap};
    ContactStiffness found;
    pair.laws.stiffnesses(pair.a, pair.b, {&pressed, 1}, {&found, 1});
    return found;
}

struct BedLoads {
    double pressure, speed;  // Pa, m/s
};
BedLoads loadsOf(const Scene& scene, const ParticleStore& grains, const GrainSizes& sizes, double pressure) {
    const Vector<double> gravity = toVector(scene.getGravity()), side = sizes.highest - sizes.lowest;
    const double g = norm(gravity);
    double mass = 0, fastest = 0;
    forEachMovingBodyInOrder(grains,
                             [&](double own, const Vector<double>&, const Vector<double>&) { mass += own; });
    for (const std::uint32_t at : grains.place)
        fastest = std::max(fastest, norm(grains.translation[at].velocity));
    if (!(g > 0)) return {pressure, fastest};
    const Vector<double> n = (1 / g) * gravity;
    const double shadow =
        side.y * side.z * std::abs(n.x) + side.x * side.z * std::abs(n.y) + side.x * side.y * std::abs(n.z);
    const double height = side.x * std::abs(n.x) + side.y * std::abs(n.y) + side.z * std::abs(n.z);
    return {pressure + mass * g / shadow, fastest + std::sqrt(2 * g * height)};
}

}  // namespace

OverlapEstimate estimateOverlaps(Scene& scene, double pressure) {
    checkValue("Simulation", "pressure for the estimate of overlaps", pressure, "Pa", notNegative);
    OverlapEstimate found{.limit = scene.stabilityLimit()};
    const ParticleStore& grains = scene.particleHandler.store();
    if (grains.count() == 0)
        throw InputError("Simulation: overlaps are estimated for grains that are there; add them first.");
    const GrainSizes sizes = scene.grainSizes(grains);
    const BedLoads loads = loadsOf(scene, grains, sizes, pressure);
    found.pressure = loads.pressure, found.speed = loads.speed;
    const double heaviest = heaviestBody(grains);
    const Integrator scheme = schemeOfScene(scene.laws(), sizes, scene.wallHandler, scene.getIntegrator());
    const std::size_t contacts = mostContacts(sizes.count, scene.wallHandler);
    double supposed = infinity, there = infinity;  // s, of the stiffest pair
    forEachExtremePair(
        scene.laws(), sizes, scene.wallHandler, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
            const NormalCurve curve(laws, bodies);
            const double smaller = std::min(bodies.radius1, bodies.radius2),
                         diameter = (bodies.radius2 < infinity ? 4 : 2) * bodies.effectiveRadius();
            const double load = std::numbers::pi * diameter * diameter * loads.pressure / (6 * 0.6);
            const double byWeight = curve.overlapAt(load, [&](double x) { return curve.force(x); }),
                         // The mass is that of all of a rigid body behind each of its grains, or of two.
                behind = std::max(mass, bodies.radius2 < infinity ? 0.5 * heaviest : heaviest),
                         bySpeed = curve.overlapAt(0.5 * behind * loads.speed * loads.speed,
                                                   [&](double x) { return curve.energy(x); });
            found.byWeight = std::max(found.byWeight, byWeight / smaller);
            found.bySpeed = std::max(found.bySpeed, bySpeed / smaller);
            const auto limitAt = [&](double overlap) {
                return stabilityLimit(StiffnessThere{stiffnessAt(laws, bodies, mass, overlap)}, bodies, mass,
                                      scheme, contacts);
            };
            supposed = std::min(supposed, limitAt(largestSoundOverlap * smaller));
            there = std::min(there, limitAt(std::max({byWeight, bySpeed, 1e-6 * smaller})));
        });
    found.step = there / supposed * found.limit;
    return found;
}

std::string OverlapEstimate::text() const {
    return fmt::format(
        "Expected overlaps: {:.2g} % of the radius by weight and pressure, {:.2g} % by speed. The stability "
        "limit of {:.3g} s supposes 5 %; at these it would be about {:.3g} s.",
        100 * byWeight, 100 * bySpeed, limit, step);
}

}  // namespace pendular
