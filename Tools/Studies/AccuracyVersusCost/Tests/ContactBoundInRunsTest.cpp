#include <gtest/gtest.h>

#include "Kernel/Laws/Adhesion/ReversibleAdhesive.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Tools/Studies/AccuracyVersusCost/CriticalStep.h"

// The step that the contacts of a scene stand (SelfTests/Motion/ContactBoundTest.cpp), against runs.

namespace pendular::contactBoundInRunsTest {
namespace {

// In the crystal the bound is exact where each motion has a spring of one kind: layers that shift, 8 k / m
// without friction; and all bounds are below what is measured, with dashpots too.
template <class S>
void expectStable(const RestingGrains& scene, double zeta, double friction, double within) {
    const S species = criticalMaterial::make<S>({zeta, friction}, scene.bodies(), scene.effectiveMass());
    const Integrator& scheme = integrators::springsInStep;
    DisturbedGrains<S> resting(species, scene, 1e-9, scheme);
    resting.initialise();
    const double bound = resting.stableStepOfContacts();
    EXPECT_FALSE(DisturbedGrains<S>(species, scene, 0.95 * bound, scheme).grows())
        << scene.name << " " << zeta << " " << friction;
    if (within == 0) return;
    EXPECT_TRUE(DisturbedGrains<S>(species, scene, within * bound, scheme).grows())
        << scene.name << " " << zeta << " " << friction;
}

TEST(ContactBound, isStableInRunsAndNearTheCriticalStep) {
    using Smooth = Species<LinearViscoelastic, NoFriction, ReversibleAdhesive>;
    using Rough = Species<LinearViscoelastic, SlidingFriction, ReversibleAdhesive>;
    using Hertz = Species<HertzianViscoelastic, Mindlin, ReversibleAdhesive>;
    expectStable<Smooth>(resting::crystal(), 0, 1, 1.05);
    for (const double zeta : {0.0, 0.1, 0.6}) {
        for (const RestingGrains& scene : {resting::onWall(), resting::pair()}) {
            expectStable<Rough>(scene, zeta, 1, 0);
            expectStable<Hertz>(scene, zeta, 1, 0);
        }
        expectStable<Rough>(resting::crystal(), zeta, 1, 1.3);
        expectStable<Hertz>(resting::crystal(), zeta, 1, 1.3);
        expectStable<Rough>(resting::crystal(), zeta, 10, 1.3);
    }
    expectStable<Rough>(resting::between(), 0, 1, 0);
    expectStable<Rough>(resting::covered(), 0, 1, 0);
}

}  // namespace
}  // namespace pendular::contactBoundInRunsTest
