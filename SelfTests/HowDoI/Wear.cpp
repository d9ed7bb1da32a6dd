#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/HowDoI/DrumFile.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct WornDrum : FirstDriver {
    TriangleWall* drum = nullptr;

    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        TriangleWall mesh;
        mesh.read("drum.stl", 1e-3);  // the file is in mm
        mesh.setSpecies(speciesHandler.getLastObject());
        mesh.keepWear(WearLaw::archard(1e-3, 1e9));  // K, and the hardness H of the wall, Pa
        drum = wallHandler.copyAndAddObject(mesh);
    }
    void writeOutput() override {
        const SurfaceWear wear = drum->getWear().sum();  // of(number): of one triangle
        fmt::print("{} m^3 by {} J, {} impacts\n", wear.volume, wear.slidingWork, wear.impacts);
    }
};
// [end]

TEST_F(HowDoI, Wear) {
    writeDrumFile();
    WornDrum scene;
    // The plate of the file is at x = 0.0115 m: the grain meets it once, and does not slide.
    EXPECT_TRUE(contains(run(scene), "0 m^3 by 0 J, 1 impacts\n"));
    const double speed = 0.1, mass = scene.particleHandler.getObject(0).getMass();
    EXPECT_NEAR(scene.drum->getWear().sum().impactWork, 0.5 * mass * speed * speed, 1e-12 * mass);
}

}  // namespace
