#pragma once

#include <numbers>

#include "Kernel/Particles/SphericalParticle.h"
#include "Kernel/Species/Friction/Mindlin.h"
#include "Kernel/Species/Normal/HertzianViscoelastic.h"
#include "Kernel/Species/Normal/LinearViscoelastic.h"

namespace pendular::scenes {

/// The material of the bed of Dosta et al. (2024), M1, in the parameters of whatever laws a species has.
struct BedMaterial {
    double density = 2500;        // kg/m^3
    double elasticModulus = 1e9;  // Pa
    double poissonRatio = 0.2;
    double restitution = 0.5;
    double friction = 0.3;
    double linearCollisionTime =
        5e-5;                     // s, of grains of 1 mm radius; the Hertzian one at 0.1 m/s is 5.2e-5 s
    double liquidVolume = 2e-11;  // m^3 a bridge, 20 nl
    double contactAngle = std::numbers::pi / 9;
    double surfaceTension = 0.072;  // N/m

    template <class S>
    [[nodiscard]] S species() const {
        S s;
        s.setDensity(density);
        if constexpr (std::is_same_v<typename S::Normal, HertzianViscoelastic>)
            s.setEffectiveElasticModulusAndRestitutionCoefficient(
                computeEffectiveElasticModulus(elasticModulus, poissonRatio), restitution);
        else
            s.setCollisionTimeAndRestitutionCoefficient(linearCollisionTime, restitution,
                                                        sphereMass(1e-3, density));
        if constexpr (std::is_same_v<typename S::Friction, Mindlin>) {
            s.setEffectiveShearModulus(computeEffectiveShearModulus(elasticModulus, poissonRatio));
            s.setSlidingFrictionCoefficient(friction);
            s.setSpringFactor(1);  // as the peers have it
        }
        if constexpr (requires { s.setLiquidBridgeVolume(1.0); }) {
            s.setLiquidBridgeVolume(liquidVolume);
            s.setContactAngle(contactAngle);
            s.setSurfaceTension(surfaceTension);
        }
        return s;
    }
};

}  // namespace pendular::scenes
