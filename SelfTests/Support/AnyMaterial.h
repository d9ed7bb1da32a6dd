#pragma once

#include "Kernel/Features/Laws.h"

namespace pendular::support {

/// How large the numbers of a material are.
struct MaterialScale {
    double density = 2500;      // kg/m^3
    double youngModulus = 5e8;  // Pa
    double poissonRatio = 0.25;
    double stiffness = 5e4;  // N/m, of linear springs
    double mass = 1e-5;      // kg, of a grain
};

template <class S>
void setNormal(S& species, const MaterialScale& scale) {
    if constexpr (requires { species.setElasticModulusAndPoissonRatio(1.0, 0.2); })
        species.setElasticModulusAndPoissonRatio(scale.youngModulus, scale.poissonRatio);
    if constexpr (requires { species.setRestitutionCoefficient(1.0); })
        species.setRestitutionCoefficient(0.7);
    if constexpr (requires { species.setDissipativeTime(1.0); }) species.setDissipativeTime(2e-6);
    if constexpr (requires { species.setPlasticity(0.5); }) {
        species.setPlasticity(0.5);
        species.setCohesionRatio(0.1);
    }
    if constexpr (requires { species.setStiffnessAndRestitutionCoefficient(1.0, 1.0, 1.0); })
        species.setStiffnessAndRestitutionCoefficient(scale.stiffness, 0.7, scale.mass);
    if constexpr (requires { species.setLoadingModulus(1.0); }) {
        const double modulus = computeEffectiveElasticModulus(scale.youngModulus, scale.poissonRatio);
        species.setPlasticParameters(0.6 * modulus, modulus, 0.1 * modulus, 0.01);
        species.setDissipation(0.05 * std::sqrt(scale.stiffness * scale.mass));
    } else if constexpr (requires { species.setPlasticParameters(1.0, 1.0, 1.0, 1.0); }) {
        species.setPlasticParameters(0.4 * scale.stiffness, scale.stiffness, 0.1 * scale.stiffness, 0.01);
        species.setDissipation(0.05 * std::sqrt(scale.stiffness * scale.mass));
    }
}

template <class S>
void setFriction(S& species, const MaterialScale& scale) {
    if constexpr (requires { species.setEffectiveShearModulus(1.0); }) {
        species.setEffectiveShearModulus(
            computeEffectiveShearModulus(scale.youngModulus, scale.poissonRatio));
        species.setSlidingDissipation(0.1);
    }
    if constexpr (requires { species.setSlidingStiffness(1.0); })
        species.setSlidingStiffness(2.0 / 7 * scale.stiffness);
    if constexpr (requires { species.setSlidingFrictionCoefficient(1.0); })
        species.setSlidingFrictionCoefficient(0.3);
    if constexpr (requires { species.setStaticFrictionRatio(1.0); }) species.setStaticFrictionRatio(1.2);
    if constexpr (requires { species.setRollingStiffness(1.0); }) {
        species.setRollingStiffness(0.2 * scale.stiffness);
        species.setRollingFrictionCoefficient(0.1);
        species.setTorsionStiffness(0.1 * scale.stiffness);
        species.setTorsionFrictionCoefficient(0.05);
    }
}

template <class S>
void setAdhesion(S& species, const MaterialScale& scale) {
    if constexpr (requires { species.setLiquidBridgeVolume(1.0); }) species.setLiquidBridgeVolume(1e-12);
    if constexpr (requires { species.setLiquidBridgeVolumeMax(1.0); })
        species.setLiquidBridgeVolumeMax(1e-12);
    if constexpr (requires { species.setContactAngle(1.0); }) {
        species.setContactAngle(0.2);
        species.setSurfaceTension(0.07);
    }
    if constexpr (requires { species.setRoughness(1.0); }) {
        species.setRoughness(1e-6);
        species.setViscosity(1e-3);
    }
    if constexpr (requires { species.setFilmThickness(1.0); }) species.setFilmThickness(1e-5);
    if constexpr (requires { species.setLiquidLayerThickness(1.0); }) {
        species.setLiquidLayerThickness(1e-4);
        species.setHalfFillingAngle(0.8);
        species.setLiquidDensity(1000);
    }
    if constexpr (requires { species.setAdhesionForceMax(1.0); }) {
        species.setAdhesionForceMax(1e-3);
        species.setAdhesionStiffness(100);
    }
    if constexpr (requires { species.setBondForceMax(1.0); }) species.setBondForceMax(1e-3);
    if constexpr (requires { species.setAdhesionCoefficient(1.0); }) {
        species.setAdhesionCoefficient(1);
        species.setViscosityCoefficient(1e13);
        species.setSlidingViscosityCoefficient(1e9);
    }
    if constexpr (requires { species.setWorkOfAdhesion(1.0); }) species.setWorkOfAdhesion(0.5);
    if constexpr (requires { species.setSurfaceDistance(1.0); }) species.setSurfaceDistance(1e-6);
    if constexpr (requires { species.setAdhesionModulus(1.0); })
        species.setAdhesionModulus(computeEffectiveElasticModulus(scale.youngModulus, scale.poissonRatio));
}

/// Values for any composition of laws.
template <class S>
S anyMaterial(const MaterialScale& scale = {}) {
    S species;
    species.setDensity(scale.density);
    setNormal(species, scale);
    setFriction(species, scale);
    setAdhesion(species, scale);
    return species;
}

}  // namespace pendular::support
