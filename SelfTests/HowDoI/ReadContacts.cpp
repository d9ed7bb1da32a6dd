#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct ReadContacts : FirstDriver {
    void writeOutput() override {
        for (const ObservedContact& contact : interactions()) {
            if (contact.wall < 0) fmt::print("grain {} with grain {}", contact.particle1, contact.particle2);
            else fmt::print("grain {} with wall {}", contact.particle1, contact.wall);
            fmt::print(": overlap {} m, normal force {} N, of a bridge {} N\n", contact.overlap(),
                       contact.normalForce, contact.adhesiveForce);
        }
    }
};
// [end]

TEST_F(HowDoI, ReadContacts) {
    WithPlate<ReadContacts> scene;
    scene.setSaveCount(5);
    const std::string printed = run(scene);
    EXPECT_TRUE(printed.starts_with("grain 0 with wall 1: overlap ")) << printed;
}

}  // namespace
