#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct FollowAndChoose : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getLastObject());
        Inlet inlet;
        inlet.setRegion(BoxRegion({0, 0, 0.01}, {0.02, 0.02, 0.02}));  // m
        inlet.setSizes(evenSizes(2e-3, 3e-3));                         // diameters, m
        inlet.setGrain(grain);
        inlet.setNumberFlow(1000);  // 1/s
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0.03});
        // [snippet]
        // Where no grain finds room, the region rises along z by 2 mm, 0.1 m at most.
        inlet.setFollowsFill({0, 0, 1}, 0.002, 0.1);
        outlet.setLeastAge(0.01);  // s, in the scene
        outlet.setCondition([](const GrainReference& it) { return it.getRadius() < 1.25e-3; });
        // [end]
        inletHandler.copyAndAddObject(inlet);
        outletHandler.copyAndAddObject(outlet);
        setTimeMax(0.1);
    }
};

TEST_F(HowDoI, FollowAndChoose) {
    FollowAndChoose scene;
    run(scene);
    EXPECT_GT(scene.outletHandler.removedNumber(), 20u);
    for (GrainReference grain : scene.particleHandler)
        if (grain.getPosition().z() < 0) {
            EXPECT_GE(grain.getRadius(), 1.25e-3);
        }
}

}  // namespace
