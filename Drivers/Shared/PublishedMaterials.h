#pragma once

#include <array>
#include <cmath>

#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Species/SpeciesHandler.h"

namespace pendular {

/// The materials of the benchmark of Dosta et al. (2024), Comput. Phys. Commun. 296, 109066.
enum PublishedMaterial : std::size_t { M1, M2, Steel };

/// Restitution and friction of each two of them, by material and material.
struct PublishedPairs {
    using Table = std::array<std::array<double, 3>, 3>;
    static constexpr Table restitution{{{0.5, 0.45, 0.4}, {0.45, 0.4, 0.4}, {0.4, 0.4, 0.6}}};
    static constexpr Table friction{{{0.3, 0.2, 0.2}, {0.2, 0.4, 0.2}, {0.2, 0.2, 0.5}}};
};

/// Adds the three materials to a scene, as its species 0, 1 and 2, and the values of each pair. S has Hertz's
/// law with restitution and Mindlin's friction.
/// @param softening divides all Young's moduli; 1 is the published stiffness
template <class S>
void addPublishedMaterials(SpeciesHandler<S>& species, double softening = 1) {
    struct Properties {
        double density;       // kg/m^3
        double youngModulus;  // Pa
    };
    constexpr std::array<Properties, 3> properties{{{2500, 1e9}, {2000, 0.5e9}, {7200, 210e9}}};
    constexpr double poissonRatio = 0.2;
    checkValue("the published materials", "softening", softening, "", positive);

    for (const Properties& given : properties) {
        S material;
        material.setDensity(given.density);
        material.setElasticModulusAndPoissonRatio(given.youngModulus / softening, poissonRatio);
        material.setEffectiveShearModulus(
            computeEffectiveShearModulus(given.youngModulus / softening, poissonRatio));
        material.setSpringFactor(1);  // as the compared codes LIGGGHTS and YADE have it
        species.copyAndAddObject(material);
    }
    const auto setPair = [](auto& laws, double restitution, double friction) {
        laws.setRestitutionCoefficient(restitution);
        laws.setSlidingDissipation(std::sqrt(2.0 / 3.0) * laws.getDissipation());  // Mindlin::deriveUnset
        laws.setSlidingFrictionCoefficient(friction);
    };
    for (const std::size_t a : {M1, M2, Steel})
        for (const std::size_t b : {M1, M2, Steel}) {
            const double restitution = PublishedPairs::restitution[a][b];
            const double friction = PublishedPairs::friction[a][b];
            if (a == b) setPair(*species.getObject(a), restitution, friction);
            if (a < b)
                setPair(*species.getMixedObject(species.getObject(a), species.getObject(b)), restitution,
                        friction);
        }
}

}  // namespace pendular
