#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct HeldAxesScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(1e-3), grain.setPosition({0.02, 0.01, 0.01});  // m
        // [snippet]
        grain.setHeldAxes({.z = true, .aboutX = true, .aboutY = true});  // moves in the plane of x and y
        GrainReference disc = particleHandler.copyAndAddObject(grain);
        GrainReference roller = particleHandler.getObject(0);
        roller.setHeldAxes(
            {.x = true, .y = true, .z = true, .aboutX = true, .aboutZ = true});  // turns about y
        roller.setAngularVelocity({0, 50, 0});                                   // rad/s
        disc.setVelocity({0.1, 0, 0});                                           // m/s
        // [end]
        setGravity({0, 0, -9.81});
    }
};

TEST_F(HowDoI, HeldAxes) {
    HeldAxesScene scene;
    run(scene);
    const auto grain = [&](std::size_t k) { return scene.particleHandler.getObject(k); };
    EXPECT_EQ(grain(0).getPosition(), Vec3D(0.01, 0.01, 0.01));
    EXPECT_EQ(grain(0).getAngularVelocity(), Vec3D(0, 50, 0));
    EXPECT_EQ(grain(1).getPosition().z(), 0.01);
    // Each step rounds the position to 4e-18 m.
    EXPECT_NEAR(grain(1).getPosition().x(), 0.02 + 0.1 * scene.getTime(),
                4e-18 * static_cast<double>(scene.getNumberOfTimeSteps()));
}

}  // namespace
