#pragma once

#include <string_view>
#include <vector>

#include "Kernel/Species/Laws.h"

namespace pendular {

/// A value that a setter takes.
struct SetterValue {
    std::string_view name, unit;
    Range range;
};

/// A setter of a law that has no field of its own: it computes fields from other values.
struct DerivedSetter {
    std::string_view name;
    std::vector<SetterValue> values;
    std::string_view gives;
};

/// Those of a law, for its description; each checks its values as is said here. The setter of a field is
/// called as the field is, and has no entry.
template <class Law>
std::vector<DerivedSetter> derivedSetters() {
    std::vector<DerivedSetter> found;
    const SetterValue restitution{"restitution", "", positiveUpTo(1)}, mass{"mass", "kg", positive};
    if constexpr (std::derived_from<Law, HertzianContact<Law>>)
        found.push_back({"setElasticModulusAndPoissonRatio",
                         {{"elasticModulus", "Pa", positive}, {"poissonRatio", "", {-1, 0.5, false, true}}},
                         "effectiveElasticModulus of two bodies of this material"});
    if constexpr (std::same_as<Law, HertzianViscoelastic>) {
        const SetterValue fromZero{"restitution", "", fromZeroTo(1)};
        found.push_back({"setRestitutionCoefficient", {fromZero}, "dissipation"});
        found.push_back({"setEffectiveElasticModulusAndRestitutionCoefficient",
                         {{"modulus", "Pa", positive}, fromZero},
                         "effectiveElasticModulus and dissipation"});
        found.push_back({"setTsujiDampingFactor", {{"alpha", "", notNegative}}, "dissipation"});
    }
    if constexpr (std::same_as<Law, LinearViscoelastic>) {
        found.push_back({"setCollisionTimeAndRestitutionCoefficient",
                         {{"collisionTime", "s", positive}, restitution, mass},
                         "stiffness and dissipation, for two grains of this mass each"});
        found.push_back({"setStiffnessAndRestitutionCoefficient",
                         {{"stiffness", "N/m", positive}, restitution, mass},
                         "stiffness and dissipation, for two grains of this mass each"});
    }
    if constexpr (std::same_as<Law, LinearPlasticViscoelastic>)
        found.push_back({"setPlasticParameters",
                         {{"loadingStiffness", "N/m", positive},
                          {"unloadingStiffnessMax", "N/m", positive},
                          {"cohesionStiffness", "N/m", notNegative},
                          {"penetrationDepthMax", "", positive}},
                         "these four"});
    return found;
}

}  // namespace pendular
