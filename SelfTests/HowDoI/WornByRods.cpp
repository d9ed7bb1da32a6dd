#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/HowDoI/DrumFile.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct WornByRods : FirstDriver {
    TriangleWall* drum = nullptr;

    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        TriangleWall mesh;
        mesh.read("drum.stl", 1e-3);  // the file is in mm
        mesh.setSpecies(speciesHandler.getLastObject());
        mesh.keepWear(WearLaw::finnie(0.5, 1e9));  // share of the grains that cut; flow stress, Pa
        drum = wallHandler.copyAndAddObject(mesh);

        const double r = 5e-4;  // m
        Clump rod(ClumpTemplate({{{-r, 0, 0}, r}, {{0, 0, 0}, r}, {{r, 0, 0}, r}}));
        rod.setSpecies(speciesHandler.getLastObject());
        rod.setPosition({0.01, 0.02, 0.02});  // m, of its centre of mass
        rod.setVelocity({0.2, 0.05, 0});      // m/s
        bodyHandler.copyAndAddObject(rod);    // it wears by the mass of the whole rod
        setTimeStep(stabilityLimit());        // s
    }
};
// [end]

// The rod comes with its end, 0.5 mm from the plate, before the first driver's grain: Finnie's volume of its
// speeds and its whole mass.
TEST_F(HowDoI, WornByRods) {
    writeDrumFile();
    WornByRods scene;
    run(scene);
    const double first = scene.particleHandler.getObject(0).getMass(),
                 rod = scene.bodyHandler.getObject(0).getMass();
    const double volume = 0.5 / 1e9 * (finnieEnergy(first, 0.1, 0) + finnieEnergy(rod, 0.2, 0.05));
    EXPECT_GT(finnieEnergy(rod, 0.2, 0.05), 0);
    EXPECT_EQ(scene.drum->getWear().sum().impacts, 2u);
    EXPECT_NEAR(scene.drum->getWear().sum().volume / volume, 1, 1e-9);
}

}  // namespace
