#include "Kernel/Analysis/Observables/MeanStress.h"
#include "SelfTests/HowDoI/LooseGrains.h"

namespace {

struct PressedShearScene : LooseGrains {
    void setupInitialConditions() override {
        LooseGrains::setupInitialConditions();
        // [snippet]
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, 0.01);
        setLeesEdwards(0, 1, 50);           // along x, over y, 1/s
        setTargetStress(1, 100, 1e-3, 20);  // along y: Pa, s, 1/s
        for (auto&& grain : particleHandler) grain.setVelocity(shearFlowAt(grain.getPosition()));
        // [end]
        setTimeMax(0.1);
    }
};

TEST_F(HowDoI, ShearUnderPressure) {
    PressedShearScene scene;
    run(scene);
    const PeriodicBox& box = scene.getPeriodicBox();
    EXPECT_EQ(box.length.x, 0.01);
    EXPECT_LT(box.length.y, 0.009);
    EXPECT_EQ(box.length.z, 0.01);
    EXPECT_NEAR(box.imageVelocity.x, 50 * box.length.y, 1e-3);
}

}  // namespace
