#include "Kernel/Particles/GrainSums.h"

#include "Kernel/Math/ExactSum.h"

namespace pendular {

namespace {

/// The sum of what function(place) gives for each grain that can move.
template <class Function>
double exactSum(const ParticleStore& grains, Function&& function) {
    ExactSum sum;
    for (std::size_t k = 0; k < grains.size(); ++k)
        if (grains.translation[k].inverseMass > 0) sum.add(function(k));
    return sum.value();
}

double translationOf(const TranslationRecord& grain) {
    return 0.5 / grain.inverseMass * squaredNorm(grain.velocity);
}
double rotationOf(const ParticleStore& grains, std::size_t k) {
    return 0.5 / grains.rotation[k].inverseInertia * squaredNorm(grains.rotation[k].spin);
}

}  // namespace

GrainSums sumGrains(const ParticleStore& grains) {
    ExactSum mass;
    ExactVectorSum moment, momentum;
    for (const TranslationRecord& grain : grains.translation) {
        if (grain.inverseMass == 0) continue;
        const double own = 1 / grain.inverseMass;
        mass.add(own);
        moment.add(own * grain.position);
        momentum.add(own * grain.velocity);
    }
    GrainSums sums{mass.value(), moment.value(), momentum.value(), translationalEnergy(grains), 0};
    if (grains.hasSpin)
        sums.rotationalEnergy = exactSum(grains, [&](std::size_t k) { return rotationOf(grains, k); });
    return sums;
}

double translationalEnergy(const ParticleStore& grains) {
    return exactSum(grains, [&](std::size_t k) { return translationOf(grains.translation[k]); });
}

double kineticEnergy(const ParticleStore& grains) {
    if (!grains.hasSpin) return translationalEnergy(grains);
    return exactSum(
        grains, [&](std::size_t k) { return translationOf(grains.translation[k]) + rotationOf(grains, k); });
}

double potentialEnergy(const ParticleStore& grains, const Vector<double>& gravity) {
    return exactSum(grains, [&](std::size_t k) {
        const TranslationRecord& grain = grains.translation[k];
        return -dot(gravity, grain.position) / grain.inverseMass;
    });
}

}  // namespace pendular
