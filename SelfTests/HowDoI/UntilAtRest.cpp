#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct UntilAtRest : FirstDriver {
    [[nodiscard]] bool continueSolve() const override {
        if (getTime() < 0.005) return true;                         // s: they are at rest at the start, too
        return getKineticEnergy() + getRotationalEnergy() > 1e-12;  // J
    }
};
// [end]

TEST_F(HowDoI, UntilAtRest) {
    UntilAtRest scene;
    run(scene);
    EXPECT_GE(scene.getTime(), 0.01);  // it flies
    struct Resting : UntilAtRest {
        void setupInitialConditions() override {
            UntilAtRest::setupInitialConditions();
            particleHandler.getObject(0).setVelocity({0, 0, 0});
        }
    } resting;
    run(resting);
    EXPECT_NEAR(resting.getTime(), 0.005, resting.getTimeStep());
}

}  // namespace
