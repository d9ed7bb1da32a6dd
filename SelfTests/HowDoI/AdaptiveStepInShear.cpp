#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "SelfTests/HowDoI/LooseGrains.h"

namespace {

struct AdaptiveStepInShearScene : LooseGrains {
    double momentumAtStart = 0;  // kg m/s, across the flow

    void setupInitialConditions() override {
        LooseGrains::setupInitialConditions();
        // [snippet]
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, 0.01);
        setLeesEdwards(0, 1, 50);       // along x, over y, 1/s
        setTimeStep(stabilityLimit());  // s, the first one
        setAdaptiveTimeStep(0.9);       // of what the contacts stand
        // [end]
        for (auto&& grain : particleHandler) {
            const double k = grain.getId();
            grain.setVelocity(shearFlowAt(grain.getPosition()) +
                              0.1 * Vec3D(std::sin(k), std::sin(2 * k), std::sin(3 * k)));
        }
        setTimeMax(0.05);
        momentumAtStart = momentum(1);
    }
    /// kg m/s
    double momentum(int axis) {
        double sum = 0;
        for (auto&& grain : particleHandler) sum += grain.getMass() * grain.getVelocity()[axis];
        return sum;
    }
};

// Images move along x alone: momentum across the flow is kept.
TEST_F(HowDoI, AdaptiveStepInShear) {
    AdaptiveStepInShearScene scene;
    run(scene);
    const double mass = scene.particleHandler.getObject(0).getMass();
    EXPECT_GT(scene.adaptiveTimeStep().choiceCount(), 1u);
    EXPECT_NEAR(scene.momentum(1), scene.momentumAtStart, 1e-12 * mass);
}

}  // namespace
