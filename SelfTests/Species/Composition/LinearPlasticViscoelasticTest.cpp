#include "SelfTests/Species/Composition/Composition.h"

namespace pendular::composition::linearPlasticViscoelasticTest {
namespace {

TEST(Composition, LinearPlasticViscoelasticWithEachOfTheOthers) {
    expectEveryCompositionWorks<LinearPlasticViscoelastic>();
}

TEST(Composition, LinearPlasticViscoelasticInWholeSimulations) {
    expectSimulationWorks<Species<LinearPlasticViscoelastic, NoFriction, LiquidBridgeBagheri>>();
    expectSimulationWorks<Species<LinearPlasticViscoelastic, Mindlin, NoAdhesion>>();
    expectSimulationWorks<Species<LinearPlasticViscoelastic, SlidingFriction, ReversibleAdhesive>>();
    expectSimulationWorks<Species<LinearPlasticViscoelastic, SlidingRollingTorsion, JKR>>();
}

}  // namespace
}  // namespace pendular::composition::linearPlasticViscoelasticTest
