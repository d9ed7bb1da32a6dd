#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "SelfTests/HowDoI/HowDoI.h"
#include "SelfTests/Support/RunProgram.h"

namespace {

// [snippet]
struct OwnValues : FirstDriver {
    GrainColumnReference film = particleHandler.addColumn("film_volume", "m3", 1e-12);

    void actionsAfterTimeStep() override {
        for (GrainReference grain : particleHandler.ownGrains())
            film[grain.getId()] -= 5e-11 * getTimeStep();  // it dries
    }
};
// [end]

TEST_F(HowDoI, OwnValues) {
    OwnValues scene;
    scene.addOutput(ParaViewOutput());
    run(scene);
    EXPECT_NEAR(scene.film[0] / (1e-12 - 5e-11 * scene.getTime()), 1, 1e-9);
    EXPECT_TRUE(contains(support::contentOf("pendular-particles-000000000.vtp"), "film_volume_m3"));
}

}  // namespace
