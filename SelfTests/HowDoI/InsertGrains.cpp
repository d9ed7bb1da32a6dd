#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct InsertGrains : FirstDriver {
    void actionsBeforeTimeStep() override {
        if (getNumberOfTimeSteps() % 500 != 499) return;  // the step says when, so a restarted run agrees
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(1e-3), grain.setPosition({0.01, 0.01, 0.03});  // m
        grain.setVelocity({0, 0, -1});                                 // m/s: gone before the next one comes
        particleHandler.copyAndAddObject(grain);
    }
};
// [end]

TEST_F(HowDoI, InsertGrains) {
    InsertGrains scene;
    run(scene);
    EXPECT_EQ(scene.particleHandler.getSize(), 1 + (scene.getNumberOfTimeSteps()) / 500);
    EXPECT_GT(scene.particleHandler.getSize(), 3u);
}

}  // namespace
