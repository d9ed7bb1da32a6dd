#include "Kernel/Analysis/Observables/MeanStress.h"
#include "SelfTests/HowDoI/LooseGrains.h"

namespace {

struct StrainedScene : LooseGrains {
    void setupInitialConditions() override {
        LooseGrains::setupInitialConditions();
        // [snippet]
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, 0.01);
        setTargetStress(0, 100, 1e-3, 20);  // along x: Pa, s, 1/s
        setTargetStress(1, 100, 1e-3, 20);
        setStrainRate(2, -1);  // along z, 1/s: it gets shorter
        // [end]
        setTimeMax(0.05);
    }
};

TEST_F(HowDoI, Strain) {
    StrainedScene scene;
    run(scene);
    // 0.05 s, and at most a step more.
    EXPECT_NEAR(scene.getPeriodicBox().length.z, 0.01 * std::exp(-0.05), 0.01 * scene.getTimeStep());
    EXPECT_LT(scene.getPeriodicBox().length.x, 0.01);
    EXPECT_GT(meanStress(scene).total()(0, 0), 0);
}

}  // namespace
