#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "SelfTests/HowDoI/HowDoI.h"
#include "SelfTests/Support/RunProgram.h"

namespace {

struct OwnFieldScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();

        // [snippet]
        addOutput(ParaViewOutput().addField("distance_m", [this](std::size_t grain) {
            return particleHandler.getObject(grain).getPosition().norm();
        }));
        // [end]
    }
};

TEST_F(HowDoI, OwnField) {
    OwnFieldScene scene;
    run(scene);
    EXPECT_TRUE(contains(support::contentOf("pendular-particles-000000000.vtp"), "distance_m"));
}

}  // namespace
