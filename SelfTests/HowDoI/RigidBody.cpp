#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct Dumbbell : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();  // grain 0
        SphericalParticle second;
        second.setSpecies(speciesHandler.getLastObject());
        second.setRadius(1e-3), second.setPosition({0.01, 0.01, 0.012});  // m, it touches the first
        particleHandler.copyAndAddObject(second);
        BodyReference body = bodyHandler.join({0, 1});
        body.setAngularVelocity({0, 30, 0});  // rad/s
        setTimeStep(stabilityLimit());        // s
    }
};
// [end]

TEST_F(HowDoI, RigidBody) {
    Dumbbell scene;
    run(scene);
    const Vec3D spin = scene.bodyHandler.getObject(0).getAngularVelocity();
    EXPECT_NEAR((spin - Vec3D(0, 30, 0)).norm(), 0, 1e-9);  // about a principal axis it stays
    const auto at = [&](std::uint32_t k) { return scene.particleHandler.getObject(k).getPosition(); };
    EXPECT_NEAR((at(0) - at(1)).norm(), 0.002, 1e-15);
}

}  // namespace
