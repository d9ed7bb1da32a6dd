#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct PeriodicScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();

        wallHandler.clear();
        // [snippet]
        setPeriodic(0, 0, 0.02);  // along x, from 0 to 0.02 m
        setPeriodic(1, 0, 0.02);  // along y
        setGravity({1, 0, -9.81});
        // [end]
        setTimeMax(0.1);
    }
};

TEST_F(HowDoI, Periodic) {
    PeriodicScene scene;
    run(scene);
    // It falls freely, and goes on at x = 0 when it comes to 0.02 m.
    const double t = scene.getTime();
    const Vec3D position = scene.particleHandler.getObject(0).getPosition();
    EXPECT_NEAR(position.z(), 0.01 - 0.5 * 9.81 * t * t, 1e-11);
    EXPECT_NEAR(std::remainder(position.x() - (0.01 + 0.1 * t + 0.5 * t * t), 0.02), 0, 1e-11);
    EXPECT_LT(position.x(), 0.021);
}

}  // namespace
