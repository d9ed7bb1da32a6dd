#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct AdaptiveTimeStepScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();

        // [snippet]
        setTimeStep(stabilityLimit());  // s, the first one
        setAdaptiveTimeStep(0.9);       // of what the contacts stand
        // [end]
    }
};

TEST_F(HowDoI, AdaptiveTimeStep) {
    AdaptiveTimeStepScene scene;
    run(scene);
    EXPECT_GT(scene.adaptiveTimeStep().choiceCount(), 1u);
    EXPECT_TRUE(contains(scene.stabilityAdvice().text(), "limit of"));
}

}  // namespace
