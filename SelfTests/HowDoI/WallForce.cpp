#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct WallForceScene : FirstDriver {
    InfiniteWall* plate = nullptr;

    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        InfiniteWall wall;
        wall.setSpecies(speciesHandler.getLastObject());
        wall.set({1, 0, 0}, {0.0115, 0, 0});
        plate = wallHandler.copyAndAddObject(wall);
        plate->keepForces(true, {0, 0, 0});  // torque about this point, m
    }
    void writeOutput() override {
        fmt::print("{} N, {} N m\n", plate->getForce().x(), plate->getTorque().norm());
    }
};
// [end]

TEST_F(HowDoI, WallForce) {
    struct Summed : WallForceScene {
        void actionsAfterTimeStep() override { impulse += plate->getForce().x() * getTimeStep(); }
        double impulse = 0;  // N s
    } scene;
    const std::string printed = run(scene);
    // What the wall takes, the grain has lost: velocities follow from the mean of the forces before and after
    // a step, and the first and the last force are zero.
    const GrainReference grain = scene.particleHandler.getObject(0);
    EXPECT_LT(grain.getVelocity().x(), 0);
    EXPECT_NEAR(scene.impulse / (grain.getMass() * (0.1 - grain.getVelocity().x())), 1, 1e-9);
    EXPECT_TRUE(contains(printed, " N m")) << printed;
}

}  // namespace
