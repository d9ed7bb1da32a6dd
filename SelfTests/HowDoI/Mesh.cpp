#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/HowDoI/DrumFile.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct MeshScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        writeDrumFile();
        // [snippet]
        TriangleWall mesh;
        mesh.read("drum.stl", 1e-3);  // the file is in mm
        mesh.setSpecies(material);
        wallHandler.copyAndAddObject(mesh);
        // [end]
    }
};

TEST_F(HowDoI, Mesh) {
    MeshScene scene;
    run(scene);
    // The plate of the file is at x = 0.0115 m.
    EXPECT_EQ(scene.wallHandler.getSize(), 2u);
    EXPECT_LT(scene.particleHandler.getObject(0).getVelocity().x(), 0);
}

}  // namespace
