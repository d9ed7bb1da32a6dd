#pragma once

#include <cmath>
#include <string_view>

#include "Drivers/Shared/BedMaterial.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Species/TimeStepAdvice.h"

// The laws that the study of bulk figures compares: one material, in the parameters of each.

namespace pendular::bulk {

/// Grains collide at about this speed (m/s) where they flow; linear laws have the contact time of Hertz's at
/// it.
inline constexpr double typicalSpeed = 0.1;
inline constexpr double largestRadius = 1e-3;  // m

/// The settings of a run besides its laws.
struct LawVariant {
    std::string_view law;
    double elasticModulus;  // Pa; of a linear law: of the Hertzian one with its contact time
    double stepTimesOmega;  // of the stiffest pair, at an overlap of 5 %
};

/// s, elastic, of two of the largest grains at the typical speed.
inline double contactTime(double elasticModulus) {
    const scenes::BedMaterial material;
    return hertzContactTime(computeEffectiveElasticModulus(elasticModulus, material.poissonRatio),
                            0.5 * largestRadius, 0.5 * sphereMass(largestRadius, material.density),
                            typicalSpeed);
}

/// The bed's material. A linear spring of friction is to the normal one as Mindlin's to Hertz's,
/// 2 (1 - nu) / (2 - nu), with the same damping ratio.
template <class S>
S speciesOf(double elasticModulus) {
    scenes::BedMaterial material;
    material.elasticModulus = elasticModulus;
    material.linearCollisionTime = contactTime(elasticModulus);
    S species = material.template species<S>();
    if constexpr (std::is_same_v<typename S::Friction, SlidingFriction>) {
        const double ratio = 2 * (1 - material.poissonRatio) / (2 - material.poissonRatio);
        species.setSlidingStiffness(ratio * species.getStiffness());
        species.setSlidingDissipation(std::sqrt(ratio) * species.getDissipation());
        species.setSlidingFrictionCoefficient(material.friction);
    }
    return species;
}

/// Calls function.template operator()<S>(variant); the first is the reference.
template <class Function>
void forEachVariant(double elasticModulus, Function&& function) {
    const auto call = [&]<class S>(std::string_view law, double softening, double stepTimesOmega) {
        function.template operator()<S>(LawVariant{law, elasticModulus / softening, stepTimesOmega});
    };
    using HertzMindlin = HertzianViscoelasticMindlinSpecies;
    using Linear = LinearViscoelasticSlidingFrictionSpecies;
    call.template operator()<HertzMindlin>("Hertz-Mindlin", 1, 0.3);
    for (const double step : {0.6, 0.9}) call.template operator()<HertzMindlin>("Hertz-Mindlin", 1, step);
    for (const double step : {0.3, 0.9}) call.template operator()<HertzMindlin>("Hertz-Mindlin", 10, step);
    call.template operator()<HertzMindlin>("Hertz-Mindlin", 100, 0.3);
    using Incremental = Species<HertzianViscoelastic, MindlinIncremental, NoAdhesion>;
    for (const double step : {0.3, 0.9})
        call.template operator()<Incremental>("Hertz-Mindlin incremental", 1, step);
    for (const double step : {0.3, 0.9}) call.template operator()<Linear>("linear", 1, step);
    call.template operator()<HertzianViscoelasticSpecies>("Hertz without friction", 1, 0.3);
    call.template operator()<LinearViscoelasticSpecies>("linear without friction", 1, 0.3);
}

}  // namespace pendular::bulk
