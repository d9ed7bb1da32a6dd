#include "SelfTests/Species/Composition/Composition.h"

namespace pendular::composition::linearViscoelasticTest {
namespace {

TEST(Composition, LinearViscoelasticWithEachOfTheOthers) {
    expectEveryCompositionWorks<LinearViscoelastic>();
}

TEST(Composition, LinearViscoelasticInWholeSimulations) {
    expectSimulationWorks<Species<LinearViscoelastic, NoFriction, NoAdhesion>>();
    expectSimulationWorks<Species<LinearViscoelastic, Mindlin, ReversibleAdhesive>>();
    expectSimulationWorks<Species<LinearViscoelastic, SlidingFriction, JKR>>();
    expectSimulationWorks<Species<LinearViscoelastic, SlidingRollingTorsion, LiquidBridgeBagheri>>();
}

}  // namespace
}  // namespace pendular::composition::linearViscoelasticTest
