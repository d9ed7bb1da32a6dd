#include "SelfTests/Species/Composition/Composition.h"

namespace pendular::composition::hertzianViscoelasticTest {
namespace {

TEST(Composition, HertzianViscoelasticWithEachOfTheOthers) {
    expectEveryCompositionWorks<HertzianViscoelastic>();
}

TEST(Composition, HertzianViscoelasticInWholeSimulations) {
    expectSimulationWorks<Species<HertzianViscoelastic, NoFriction, ReversibleAdhesive>>();
    expectSimulationWorks<Species<HertzianViscoelastic, Mindlin, JKR>>();
    expectSimulationWorks<Species<HertzianViscoelastic, SlidingFriction, LiquidBridgeBagheri>>();
    expectSimulationWorks<Species<HertzianViscoelastic, SlidingRollingTorsion, NoAdhesion>>();
}

}  // namespace
}  // namespace pendular::composition::hertzianViscoelasticTest
