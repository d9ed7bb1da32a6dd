#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"

// What tests of shear and strain have in common.

namespace pendular::periodic {

using Smooth = Species<LinearViscoelastic>;
using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
using SpeciesOfAllKinds = testing::Types<Smooth, Dry, Wet>;

/// m/s, of a grain against the flow at its place.
inline Vec3D againstFlow(const Scene& scene, const scenes::GrainMotion& motion) {
    return motion.velocity - scene.shearFlowAt(motion.position);
}

inline void repeatAlongAllAxes(Scene& scene, double side) {
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, side);
}

/// Why a scene of one grain, periodic along the first axes, is refused after a change: one sentence, or
/// nothing.
template <class Change>
std::string refusalOfOneGrain(int periodicAxes, Change&& change) {
    scenes::FewGrains<Smooth> scene(scenes::boxMaterial<Smooth>(0), {{.position = {0.005, 0.005, 0.005}}},
                                    1e-6);
    for (int axis = 0; axis < periodicAxes; ++axis) scene.setPeriodic(axis, 0, 0.01);
    const std::string text = support::refusal([&] {
        change(scene);
        scene.initialise();
    });
    EXPECT_TRUE(text.empty() || support::isOneSentence(text)) << text;
    return text;
}

/// The sentence with which a scene ends within so many steps; empty if it does not.
template <class S>
std::string endWithin(S& scene, std::size_t steps) {
    scene.initialise();
    try {
        scene.step(steps);
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what()));
        return error.what();
    }
    return {};
}

/// @param make makes the scene; @param counts of threads, beside one. Returns the hash.
template <class Make>
std::uint64_t expectSameBitsForAnyThreads(Make&& make, std::initializer_list<int> counts) {
    const std::uint64_t one = make().hashAfter(1000);
    for (const int threads : counts) {
        auto scene = make();
        scene.setNumberOfThreads(threads);
        EXPECT_EQ(scene.hashAfter(1000), one) << threads;
    }
    return one;
}

/// A scene that was stepped, and one that goes on from its restart file, have the same bits and images.
template <class S>
void expectGoesOnAlike(S& whole, S& resumed, const std::filesystem::path& file, std::size_t steps) {
    whole.writeRestart(file);
    resumed.restartFrom(file);
    resumed.initialise();
    EXPECT_EQ(resumed.getPeriodicBox().imageShift, whole.getPeriodicBox().imageShift);
    whole.step(steps), resumed.step(steps);
    EXPECT_EQ(resumed.getPeriodicBox().imageShift, whole.getPeriodicBox().imageShift);
    EXPECT_EQ(resumed.getPeriodicBox().length, whole.getPeriodicBox().length);
    EXPECT_EQ(stateHash(resumed.particleHandler.store()), stateHash(whole.particleHandler.store()));
}

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

/// The same after each of so many rounds of steps from the start.
template <class S>
std::size_t overlapsKnownInRounds(S& scene, int rounds, std::size_t steps) {
    scene.initialise();
    std::size_t overlaps = 0;
    for (int k = 0; k < rounds; ++k) {
        scene.step(steps);
        overlaps += expectAllOverlapsKnown(scene);
    }
    return overlaps;
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
