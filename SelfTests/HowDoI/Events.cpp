#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct Events : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        listenToContacts();
    }
    void actionsOnContactEvent(const ContactEvent& event) override {
        if (event.kind != ContactEvent::Kind::TouchBegins) return;
        if (event.wall < 0) fmt::print("grain {} meets grain {}\n", event.particle1, event.particle2);
        else fmt::print("grain {} meets wall {}\n", event.particle1, event.wall);
    }
};
// [end]

TEST_F(HowDoI, Events) {
    WithPlate<Events> scene;
    const std::string printed = run(scene);
    EXPECT_EQ(printed, "grain 0 meets wall 1\n");
    EXPECT_EQ(scene.contactEventCounts().touchesEnded, 1u);
}

}  // namespace
