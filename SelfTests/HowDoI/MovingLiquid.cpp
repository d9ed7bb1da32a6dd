#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct MovingLiquid : Simulation<LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies> {
    void setupInitialConditions() override {
        auto material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500), material->setStiffness(300), material->setDissipation(2e-3);
        material->setSlidingStiffness(80), material->setSlidingFrictionCoefficient(0.4);
        material->setLiquidBridgeVolumeMax(4e-12);  // m^3, of a bridge
        material->setDistributionCoefficient(0.8);  // to other bridges when one ruptures; the rest to films
        material->setContactAngle(0.3), material->setSurfaceTension(0.072);
        SphericalParticle grain;
        grain.setSpecies(material), grain.setRadius(1e-3);
        grain.setLiquidVolume(1e-12);  // m^3, of the film on the grain
        particleHandler.copyAndAddObject(grain);
        grain.setPosition({1.999e-3, 0, 0});  // it touches the first one
        particleHandler.copyAndAddObject(grain);
        setTimeStep(1e-5), setTimeMax(1e-4);
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() == 5) particleHandler.getObject(0).setLiquidVolume(3e-12);  // a drop
    }
};
// [end]

TEST_F(HowDoI, MovingLiquid) {
    MovingLiquid scene;
    run(scene);
    ASSERT_EQ(scene.interactions().size(), 1u);
    EXPECT_NEAR(scene.interactions()[0].bridgeVolume, 2e-12, 1e-20);
    EXPECT_NEAR(scene.particleHandler.getObject(0).getLiquidVolume(), 3e-12, 1e-20);
    EXPECT_NEAR(scene.liquidLedger().absorbed, 3e-12, 1e-20);
    EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
}

}  // namespace
