#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct StepForErrorScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        // [snippet]
        setStepFor(0.01, 0.5);  // an error of 1 % of collisions at 0.5 m/s
        fmt::print("{}\n", getStepForError()->text());
        // [end]
        EXPECT_LE(getStepForError()->largest, 0.01);
    }
};

TEST_F(HowDoI, StepForError) {
    StepForErrorScene scene;
    EXPECT_TRUE(contains(run(scene), "for an error of 0.01"));
}

}  // namespace
