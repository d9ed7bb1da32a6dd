#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct EachStep : FirstDriver {
    double highest = 0;  // m

    void actionsAfterTimeStep() override {
        for (GrainReference grain : particleHandler.ownGrains())
            highest = std::max(highest, grain.getPosition().z());
        highest = largestOfRanks(highest);  // with mpirun; on one process it is the number itself
    }
    // What the driver remembers from step to step, for restart files.
    void visitState(StateArchive& archive) override { archive.value("highest", highest); }
};
// [end]

TEST_F(HowDoI, EachStep) {
    EachStep scene;
    run(scene);
    EXPECT_EQ(scene.highest, 0.01);
}

}  // namespace
