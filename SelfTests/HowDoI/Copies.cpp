#include "Kernel/Features/GhostImages/GrainCopies.h"

#include <algorithm>
#include <vector>

#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct Repeated : FirstDriver {
    // [snippet]
    GrainCopies& copies = addPart<GrainCopies>();
    void repeat(bool isThin, bool isWedge, bool feeds) {
        if (isThin) copies.addPeriod({0, 1, 0}, 0, 2.2e-3);                        // m
        if (isWedge) copies.addTurn({1, 0, 0}, {0, -1, 0}, {0, 0, 0});             // x > 0, y > 0
        if (feeds) copies.addMaser({1, 0, 0}, 0, 0.02, {0, 0, 0}, /*gap*/ 0.006);  // m
    }
    // [end]

    bool isThin, isWedge, feeds;
    Repeated(bool thin, bool wedge, bool feeding) : isThin(thin), isWedge(wedge), feeds(feeding) {}
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();  // a grain at (0.01, 0.01, 0.01) m, 0.1 m/s along x
        wallHandler.clear();
        repeat(isThin, isWedge, feeds);
        setTimeMax(0.15);
    }
};

TEST_F(HowDoI, Copies) {
    const auto places = [&](Repeated& scene) {
        run(scene);
        std::vector<Vec3D> found;
        for (const GrainReference grain : scene.particleHandler)
            if (!scene.copies.isCopy(grain.getId())) found.push_back(grain.getPosition());
        return found;
    };
    Repeated thin(true, false, false), turned(false, true, false), feeding(false, false, true);
    EXPECT_EQ(places(thin).size(), 1u);
    EXPECT_GT(thin.copies.numberOfCopies(), 1u);
    EXPECT_EQ(places(turned).size(), 1u);
    const std::vector<Vec3D> fed = places(feeding);  // 0.025 m is 0.005 m again, and 0.031 m in the flow
    ASSERT_EQ(fed.size(), 2u);
    EXPECT_NEAR(std::min(fed[0].x(), fed[1].x()), 0.01 + 0.1 * feeding.getTime() - 0.02, 1e-12);
    EXPECT_NEAR(std::max(fed[0].x(), fed[1].x()), 0.01 + 0.1 * feeding.getTime() + 0.006, 1e-12);
}

}  // namespace
