#pragma once

#include <gtest/gtest.h>

#include "Kernel/Simulation/Scene.h"

namespace pendular::periodic {

/// All pairs that overlap, by looking at each pair, are known to touch. Returns how many there are.
inline std::size_t expectAllOverlapsKnown(const Scene& scene) {
    const PeriodicBox& box = scene.getPeriodicBox();
    const auto& grains = scene.particleHandler.store().translation;
    std::size_t expected = 0, found = 0;
    for (std::size_t a = 0; a < grains.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            expected += norm(box.nearest(grains[a].position - grains[b].position)) <
                                grains[a].radius + grains[b].radius
                            ? 1
                            : 0;
    for (const ObservedContact& seen : scene.interactions()) found += seen.touching ? 1 : 0;
    EXPECT_EQ(found, expected) << "at step " << scene.getNumberOfTimeSteps();
    return expected;
}

/// J, of the grains against the flow and their mean motion, which bears no stress, with what contacts store
/// and have lost.
inline double energyAgainstFlow(const Scene& scene) {
    const PeriodicBox& box = scene.getPeriodicBox();
    const ParticleStore& grains = scene.particleHandler.store();
    double sum = scene.energyLedger().stored() + scene.energyLedger().lost();
    Vector<double> momentum{0, 0, 0};
    double mass = 0;
    for (std::size_t k = 0; k < grains.size(); ++k) {
        const TranslationRecord& grain = grains.translation[k];
        const Vector<double> velocity = grain.velocity - box.flowAt(grain.position);
        sum += 0.5 / grain.inverseMass * squaredNorm(velocity) +
               0.5 / grains.rotation[k].inverseInertia * squaredNorm(grains.rotation[k].spin);
        momentum += (1 / grain.inverseMass) * velocity;
        mass += 1 / grain.inverseMass;
    }
    return sum - 0.5 * squaredNorm(momentum) / mass;
}

/// J, the work of a power (W) over so many steps, by trapezoids.
template <class Power>
double workOver(Scene& scene, int steps, Power&& power) {
    double work = 0, last = power();
    for (int k = 0; k < steps; ++k) {
        scene.step();
        const double now = power();
        work += 0.5 * scene.getTimeStep() * (last + now);
        last = now;
    }
    return work;
}

}  // namespace pendular::periodic
