#include "Kernel/Scene/BridgeAdvice.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct WetGrains : Simulation<HertzianViscoelasticMindlinIncrementalLiquidBridgeYoungLaplaceSpecies> {
    void setupInitialConditions() override {
        auto material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500);
        material->setEffectiveElasticModulusAndRestitutionCoefficient(2.8e6, 0.5);
        material->setEffectiveShearModulus(0.6e6), material->setSlidingFrictionCoefficient(0.4);
        material->setLiquidBridgeVolume(2e-12);  // m^3, of a bridge
        material->setContactAngle(0.3);          // rad
        material->setSurfaceTension(0.072);      // N/m
        SphericalParticle grain;
        grain.setSpecies(material), grain.setRadius(1e-3);
        particleHandler.copyAndAddObject(grain);
        grain.setPosition({1.999e-3, 0, 0});  // it touches the first one
        particleHandler.copyAndAddObject(grain);
        fmt::print("{}\n", bridgeAdvice(*this, 0.05));  // the cheapest law within 5 %
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25)), setTimeMax(0.001);
    }
};
// [end]

TEST_F(HowDoI, WetGrains) {
    WetGrains scene;
    const std::string printed = run(scene);
    EXPECT_TRUE(contains(printed, "LiquidBridge")) << printed;
    ASSERT_EQ(scene.interactions().size(), 1u);
    EXPECT_TRUE(scene.interactions()[0].bridged);
}

}  // namespace
