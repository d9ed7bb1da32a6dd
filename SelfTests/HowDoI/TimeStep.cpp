#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct TimeStepScene : FirstDriver {
    int written = 0;

    void writeOutput() override { ++written; }
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();

        // [snippet]
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25));  // s
        setTimeMax(0.5);                                                      // s
        setSaveCount(static_cast<std::size_t>(0.01 / getTimeStep()));         // writeOutput() every 0.01 s
        // [end]
        setTimeMax(0.0105);
    }
};

TEST_F(HowDoI, TimeStep) {
    TimeStepScene scene;
    run(scene);
    // At the start, after 0.01 s and at the end.
    EXPECT_LE(scene.getTimeStep(), scene.stabilityLimit());
    EXPECT_EQ(scene.written, 3);
}

}  // namespace
