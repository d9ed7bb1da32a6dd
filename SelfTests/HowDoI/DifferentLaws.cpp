#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
using Dry = HertzianViscoelasticMindlinIncrementalSpecies;
using Wet = HertzianViscoelasticMindlinIncrementalLiquidBridgeBagheriSpecies;

struct DifferentLaws : Simulation<Dry, Wet> {
    void setupInitialConditions() override {
        Dry glass;
        glass.setDensity(2500);
        glass.setEffectiveElasticModulusAndRestitutionCoefficient(2.8e6, 0.5);
        glass.setEffectiveShearModulus(0.6e6), glass.setSlidingFrictionCoefficient(0.4);
        Wet clay;
        clay.setDensity(2000);
        clay.setEffectiveElasticModulusAndRestitutionCoefficient(2.8e6, 0.3);
        clay.setEffectiveShearModulus(0.6e6), clay.setSlidingFrictionCoefficient(0.6);
        clay.setLiquidBridgeVolume(2e-12);  // m^3
        clay.setContactAngle(0.3), clay.setSurfaceTension(0.072);
        auto dry = speciesHandler.copyAndAddObject(glass);
        auto wet = speciesHandler.copyAndAddObject(clay);
        speciesHandler.setPairType<Wet>(dry, wet);  // they stick together
        SphericalParticle grain;
        grain.setSpecies(dry), grain.setRadius(1e-3);
        particleHandler.copyAndAddObject(grain);
        grain.setSpecies(wet), grain.setPosition({1.999e-3, 0, 0});
        particleHandler.copyAndAddObject(grain);
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25)), setTimeMax(0.001);
    }
};
// [end]

TEST_F(HowDoI, DifferentLaws) {
    DifferentLaws scene;
    run(scene);
    ASSERT_EQ(scene.interactions().size(), 1u);
    EXPECT_TRUE(scene.interactions()[0].bridged);
}

}  // namespace
