#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct ChangeValues : FirstDriver {
    void actionsBeforeTimeStep() override {
        if (getNumberOfTimeSteps() != 500) return;
        speciesHandler.getObject(0)->setSlidingFrictionCoefficient(0.6);
        particleHandler.getObject(0).setRadius(1.1e-3);  // m; the mass follows
        setTimeStep(0.5 * getTimeStep());
    }
};
// [end]

TEST_F(HowDoI, ChangeValues) {
    ChangeValues scene;
    run(scene);
    EXPECT_NEAR(scene.getTotalMass() / sphereMass(1.1e-3, 2500), 1, 1e-12);
    EXPECT_EQ(scene.speciesHandler.mixture(0, 0).getSlidingFrictionCoefficient(), 0.6);
    FirstDriver other;
    run(other);
    EXPECT_EQ(scene.getTimeStep(), 0.5 * other.getTimeStep());
}

}  // namespace
