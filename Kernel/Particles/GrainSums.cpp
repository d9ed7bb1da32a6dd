#include "Kernel/Particles/GrainSums.h"

#include "Kernel/Math/ExactSum.h"
#include "Kernel/Particles/MovingBodies.h"

namespace pendular {

namespace {

void addRotation(const ParticleStore& grains, ExactSum& sum) {
    if (grains.hasSpin)
        for (std::size_t k = 0; k < grains.ownSize(); ++k)
            if (grains.isFree(k))
                sum.add(0.5 / grains.rotation[k].inverseInertia * squaredNorm(grains.rotation[k].spin));
    for (std::size_t k = 0; k < grains.bodies.size(); ++k)
        if (!grains.bodies.isHeld(k)) sum.add(grains.bodies[k].rotationalEnergy());
}
void addTranslation(const ParticleStore& grains, ExactSum& sum) {
    forEachMovingBody(grains, [&](double mass, const Vector<double>&, const Vector<double>& velocity) {
        sum.add(0.5 * mass * squaredNorm(velocity));
    });
}

}  // namespace

GrainSums sumGrains(const ParticleStore& grains) {
    ExactSum mass, rotation;
    ExactVectorSum moment, momentum;
    forEachMovingBody(grains,
                      [&](double own, const Vector<double>& position, const Vector<double>& velocity) {
                          mass.add(own);
                          moment.add(own * position);
                          momentum.add(own * velocity);
                      });
    addRotation(grains, rotation);
    return {mass.value(), moment.value(), momentum.value(), translationalEnergy(grains), rotation.value()};
}

double translationalEnergy(const ParticleStore& grains) {
    ExactSum sum;
    addTranslation(grains, sum);
    return sum.value();
}

double kineticEnergy(const ParticleStore& grains) {
    ExactSum sum;
    addTranslation(grains, sum);
    addRotation(grains, sum);
    return sum.value();
}

double potentialEnergy(const ParticleStore& grains, const Vector<double>& gravity) {
    ExactSum sum;
    forEachMovingBody(grains, [&](double mass, const Vector<double>& position, const Vector<double>&) {
        sum.add(-mass * dot(gravity, position));
    });
    return sum.value();
}

}  // namespace pendular
