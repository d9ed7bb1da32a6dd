#include "Kernel/Analysis/Output/GrainFlowFiles.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct InAndOut : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getLastObject());
        grain.setVelocity({0, 0, -1});  // m/s: a stream
        Inlet inlet;
        inlet.setRegion(BoxRegion({0, 0, 0.05}, {0.02, 0.02, 0.06}));  // m
        inlet.setSizes(evenSizes(2e-3, 3e-3));                         // diameters, m
        inlet.setGrain(grain);
        inlet.setMassFlow(0.05);         // kg/s
        inlet.setNoRoom(NoRoom::Later);  // or Lost
        inletHandler.copyAndAddObject(inlet);
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0.03});  // what is below it goes
        outlet.setSizeClasses(std::array{2.5e-3});  // counted in two classes of diameters
        outletHandler.copyAndAddObject(outlet);
        fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 0.04}});              // normal, point
        addOutput(OutletFile(0.01)), addOutput(FluxFile(0.01)), addOutput(InletFile(0.01));  // CSV tables
        setTimeMax(0.1);
    }
};
// [end]

TEST_F(HowDoI, InAndOut) {
    InAndOut scene;
    run(scene);
    EXPECT_GT(scene.outletHandler.removedNumber(), 50u);
    // One more is the grain of the first driver, which was below the outlet's plane.
    EXPECT_EQ(scene.inletHandler.countOf(0).number + 1,
              scene.outletHandler.removedNumber() + scene.particleHandler.getSize());
    EXPECT_GT(scene.fluxPlaneHandler.countOf(0).net(), 50);
}

}  // namespace
