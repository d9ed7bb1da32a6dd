#include "Drivers/Shared/BedMaterial.h"

#include <fmt/format.h>

#include <string_view>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Laws/Friction/CombinedLaws.h"
#include "Kernel/Laws/Friction/Friction.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"

namespace pendular::scenes {

/// Of rolling or torsion, in R*: what is n^2 times as stiff and has n times the limit with the same numbers.
static double leverOf(AnySpecies& s, std::string_view motion) {
    const bool isWideTorsion = s.find<MindlinRollingTorsion>() ||
                               s.find<MindlinIncrementalRollingTorsion>() ||
                               s.find<MindlinPartialSlipRollingTorsion>();
    return s.find<Friction>() || (motion == "torsion" && isWideTorsion) ? 2 : 1;
}

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
        const double n = leverOf(s, motion);
        setIfThere(fmt::format("{}Stiffness", motion), rollingStiffness / (n * n));
        setIfThere(fmt::format("{}Dissipation", motion), rollingDissipation / (n * n));
        setIfThere(fmt::format("{}FrictionCoefficient", motion), rollingFriction / n);
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
