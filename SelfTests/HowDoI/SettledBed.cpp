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

// The first scene may have removed grains.
TEST_F(HowDoI, SettledBedOfTheGrainsThatAreLeft) {
    FirstDriver scene;
    run(scene);
    SphericalParticle second;
    second.setSpecies(scene.speciesHandler.getObject(0));
    second.setRadius(2e-3);
    scene.particleHandler.copyAndAddObject(second);
    scene.particleHandler.removeObject(0);
    const std::vector<GrainRow> rows = grainRows(scene.particleHandler);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].radius, 2e-3);
}

}  // namespace
