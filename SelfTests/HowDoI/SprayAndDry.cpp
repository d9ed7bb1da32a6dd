#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct SprayAndDry : Simulation<LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies> {
    void setupInitialConditions() override {
        auto material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500), material->setStiffness(300), material->setDissipation(2e-3);
        material->setSlidingStiffness(80), material->setSlidingFrictionCoefficient(0.4);
        material->setLiquidBridgeVolumeMax(4e-11), material->setContactAngle(0.3);
        material->setSurfaceTension(0.072);
        SphericalParticle grain;
        grain.setSpecies(material), grain.setRadius(1e-3);
        particleHandler.copyAndAddObject(grain);
        Spray nozzle;
        nozzle.setCone({0, 0, 0.01}, {0, 0, -1}, 0.1);  // where, direction, angle in rad
        nozzle.setDropletRadius(1e-4), nozzle.setSpeed(2);
        nozzle.setFlow(4e-9);  // m^3/s: a droplet every ms
        sprayHandler.copyAndAddObject(nozzle);
        Evaporation drying;
        drying.setFlux(1e-6);  // m/s: volume that a free surface loses for its area and time
        setEvaporation(drying);
        setTimeStep(1e-5), setTimeMax(0.02);
    }
};
// [end]

TEST_F(HowDoI, SprayAndDry) {
    SprayAndDry scene;
    run(scene);
    // 19 droplets by 20 ms, and a droplet flies for 4.5 ms or so.
    EXPECT_EQ(scene.sprayHandler.countOf(0), 19u);
    const LiquidLedger ledger = scene.liquidLedger();
    EXPECT_GT(ledger.films, 10 * 4e-12);
    EXPECT_GT(ledger.airborne, 0);
    EXPECT_GT(ledger.evaporated, 0);
    EXPECT_EQ(ledger.unaccounted(), 0);
}

}  // namespace
