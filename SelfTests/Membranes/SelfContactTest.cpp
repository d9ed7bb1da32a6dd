// A membrane does not touch itself: where it would, that is said.
#include <gtest/gtest.h>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Membranes/MembraneScene.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::selfContactTest {
namespace {

using namespace membraneTests;

/// Two sheets of one net, the upper one tilted and turned, its lowest corner at this height (m).
std::vector<Triangle> twoSheets(double height) {
    std::vector<Triangle> all = membraneSheet(6, 6, edge);
    for (Triangle triangle : membraneSheet(6, 6, edge)) {
        for (Vector<double>& p : triangle)
            p = {0.3 * edge + p.x - 0.1 * p.y, 0.2 * edge + p.y + 0.1 * p.x, height + 0.2 * p.x};
        all.push_back(triangle);
    }
    return all;
}

TEST(MembraneSelfContact, isRefusedAtSetUp) {
    Membrane sheet;
    const std::string refused = support::refusal([&] { sheet.set(twoSheets(-1e-4), rubber); });
    EXPECT_TRUE(support::isOneSentence(refused)) << refused;
    EXPECT_TRUE(support::contains(refused, "goes through itself")) << refused;
    EXPECT_NO_THROW(sheet.set(twoSheets(1e-4), rubber));
}

// The upper sheet comes down at 1 m/s over 1 mm. It is looked for when vertices may have come a quarter of an
// edge nearer to each other, supposed that both move: so after an eighth of an edge, 0.25 mm, at the latest.
TEST(MembraneSelfContact, endsTheRun) {
    MembraneScene scene({});
    Membrane* const sheets = scene.add(twoSheets(1e-3));
    sheets->hold([](const Vec3D& x) { return x.z() < 5e-4; });
    sheets->hold([](const Vec3D& x) { return x.z() > 5e-4; }, {0, 0, -1});
    scene.initialise();
    try {
        scene.steps(200);
        FAIL() << "one went through the other";
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what())) << error.what();
        EXPECT_TRUE(support::contains(error.what(), "wall 0, a membrane, goes through itself"))
            << error.what();
    }
    EXPECT_GE(scene.getTime(), 1e-3 - 2e-5);
    EXPECT_LE(scene.getTime(), 1e-3 + 0.25 * 0.5 * edge + 2e-5);
}

// Neighbours meet at edges and corners, however the sheet is bent.
TEST(MembraneSelfContact, isNoneOfNeighbours) {
    for (const double bend : {0.0, 20.0, 150.0}) {  // 1/m, the curvature: up to a third of a turn
        std::vector<Triangle> sheet = membraneSheet(6, 6, edge);
        for (Triangle& triangle : sheet)
            for (Vector<double>& p : triangle)
                if (bend > 0) p = {std::sin(bend * p.x) / bend, p.y, (1 - std::cos(bend * p.x)) / bend};
        Membrane wall;
        EXPECT_NO_THROW(wall.set(sheet, rubber)) << bend;
    }
    Membrane tube;
    EXPECT_NO_THROW(tube.set(membraneTube(5e-3, 2e-2, 16), rubber));
}

}  // namespace
}  // namespace pendular::selfContactTest
