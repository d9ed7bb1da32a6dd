#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct VibratingWallScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        InfiniteWall floor;
        floor.setSpecies(material);
        floor.set({0, 0, -1}, {0, 0, 0});
        floor.setMotion([](double time) {
            const double height = 1e-4 * std::sin(2 * constants::pi * 50 * time);  // 0.1 mm, 50 Hz
            return Eigen::Isometry3d(Eigen::Translation3d(0, 0, height));
        });
        wallHandler.copyAndAddObject(floor);
        // [end]
    }
};

TEST_F(HowDoI, VibratingWall) {
    VibratingWallScene scene;
    run(scene);
    const auto& floor = dynamic_cast<const InfiniteWall&>(scene.wallHandler.getObject(1));
    EXPECT_NEAR(floor.getPose().shift.z, 1e-4 * std::sin(2 * constants::pi * 50 * scene.getTime()), 1e-15);
}

}  // namespace
