#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct BoxScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        InfiniteWall side;
        side.setSpecies(material);
        for (const Vec3D& outward : {Vec3D(-1, 0, 0), Vec3D(0, -1, 0), Vec3D(0, 0, -1)}) {
            side.set(outward, {0, 0, 0});  // through the origin
            wallHandler.copyAndAddObject(side);
            side.set(-outward, {0.021, 0.021, 0.021});  // m, on the other side
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
