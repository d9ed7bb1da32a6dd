#include "Kernel/Analysis/Observables/MeanStress.h"
#include "SelfTests/HowDoI/LooseGrains.h"

namespace {

struct ShearedScene : LooseGrains {
    void setupInitialConditions() override {
        LooseGrains::setupInitialConditions();
        // [snippet]
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, 0.01);
        setLeesEdwards(0, 1, 50);  // along x, over y, 1/s
        for (auto&& grain : particleHandler) grain.setVelocity(shearFlowAt(grain.getPosition()));
        // [end]
        for (auto&& grain : particleHandler) {
            const double k = grain.getId();
            grain.setVelocity(grain.getVelocity() +
                              0.1 * Vec3D(std::sin(k), std::sin(2 * k), std::sin(3 * k)));
        }
        setTimeMax(0.05);
    }
    double friction() {
        const MeanStress stress = meanStress(*this);
        return -stress.total()(0, 1) / stress.pressure();
    }
};

TEST_F(HowDoI, Shear) {
    ShearedScene scene;
    run(scene);
    EXPECT_GT(scene.friction(), 0);
    EXPECT_LT(scene.friction(), 2);
}

}  // namespace
