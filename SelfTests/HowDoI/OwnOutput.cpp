#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct LargestSpeed {
    double largest = 0;  // m/s

    [[nodiscard]] OutputInterval interval() const { return {"LargestSpeed", 0.001}; }  // s
    void write(const Scene& scene) {
        for (const TranslationRecord& grain : scene.particleHandler.store().translation)
            largest = std::max(largest, norm(grain.velocity));
    }
    void complete(const Scene& scene) { fmt::print("{}: at most {} m/s\n", scene.getName(), largest); }
    /// For restart files.
    void visitState(StateArchive& archive, const Scene&) { archive.value("largestSpeed", largest); }
};
// [end]

TEST_F(HowDoI, OwnOutput) {
    FirstDriver scene;
    scene.addOutput(LargestSpeed());
    EXPECT_EQ(run(scene), "pendular: at most 0.1 m/s\n");
}

}  // namespace
