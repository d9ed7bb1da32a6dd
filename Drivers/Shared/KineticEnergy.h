#pragma once

#include "Kernel/Particles/ParticleStore.h"

namespace pendular {

/// J, of the motion of the centres only, as other codes count it; grains that are held have none.
inline double translationalEnergy(const ParticleStore& grains) {
    double sum = 0;
    for (const TranslationRecord& grain : grains.translation)
        if (grain.inverseMass > 0) sum += 0.5 * squaredNorm(grain.velocity) / grain.inverseMass;
    return sum;
}

}  // namespace pendular
