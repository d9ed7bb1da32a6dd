#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct ClumpsUnderStress : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        particleHandler.removeObject(0);
        wallHandler.clear();
        // [snippet]
        Clump rod(ClumpTemplate({{{0, 0, -0.4}, 0.5}, {{0, 0, 0.4}, 0.5}}));  // any unit: sizes scale it
        rod.setSpecies(material);
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, 0.012);
        insert(evenSizes(2e-3, 3e-3), BoxRegion({0, 0, 0}, {0.012, 0.012, 0.012}),
               Amount::solidFraction(0.45), rod);
        for (int axis = 0; axis < 3; ++axis) setTargetStress(axis, 1000, 1e-3, 20);  // Pa, s, 1/s
        setTimeStep(stabilityLimit());
        setAdaptiveTimeStep(0.9);
        // [end]
        setGravity({0, 0, 0});
        setTimeMax(0.02);
    }
};

TEST_F(HowDoI, ClumpsUnderStress) {
    ClumpsUnderStress scene;
    const double before = 0.012;
    run(scene);
    EXPECT_GT(scene.bodyHandler.getSize(), 30u);
    EXPECT_LT(scene.getPeriodicBox().length.x, before);
    EXPECT_GT(meanStress(scene).total()(0, 0), 0);
}

}  // namespace
