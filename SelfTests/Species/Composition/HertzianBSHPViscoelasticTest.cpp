#include "SelfTests/Species/Composition/Composition.h"

namespace pendular::composition::hertzianBSHPViscoelasticTest {
namespace {

TEST(Composition, HertzianBSHPViscoelasticWithEachOfTheOthers) {
    expectEveryCompositionWorks<HertzianBSHPViscoelastic>();
}

TEST(Composition, HertzianBSHPViscoelasticInWholeSimulations) {
    expectSimulationWorks<Species<HertzianBSHPViscoelastic, NoFriction, JKR>>();
    expectSimulationWorks<Species<HertzianBSHPViscoelastic, Mindlin, LiquidBridgeBagheri>>();
    expectSimulationWorks<Species<HertzianBSHPViscoelastic, SlidingFriction, NoAdhesion>>();
    expectSimulationWorks<Species<HertzianBSHPViscoelastic, SlidingRollingTorsion, ReversibleAdhesive>>();
}

}  // namespace
}  // namespace pendular::composition::hertzianBSHPViscoelasticTest
