#include "SelfTests/HowDoI/LooseGrains.h"

namespace {

struct OedometerScene : LooseGrains {
    void setupInitialConditions() override {
        LooseGrains::setupInitialConditions();
        auto* const glass = speciesHandler.getObject(0);
        // [snippet]
        for (const int axis : {0, 1}) setPeriodic(axis, 0, 0.01), setStrainRate(axis, -1);
        InfiniteWall plane;
        plane.setSpecies(glass);
        plane.set({0, 0, -1}, {0, 0, -0.002});
        wallHandler.copyAndAddObject(plane);
        plane.set({0, 0, 1}, {0, 0, 0.01});
        wallHandler.copyAndAddObject(plane)->setPiston(1e-4, 0.01);  // kg, N: 100 Pa on 1 cm^2
        // [end]
        setTimeMax(0.05);
    }
};

TEST_F(HowDoI, Oedometer) {
    OedometerScene scene;
    run(scene);
    EXPECT_NEAR(scene.getPeriodicBox().length.x, 0.01 * std::exp(-0.05), 0.01 * scene.getTimeStep());
    const auto& piston = dynamic_cast<const InfiniteWall&>(scene.wallHandler.getObject(1));
    EXPECT_LT(piston.pointOnPlane().z, 0.01);
}

}  // namespace
