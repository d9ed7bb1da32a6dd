#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct OpenGate : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        InfiniteWall gate;
        gate.setSpecies(speciesHandler.getLastObject());
        gate.set({1, 0, 0}, {0.0115, 0, 0});
        wallHandler.copyAndAddObject(gate);
    }
    void actionsBeforeTimeStep() override {
        if (getNumberOfTimeSteps() != 500) return;
        gather();                     // with mpirun, before walls are changed
        wallHandler.removeObject(1);  // 0 is the floor
    }
};
// [end]

TEST_F(HowDoI, OpenGate) {
    OpenGate scene;
    run(scene);
    // It is open when the grain comes.
    EXPECT_EQ(scene.particleHandler.getObject(0).getVelocity(), Vec3D(0.1, 0, 0));
    EXPECT_TRUE(scene.wallHandler.isRemoved(1));
    WithPlate<FirstDriver> closed;
    run(closed);
    EXPECT_LT(closed.particleHandler.getObject(0).getVelocity().x(), 0);
}

// The scene goes on without being told: the file tells which walls were removed.
TEST_F(HowDoI, OpenGateGoesOn) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    OpenGate scene;
    scene.keepRestartFile();
    run(scene);
    OpenGate opened;
    opened.restartFrom(scene.restartFile());
    run(opened);
    EXPECT_EQ(opened.getFirstStep(), scene.getNumberOfTimeSteps());
    EXPECT_TRUE(opened.wallHandler.isRemoved(1));
}

}  // namespace
