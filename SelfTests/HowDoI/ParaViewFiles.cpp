#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct ParaViewFilesScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();

        std::filesystem::create_directory("results");
        // [snippet]
        setName("results/run");  // the folder must exist
        addOutput(ParaViewOutput().withInterval(0.01).withContacts(false).withStress());
        // [end]
    }
};

TEST_F(HowDoI, ParaViewFiles) {
    ParaViewFilesScene scene;
    run(scene);
    EXPECT_TRUE(std::filesystem::exists("results/run.pvd"));
}

}  // namespace
