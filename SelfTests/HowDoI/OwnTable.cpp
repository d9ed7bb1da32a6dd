#include "Kernel/Analysis/Output/RunTable.h"
#include "SelfTests/HowDoI/HowDoI.h"
#include "SelfTests/Support/RunProgram.h"

namespace {

// [snippet]
struct OwnTable : FirstDriver {
    RunTable table{"place.csv", "time_s,x_m"};

    void writeOutput() override { table.row(getTime(), particleHandler.getObject(0).getPosition().x()); }
    void completeOutput() override { table.close(); }
    void visitState(StateArchive& archive) override { table.visitState(archive); }
};
// [end]

TEST_F(HowDoI, OwnTable) {
    OwnTable scene;
    run(scene);
    EXPECT_TRUE(support::contentOf("place.csv").starts_with("time_s,x_m\n0,0.01\n"));
}

}  // namespace
