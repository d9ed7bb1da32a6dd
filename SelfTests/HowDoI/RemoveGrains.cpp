#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct RemoveGrains : FirstDriver {
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 100 != 0) return;
        gather();  // with mpirun: all ranks have all particles, and remove the same ones
        std::vector<std::uint32_t> gone;
        for (GrainReference grain : particleHandler)
            if (grain.getPosition().x() > 0.0105) gone.push_back(grain.getId());
        for (const std::uint32_t identity : gone) particleHandler.removeObject(identity);
    }
};
// [end]

TEST_F(HowDoI, RemoveGrains) {
    RemoveGrains scene;
    run(scene);
    EXPECT_EQ(scene.particleHandler.getSize(), 0u);
}

}  // namespace
