#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct GrainsFromFileScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        writeGrainFile("grains.txt", {{1e-3, {0, 0, 0.05}}, {2e-3, {0, 0, 0.06}}});
        // [snippet]
        for (const GrainRow& row : readGrainFile("grains.txt")) {
            SphericalParticle grain;
            grain.setSpecies(material);
            grain.setRadius(row.radius);
            grain.setPosition(row.position);
            particleHandler.copyAndAddObject(grain);
        }
        // [end]
    }
};

TEST_F(HowDoI, GrainsFromFile) {
    GrainsFromFileScene scene;
    run(scene);
    ASSERT_EQ(scene.particleHandler.getSize(), 3u);
    EXPECT_EQ(scene.particleHandler.getObject(2).getRadius(), 2e-3);
    EXPECT_EQ(scene.particleHandler.getObject(2).getPosition(), Vec3D(0, 0, 0.06));
}

}  // namespace
