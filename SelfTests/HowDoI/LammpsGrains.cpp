#include <fstream>

#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct LammpsGrainsScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto glass = speciesHandler.getLastObject();
        auto steel = speciesHandler.copyAndAddObject(*glass);
        glass->setDensity(2500), steel->setDensity(7850);
        std::ofstream("dump.bed")
            << "ITEM: TIMESTEP\n5000\nITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id type x y z vx vy vz "
               "radius density\n7 2 0 0 0.06 0 0 -1 0.002 7850\n3 1 0 0 0.05 0 0 0 0.001 2500\n";
        // [snippet]
        const std::vector<GrainRow> rows = readGrainFile("dump.bed");  // or (..., 5000): of this time step
        addGrains(particleHandler, rows, glass, steel);                // of type 1, of type 2
        // [end]
    }
};

TEST_F(HowDoI, LammpsGrains) {
    LammpsGrainsScene scene;
    run(scene);
    ASSERT_EQ(scene.particleHandler.getSize(), 3u);
    EXPECT_EQ(scene.particleHandler.getObject(2).getRadius(), 2e-3);
    EXPECT_EQ(scene.particleHandler.getObject(2).getSpeciesIndex(), 1);
    EXPECT_LT(scene.particleHandler.getObject(2).getVelocity().z(), -0.9);
}

}  // namespace
