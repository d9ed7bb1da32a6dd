#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct HooksOnRanks : FirstDriver {
    double mean = 0, fastest = 0;  // m, m/s

    void actionsAfterTimeStep() override {
        // Changes of each particle by itself: by the rank that owns it.
        for (GrainReference grain : particleHandler.ownGrains())
            grain.setVelocity(0.999 * grain.getVelocity());
        // Sums, counts and maxima over all ranks: all ranks must make these calls.
        const double heights =
            sumOverGrains(*this, [](const GrainReference& grain) { return grain.getPosition().z(); });
        mean = heights / static_cast<double>(particleHandler.getSize());
        const double touching = sumOverInteractions(
            *this, [](const ObservedContact& contact) { return contact.touching ? 1.0 : 0.0; });
        if (touching > 0 && getNumberOfTimeSteps() % 1000 == 0) {
            gather();  // all particles and contacts come to each rank, until the next step
            for (const GrainReference grain : particleHandler)
                fastest = std::max(fastest, grain.getVelocity().norm());
        }
    }
};
// [end]

TEST_F(HowDoI, HooksOnRanks) {
    WithPlate<HooksOnRanks> scene;
    run(scene);
    EXPECT_EQ(scene.mean, scene.particleHandler.getObject(0).getPosition().z());
}

}  // namespace
