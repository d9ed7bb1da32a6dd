#include "Kernel/Laws/Concepts/ElasticConstants.h"

#include "Kernel/Laws/Species/AnySpecies.h"

namespace pendular {

void setElasticConstants(AnyLaws& laws, double youngModulus, double poissonRatio) {
    checkValue(laws.getName(), "youngModulus", youngModulus, "Pa", positive);
    checkValue(laws.getName(), "poissonRatio", poissonRatio, "", poissonRatios);
    laws.set("effectiveElasticModulus", computeEffectiveElasticModulus(youngModulus, poissonRatio));
    if (laws.has("effectiveShearModulus"))
        laws.set("effectiveShearModulus", computeEffectiveShearModulus(youngModulus, poissonRatio));
}

}  // namespace pendular
