#pragma once

#include <cmath>

#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Features/Laws.h"

// The material of the scenes in which critical steps are measured: any composition of laws.

namespace pendular {

/// The parameters that are varied.
struct CriticalCase {
    double dampingRatio = 0;       // zeta, of each dashpot over the critical one of its own spring with m*
    double frictionStiffness = 1;  // a factor on the springs of sliding, rolling and torsion
};

/// Grains of 1 mm and 2500 kg/m^3; E = 100 MPa, nu = 0.25; linear springs of 1e4 N/m, against sliding 2/7 and
/// against rolling and torsion 1/5 of it. Friction sticks.
namespace criticalMaterial {

inline constexpr double radius = 1e-3, density = 2500;            // m, kg/m^3
inline constexpr double youngModulus = 1e8, poissonRatio = 0.25;  // Pa, 1
inline constexpr double stiffness = 1e4, sticking = 100;          // N/m, coefficient of friction

/// The overlap (m) of all contacts of a scene whose smallest grains have the radius (m).
inline double overlap(double smallest) { return 0.98 * largestSoundOverlap * smallest; }

template <class S>
void setNormal(S& species) {
    if constexpr (requires { species.setElasticModulusAndPoissonRatio(1.0, 0.2); })
        species.setElasticModulusAndPoissonRatio(youngModulus, poissonRatio);
    if constexpr (requires { species.setPlasticity(0.5); }) species.setPlasticity(0.5);
    if constexpr (requires { species.setLoadingModulus(1.0); }) {
        const double modulus = computeEffectiveElasticModulus(youngModulus, poissonRatio);
        species.setPlasticParameters(0.5 * modulus, modulus, 0, 0.01);
    } else if constexpr (requires { species.setPlasticParameters(1.0, 1.0, 1.0, 1.0); })
        species.setPlasticParameters(0.5 * stiffness, stiffness, 0, 0.01);
    if constexpr (requires { species.setStiffness(1.0); }) species.setStiffness(stiffness);
}

template <class S>
void setFriction(S& species, double factor) {
    if constexpr (requires { species.setEffectiveShearModulus(1.0); })
        species.setEffectiveShearModulus(factor * computeEffectiveShearModulus(youngModulus, poissonRatio));
    if constexpr (requires { species.setSlidingStiffness(1.0); })
        species.setSlidingStiffness(2.0 / 7 * factor * stiffness);
    if constexpr (requires { species.setSlidingFrictionCoefficient(1.0); })
        species.setSlidingFrictionCoefficient(sticking);
    if constexpr (requires { species.setRollingStiffness(1.0); }) {
        // The same torques by laws of other levers, n R*.
        const auto over = [](RotationLever lever) { return std::pow(static_cast<double>(lever), -2); };
        species.setRollingStiffness(0.2 * factor * stiffness * over(S::leverOfRolling));
        species.setRollingFrictionCoefficient(sticking);
        species.setTorsionStiffness(0.2 * factor * stiffness * over(S::leverOfTorsion));
        species.setTorsionFrictionCoefficient(sticking);
    }
}

/// Every dashpot to the damping ratio at the overlap: its constant is found from what 1 gives.
template <class S>
void setDamping(S& species, double ratio, const Bodies& bodies, double mass) {
    if constexpr (requires { species.setDissipation(1.0); }) species.setDissipation(1);
    if constexpr (requires { species.setDissipativeTime(1.0); }) species.setDissipativeTime(1);
    if constexpr (requires { species.setSlidingDissipation(1.0); }) species.setSlidingDissipation(1);
    if constexpr (requires { species.setRollingDissipation(1.0); }) {
        species.setRollingDissipation(1);
        species.setTorsionDissipation(1);
    }
    const ContactStiffness unit =
        contactStiffness(static_cast<const typename S::Mixed&>(species), bodies, mass);
    const auto constant = [&](const SpringAndDashpot& s) {
        return 2 * ratio * std::sqrt(s.spring * mass) / s.dashpot;
    };
    if constexpr (requires { species.setDissipation(1.0); }) species.setDissipation(constant(unit.normal));
    if constexpr (requires { species.setDissipativeTime(1.0); })
        species.setDissipativeTime(constant(unit.normal));
    if constexpr (requires { species.setSlidingDissipation(1.0); })
        species.setSlidingDissipation(constant(unit.sliding));
    if constexpr (requires { species.setRollingDissipation(1.0); }) {
        species.setRollingDissipation(constant(unit.rolling));
        species.setTorsionDissipation(constant(unit.torsion));
    }
}

/// The strength of the attraction, so that it holds the bodies at the overlap without another load.
template <class S>
void setAttraction(S& species, const Bodies& bodies, double mass) {
    if constexpr (S::Adhesion::acts) {
        if constexpr (requires { species.setAdhesionStiffness(1.0); })
            species.setAdhesionStiffness(stiffness);
        if constexpr (requires { species.setSurfaceDistance(1.0); })
            species.setSurfaceDistance(1e-3 * std::min(bodies.radius1, bodies.radius2));
        if constexpr (requires { species.setLiquidBridgeVolume(1.0); }) {
            species.setLiquidBridgeVolume(1e-4 * std::pow(bodies.effectiveRadius(), 3));
            species.setContactAngle(0.2);
        }
        const double depth = overlap(std::min(bodies.radius1, bodies.radius2));
        typename NormalHistoryOf<typename S::Normal>::template type<double> history{};
        const double repulsion =
            normalForce<typename S::Normal>(static_cast<const typename S::Normal&>(species).prepare(),
                                            Contact<double>{depth, bodies.effectiveRadius(), mass}, history)
                .elastic;
        double low = 1e-12, high = 1e12;  // N, N/m or J/m^2
        while (high > 1.0000001 * low) {
            const double middle = std::sqrt(low * high);
            if constexpr (requires { species.setAdhesionForceMax(1.0); }) species.setAdhesionForceMax(middle);
            if constexpr (requires { species.setSurfaceTension(1.0); }) species.setSurfaceTension(middle);
            if constexpr (requires { species.setWorkOfAdhesion(1.0); }) species.setWorkOfAdhesion(middle);
            species.deriveUnset();
            const auto held = static_cast<const typename S::Adhesion&>(species).prepare(bodies);
            const double pull = held.force(separationFor<typename S::Adhesion>(depth));
            (pull < repulsion ? low : high) = middle;
        }
    }
}

/// @param mass kg, of the effective mass of the bodies, which touch
template <class S>
S make(const CriticalCase& given, const Bodies& bodies, double mass) {
    S species;
    species.setDensity(density);
    setNormal(species);
    setFriction(species, given.frictionStiffness);
    setAttraction(species, bodies, mass);
    species.deriveUnset();
    setDamping(species, given.dampingRatio, bodies, mass);
    return species;
}

}  // namespace criticalMaterial

}  // namespace pendular
