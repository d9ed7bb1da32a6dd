#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct ChosenIntegratorScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();

        // [snippet]
        setIntegrator(integrators::velocityVerlet);  // before stabilityLimit() is asked
        // [end]
    }
};

TEST_F(HowDoI, ChosenIntegrator) {
    ChosenIntegratorScene scene;
    run(scene);
    EXPECT_EQ(scene.getIntegrator(), integrators::velocityVerlet);
}

}  // namespace
