#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct ContactAge : FirstDriver {
    ContactColumnReference age = addContactColumn("age", "s");
    double longest = 0;  // s

    void actionsAfterTimeStep() override {
        for (const ObservedContact& contact : ownInteractions()) {
            age[contact] += getTimeStep();
            longest = std::max(longest, age[contact]);
        }
        longest = largestOfRanks(longest);  // with mpirun
    }
};
// [end]

TEST_F(HowDoI, ContactAge) {
    WithPlate<ContactAge> scene;
    run(scene);
    // The advice is the time of the fastest contact; slower ones last longer, this one some two times.
    EXPECT_GT(scene.longest, scene.shortestContactTime());
    EXPECT_LT(scene.longest, 0.005);
}

}  // namespace
