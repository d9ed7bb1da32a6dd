#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct ReadGrains : FirstDriver {
    void writeOutput() override {
        const auto grain = particleHandler.getObject(0);
        const Vec3D position = grain.getPosition();  // m
        const Vec3D force = grain.getForce();        // N, of the last step, weight included
        fmt::print("{:.4f} s: at x = {} m, {} m/s, force {} N, spin {} rad/s\n", getTime(), position.x(),
                   grain.getVelocity().norm(), force.norm(), grain.getAngularVelocity().norm());
    }
};
// [end]

TEST_F(HowDoI, ReadGrains) {
    ReadGrains scene;
    const std::string printed = run(scene);
    EXPECT_TRUE(printed.starts_with("0.0000 s: at x = 0.01 m, 0.1 m/s, force 0 N")) << printed;
    EXPECT_TRUE(contains(printed, "0.0100 s")) << printed;
}

}  // namespace
