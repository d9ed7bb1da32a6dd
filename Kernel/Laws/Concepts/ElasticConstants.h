#pragma once

#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

class AnyLaws;

/// Of materials that resist every change of shape and of volume.
inline constexpr Range poissonRatios{-1, 0.5, false, true};

/// The effective elastic modulus E* of two bodies of the same material (Pa) from its Young's modulus E (Pa)
/// and Poisson's ratio: 1/E* = 2 (1 - nu^2) / E. (Thornton et al. 2023, section 4.1, print 1 - nu: a
/// misprint.) Throws InputError for a ratio that no material has.
inline double computeEffectiveElasticModulus(double elasticModulus, double poissonRatio) {
    checkValue("computeEffectiveElasticModulus", "Poisson's ratio", poissonRatio, "", poissonRatios);
    return 0.5 * elasticModulus / (1 - poissonRatio * poissonRatio);
}

/// The effective shear modulus G* of two bodies of the same material (Pa) from its Young's modulus E (Pa) and
/// Poisson's ratio: 1/G* = 2 (2 - nu) / G with G = E / (2 (1 + nu)). Throws InputError for a ratio that no
/// material has.
inline double computeEffectiveShearModulus(double elasticModulus, double poissonRatio) {
    checkValue("computeEffectiveShearModulus", "Poisson's ratio", poissonRatio, "", poissonRatios);
    return 0.25 * elasticModulus / ((1 + poissonRatio) * (2 - poissonRatio));
}

/// Gives laws on Hertz's force the constants of two bodies of one material: E*, and G* where the friction law
/// has one. Throws InputError where the laws have no E*, or a value is out of its range.
/// @param youngModulus Pa
void setElasticConstants(AnyLaws& laws, double youngModulus, double poissonRatio);

}  // namespace pendular
