#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct BoxScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        setDomain({0, 0, 0}, {0.021, 0.021, 0.021});  // m
        InfiniteWall side;
        side.setSpecies(material);
        for (const Vec3D& outward : {Vec3D(-1, 0, 0), Vec3D(0, -1, 0), Vec3D(0, 0, -1)}) {
            side.set(outward, getMin());
            wallHandler.copyAndAddObject(side);
            side.set(-outward, getMax());
            wallHandler.copyAndAddObject(side);
        }
        // [end]
        setTimeMax(0.15);
    }
};

TEST_F(HowDoI, Box) {
    BoxScene scene;
    run(scene);
    // To the wall at x = 0.021 m in 0.1 s, and back more slowly.
    EXPECT_EQ(scene.wallHandler.getSize(), 7u);
    EXPECT_LT(scene.particleHandler.getObject(0).getVelocity().x(), 0);
    EXPECT_LT(scene.particleHandler.getObject(0).getPosition().x(), 0.02);
}

}  // namespace
