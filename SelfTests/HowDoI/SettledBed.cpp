#include "Drivers/Shared/GrainRows.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct SettledBedScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        particleHandler.removeObject(0);
        FirstDriver settling;
        settling.setQuiet();
        // [snippet]
        settling.solve();
        for (const GrainRow& row : grainRows(settling.particleHandler))
            addGrainRow(particleHandler, material, row);
        // [end]
    }
};

TEST_F(HowDoI, SettledBed) {
    SettledBedScene scene;
    run(scene);
    EXPECT_EQ(scene.particleHandler.getSize(), 1u);
    for (GrainReference grain : scene.particleHandler) {
        EXPECT_NEAR(grain.getPosition().x(), 0.01 + 0.1 * scene.getTime(), 1e-12);
        EXPECT_EQ(grain.getVelocity(), Vec3D(0, 0, 0));
    }
}

}  // namespace
