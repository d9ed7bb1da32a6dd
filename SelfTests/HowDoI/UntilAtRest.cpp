#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct UntilAtRest : FirstDriver {
    [[nodiscard]] bool continueSolve() const override {
        const double energy = getKineticEnergy() + getRotationalEnergy();  // J
        return getTime() < 0.005 || energy > 1e-12;  // in the first 5 ms they may be at rest, too
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
