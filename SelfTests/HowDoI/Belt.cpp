#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct BeltScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        InfiniteWall belt;
        belt.setSpecies(material);
        belt.set({0, 0, -1}, {0, 0, 0});
        belt.setSurfaceVelocity({0.5, 0, 0});  // m/s
        wallHandler.copyAndAddObject(belt);
        // [end]
    }
};

TEST_F(HowDoI, Belt) {
    BeltScene scene;
    run(scene);
    const auto& belt = dynamic_cast<const InfiniteWall&>(scene.wallHandler.getObject(1));
    EXPECT_EQ(belt.getVelocityAt({0.01, 0.01, 0}), Vec3D(0.5, 0, 0));
    EXPECT_EQ(belt.getPose().shift.x, 0);
}

}  // namespace
