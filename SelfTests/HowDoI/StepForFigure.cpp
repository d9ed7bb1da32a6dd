#include "Kernel/Scene/TimeStep/SoftestModulus.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct StepForFigureScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        // [snippet]
        setStepFor(WantedFigure::SolidFraction, 0.02);  // an error of 2 %
        fmt::print("{}\n", getStepForFigure()->text());
        // [end]
        EXPECT_LE(getStepForFigure()->measured, 0.02);
    }
};

TEST_F(HowDoI, StepForFigure) {
    StepForFigureScene scene;
    EXPECT_TRUE(contains(run(scene), "for solid-fraction to 0.02"));
}

}  // namespace
