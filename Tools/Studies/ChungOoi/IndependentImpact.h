#pragma once

#include <algorithm>
#include <cmath>

namespace pendular::papers {

/// A collision in the plane as an ordinary differential equation, without grains, vectors or time steps of
/// the kernel.
struct PlanarImpact {
    double radius, inverseMass;    // of the contact: m, 1/kg
    double modulus, shearModulus;  // E*, G*, Pa
    double damping;  // beta_n of Hertz's law: the dashpot is beta sqrt(m* k), k = 4/3 E* sqrt(R* d)
    double friction, springFactor;
    double sphereRadius;  // m: the contact point is at r - overlap/2
    double approach;      // m/s
    double sideways = 0;  // m/s, of the centre against the other body
    double rim = 0;       // m/s, radius x spin, of both bodies together

    struct End {
        double parting;        // m/s
        double sideways, rim;  // m/s
    };

    /// The equations of Hertz's and Mindlin's laws (Thornton et al. (2023), equations 4.1 to 4.8), a spring
    /// cut at Coulomb's limit with its dashpot beside it, by steps so short that their first order does not
    /// matter. Solid spheres: I = 2/5 m r^2.
    [[nodiscard]] End solve(int steps = 100000) const {
        const double contactTime =
            2.87 * std::pow(std::pow(1 / (inverseMass * modulus), 2) / (radius * approach), 0.2);
        const double h = 1.5 * contactTime / steps, mass = 1 / inverseMass;
        double overlap = 0, v = approach, along = sideways, turning = rim, spring = 0;
        do {
            overlap += h * v;
            const double a = std::sqrt(radius * std::max(overlap, 0.0));
            const double normalStiffness = 4.0 / 3.0 * modulus * a;
            const double normal = normalStiffness * overlap + damping * std::sqrt(mass * normalStiffness) * v;
            v -= h * inverseMass * normal;

            const double stiffness = 8 * shearModulus * a;
            const double dashpot = std::sqrt(2.0 / 3.0) * damping * std::sqrt(mass * stiffness);
            const double limit = friction * std::max(normal, 0.0);
            const double lever = 1 - 0.5 * overlap / sphereRadius, slip = along - lever * turning;
            spring += h * slip;
            const double longest = stiffness > 0 ? limit / (springFactor * stiffness) : 0;
            spring = std::clamp(spring, -longest, longest);
            const double force =
                std::clamp(springFactor * stiffness * spring + dashpot * slip, -limit, limit);
            along -= h * inverseMass * force;
            turning += h * 2.5 * inverseMass * lever * force;
        } while (overlap > 0);
        return {-v, along, turning};
    }
};

}  // namespace pendular::papers
