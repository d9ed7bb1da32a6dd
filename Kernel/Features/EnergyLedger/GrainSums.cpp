#include "Kernel/Features/EnergyLedger/GrainSums.h"

#include "Kernel/Features/RigidBodies/MovingBodies.h"

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
    GrainSums sums;
    forEachMovingBody(grains,
                      [&](double own, const Vector<double>& position, const Vector<double>& velocity) {
                          sums.mass.add(own);
                          sums.firstMoment.add(own * position);
                          sums.momentum.add(own * velocity);
                      });
    addTranslation(grains, sums.translationalEnergy);
    addRotation(grains, sums.rotationalEnergy);
    return sums;
}

ExactSum sumOfTranslationalEnergy(const ParticleStore& grains) {
    ExactSum sum;
    addTranslation(grains, sum);
    return sum;
}

ExactSum sumOfKineticEnergy(const ParticleStore& grains) {
    ExactSum sum;
    addTranslation(grains, sum);
    addRotation(grains, sum);
    return sum;
}

ExactSum sumOfPotentialEnergy(const ParticleStore& grains, const Vector<double>& gravity) {
    ExactSum sum;
    forEachMovingBody(grains, [&](double mass, const Vector<double>& position, const Vector<double>&) {
        sum.add(-mass * dot(gravity, position));
    });
    return sum;
}

}  // namespace pendular
