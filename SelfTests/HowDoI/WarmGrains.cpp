#include "Kernel/Features/Heat/HeatPart.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct WarmGrain : FirstDriver {
    GrainColumnReference temperature = particleHandler.addColumn("temperature", "K", 293);
    HeatPart& heat = addPart<HeatPart>(temperature);
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        heat.setMaterial(speciesHandler.getLastObject(), {.conductivity = 1, .heatCapacity = 800});
        heat.holdWall(0, 350);  // K, of wall 0; other walls are insulators
        heat.heatByContacts();  // friction and damping warm the grains
        keepEnergyLedger();     // which knows what contacts lose
        setGravity({0, 0, -500}), setTimeMax(0.02);
    }
};
// [end]

TEST_F(HowDoI, WarmGrains) {
    WarmGrain scene;
    run(scene);
    EXPECT_GT(scene.temperature[0], 293);
    EXPECT_GT(scene.heat.ledger().fromContacts, 0);
    EXPECT_GT(scene.heat.ledger().fromWalls, 0);
}

}  // namespace
