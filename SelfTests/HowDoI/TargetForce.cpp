#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct TargetForceScene : FirstDriver {
    InfiniteWall* plate = nullptr;

    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        InfiniteWall lid;
        lid.setSpecies(material);
        lid.set({0, 0, 1}, {0, 0, 0.012});
        lid.setTargetForce(0.01, 1e-3, 0.05);  // N, s, m/s
        plate = wallHandler.copyAndAddObject(lid);
        // [end]
        particleHandler.getObject(0).setVelocity({0, 0, 0});
        setTimeMax(0.4);
    }
};

TEST_F(HowDoI, TargetForce) {
    TargetForceScene scene;
    run(scene);
    EXPECT_NEAR(scene.plate->getForce().z(), 0.01, 1e-5);
}

}  // namespace
