#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct ContactsOfGrain : FirstDriver {
    void writeOutput() override {
        const std::size_t identity = 0;
        fmt::print("{} contacts, {} N\n", interactionsOf(identity).size(), contactForceOn(identity).norm());
    }
};
// [end]

TEST_F(HowDoI, ContactsOfGrain) {
    WithPlate<ContactsOfGrain> scene;
    scene.setSaveCount(5);
    const std::string printed = run(scene);
    EXPECT_TRUE(printed.starts_with("0 contacts, 0 N\n")) << printed;
    EXPECT_TRUE(contains(printed, "1 contacts, ")) << printed;
}

}  // namespace
