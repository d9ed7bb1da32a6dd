#include "Drivers/Shared/BedMaterial.h"

#include <fmt/format.h>

#include <string_view>

#include "Kernel/Particles/SphericalParticle.h"
#include "Kernel/Species/Friction/Mindlin.h"
#include "Kernel/Species/Normal/HertzianViscoelastic.h"
#include "Kernel/Species/Normal/LinearViscoelastic.h"

namespace pendular::scenes {

void BedMaterial::set(AnySpecies& s) const {
    const auto setIfThere = [&](std::string_view field, double value) {
        if (s.has(field)) s.set(field, value);
    };
    s.setDensity(density);
    if (auto* const hertzian = s.find<HertzianViscoelastic>())
        hertzian->setEffectiveElasticModulusAndRestitutionCoefficient(
            computeEffectiveElasticModulus(elasticModulus, poissonRatio), restitution);
    if (auto* const linear = s.find<LinearViscoelastic>()) {
        linear->setCollisionTimeAndRestitutionCoefficient(linearCollisionTime, restitution,
                                                          sphereMass(1e-3, density));
        setIfThere("slidingStiffness", 2.0 / 7 * linear->getStiffness());
        setIfThere("slidingDissipation", 2.0 / 7 * linear->getDissipation());
    }
    setIfThere("effectiveShearModulus", computeEffectiveShearModulus(elasticModulus, poissonRatio));
    setIfThere("slidingFrictionCoefficient", friction);
    setIfThere("springFactor", 1);  // as the peers have it
    for (const std::string_view motion : {"rolling", "torsion"}) {
        setIfThere(fmt::format("{}Stiffness", motion), rollingStiffness);
        setIfThere(fmt::format("{}Dissipation", motion), rollingDissipation);
        setIfThere(fmt::format("{}FrictionCoefficient", motion), rollingFriction);
    }
    setIfThere("liquidBridgeVolume", liquidVolume);
    setIfThere("contactAngle", contactAngle);
    setIfThere("surfaceTension", surfaceTension);
    setIfThere("liquidBridgeVolumeMax", liquidVolume);
    setIfThere("viscosity", viscosity);
    setIfThere("roughness", roughness);
    setIfThere("liquidLayerThickness", layer);
    setIfThere("liquidDensity", liquidDensity);
    setIfThere("halfFillingAngle", halfFillingAngle);
    setIfThere("workOfAdhesion", workOfAdhesion);
}

}  // namespace pendular::scenes
