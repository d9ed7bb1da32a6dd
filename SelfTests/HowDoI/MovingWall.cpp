#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/HowDoI/DrumFile.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct MovingWallScene : FirstDriver {
    TriangleWall* added = nullptr;

    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        writeDrumFile();
        TriangleWall mesh;
        mesh.read("drum.stl", 1e-3);
        mesh.setSpecies(material);
        // [snippet]
        mesh.setAngularVelocity({0, -2, 0}, {0, 0, 0});  // rad/s, about an axis through this point
        mesh.setVelocity({0, 0, 0.1});                   // m/s, of that point
        TriangleWall* drum = wallHandler.copyAndAddObject(mesh);
        drum->keepForces();  // getForce(), getTorque() after each step
        // [end]
        added = drum;
    }
};

TEST_F(HowDoI, MovingWall) {
    MovingWallScene scene;
    run(scene);
    // v = (0, 0, 0.1) + (0, -2, 0) x (0.1, 0, -0.1 t)
    const Vec3D velocity = scene.added->getVelocityAt({0.1, 0, 0});
    EXPECT_NEAR(velocity.x(), 0.2 * scene.getTime(), 1e-12);
    EXPECT_NEAR(velocity.z(), 0.3, 1e-12);
}

}  // namespace
