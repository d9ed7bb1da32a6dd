#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct FunnelScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        InfiniteCylinder tube;
        tube.setSpecies(material);
        tube.set({0, 0, 1}, {0, 0, 0}, 0.05, CylinderSide::Inside);  // axis, a point on it, radius (m)
        wallHandler.copyAndAddObject(tube);

        AxisymmetricWall funnel;
        funnel.setSpecies(material);
        funnel.set({0, 0, 1}, {0, 0, 0}, {{0.01, 0}, {0.05, 0.04}});  // from the outlet to the rim
        wallHandler.copyAndAddObject(funnel);
        // [end]
        setGravity({0, 0, -9.81});
        setTimeMax(0.06);
    }
};

TEST_F(HowDoI, Funnel) {
    FunnelScene scene;
    run(scene);
    // On the cone, at 45 degrees to the axis, the grain turns towards the axis.
    EXPECT_EQ(scene.wallHandler.getSize(), 3u);
    const Vec3D velocity = scene.particleHandler.getObject(0).getVelocity();
    EXPECT_LT(velocity.x() + velocity.y(), 0);
}

}  // namespace
