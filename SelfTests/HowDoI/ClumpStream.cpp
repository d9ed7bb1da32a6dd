#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct ClumpStream : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        Clump rod(ClumpTemplate({{{0, 0, -0.4}, 0.5}, {{0, 0, 0.4}, 0.5}}));  // any unit: sizes scale it
        rod.setSpecies(material);
        rod.setVelocity({0, 0, -1});  // m/s: a stream
        Inlet inlet;
        inlet.setRegion(BoxRegion({0, 0, 0.05}, {0.02, 0.02, 0.06}));  // m
        inlet.setSizes(evenSizes(2e-3, 3e-3));  // diameters of spheres of their volume, m
        inlet.setClump(rod);                    // or setBodies(mixture)
        inlet.setMassFlow(0.05);                // kg/s
        inletHandler.copyAndAddObject(inlet);
        setTimeStep(stabilityLimit());  // that of the rods to come
        // [end]
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0.03});
        outletHandler.copyAndAddObject(outlet);
        setTimeMax(0.1);
    }
};

TEST_F(HowDoI, ClumpStream) {
    ClumpStream scene;
    run(scene);
    EXPECT_GT(scene.outletHandler.removedNumber(), 50u);
    // One more is the grain of the first driver, which was below the outlet's plane.
    EXPECT_EQ(scene.inletHandler.countOf(0).number + 1,
              scene.outletHandler.removedNumber() + scene.bodyHandler.getSize());
}

}  // namespace
