#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct PistonScene : FirstDriver {
    InfiniteWall* piston = nullptr;

    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        const double pressure = 100, area = 4e-6;  // Pa, m^2
        InfiniteWall lid;
        lid.setSpecies(material);
        lid.set({0, 0, 1}, {0, 0, 0.012});
        lid.setPiston(1e-4, pressure * area);  // kg, N; its weight comes on top of the load
        piston = wallHandler.copyAndAddObject(lid);
        // [end]
        particleHandler.getObject(0).setVelocity({0, 0, 0});
        setGravity({0, 0, -9.81});
        setTimeMax(1);
    }
};

TEST_F(HowDoI, Piston) {
    PistonScene scene;
    run(scene);
    // At rest on the grain, on the floor: 4e-4 N, and the weight of 1e-4 kg.
    EXPECT_NEAR(scene.piston->getForce().z(), 4e-4 + 1e-4 * 9.81, 1e-8);
    // Two contacts, each by 5 um.
    EXPECT_NEAR(scene.piston->pointOnPlane().z, 2e-3, 2e-5);
}

}  // namespace
