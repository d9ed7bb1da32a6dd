#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct FixedGrainScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        SphericalParticle obstacle;
        obstacle.setSpecies(material);
        obstacle.setRadius(5e-3), obstacle.setPosition({0.02, 0.01, 0.01});  // m
        obstacle.fixParticle();                                              // an infinite mass
        particleHandler.copyAndAddObject(obstacle);
        // [end]
        setGravity({0, 0, -9.81});
    }
};

TEST_F(HowDoI, FixedGrain) {
    FixedGrainScene scene;
    run(scene);
    EXPECT_EQ(scene.particleHandler.getObject(1).getPosition(), Vec3D(0.02, 0.01, 0.01));
    EXPECT_LT(scene.particleHandler.getObject(0).getPosition().z(), 0.01);
}

}  // namespace
