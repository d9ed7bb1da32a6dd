#include "Tools/Studies/LatticeBoltzmann/Pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Studies/LatticeBoltzmann/Bridge.h"

namespace pendular::lattice::pairTest {
namespace {

PairCase smallPair(double room = 0) {
    PairCase pair;
    pair.radius = {6, 6}, pair.gap = 4, pair.volume = 150, pair.room = room, pair.pressure = 1.4;
    return pair;
}

// A sphere that goes on by whole nodes has the nodes that one has which begins there; each component keeps
// its mass to rounding, though nodes go from one side of it to the other.
TEST(MovingSolids, areWhereTheyAreAndKeepMass) {
    const auto solidAt = [](double height) {
        std::vector<Solid> solids{sphere({0, 0, height}, 6, 0.1)};
        solids[0].velocity = {0, 0, 0.02};
        return solids;
    };
    const Box box{{12, 12, 30}, {Sides::Mirrored, Sides::Mirrored, Sides::Mirrored}};
    const auto drop = [](const Vector<double>& place) { return phaseAt(std::hypot(place.x, place.y) - 5); };
    TwoFluids moved(box, solidAt(12), {}, drop);
    const TwoFluids other(box, solidAt(15), {}, drop);
    const Densities before = moved.mass();
    for (int k = 1; k <= 30; ++k) {
        moved.moveSolids(solidAt(12 + 0.1 * k), before);
        for (std::size_t c = 0; c < 2; ++c) ASSERT_NEAR(moved.mass()[c] / before[c], 1, 1e-12) << k;
        moved.steps(5);
    }
    moved.grid().forEachNode([&](const Node& node) { ASSERT_EQ(moved.solidAt(node), other.solidAt(node)); });
    EXPECT_THROW(moved.moveSolids({}, before), InputError);
    EXPECT_THROW(moved.moveSolids({sphere({0, 0, 15}, 0, 0)}, before),
                 InputError);  // it uncovers all at once
}

// Between equal spheres it is the bridge of which an eighth is computed elsewhere: the same nodes, but for
// the width of the box.
TEST(Pair, ofEqualSpheresIsABridge) {
    PairCase pair = smallPair();
    TwoFluids fluids = beginPair(pair);
    pour(fluids, pair, 0.01, 5000);
    const PairState state = measure(fluids, pair, TensionLine(pair.fluid));
    EXPECT_NEAR(state.force[0], state.force[1], 1e-6 * state.force[0]);
    EXPECT_NEAR(state.volume, pair.volume, 0.2 * pair.volume);  // so few nodes still dissolve
    BridgeCase bridge;
    bridge.radius = 6, bridge.gap = 4.0 / 6, bridge.pressure = 1.4,
    bridge.volume = 150 / (4 * std::numbers::pi / 3 * 216);
    TwoFluids eighth = beginBridge(bridge);
    pour(eighth, bridge, 0.01, 5000);
    const BridgeState same = measure(eighth, bridge, TensionLine(bridge.fluid));
    EXPECT_NEAR(state.force[0] / (state.tension * 6), same.force, 0.03 * same.force);
}

// The middle of equal spheres that part is a mirror plane: each has half, and what breaks is the whole.
TEST(Pair, equalSpheresPartWithHalfOfTheLiquidEach) {
    const PairCase pair = smallPair(14);
    TwoFluids fluids = beginPair(pair);
    pour(fluids, pair, 0.02, 2000);
    std::size_t rows = 0;
    double farthest = 0;
    const PartingEnd end =
        part(fluids, pair, {.speed = 0.02}, TensionLine(pair.fluid), [&](const PartingRow& row) {
            ++rows, farthest = row.gap;
            EXPECT_NEAR(row.force[0], row.force[1], 0.02 * std::abs(row.force[0]) + 0.02);
        });
    EXPECT_GT(rows, 10U);
    ASSERT_TRUE(std::isfinite(end.gap)) << farthest;
    EXPECT_NEAR(end.share[0], 0.5, 0.03);  // the slice that is empty is a node high
    EXPECT_NEAR(end.share[0] + end.share[1], 1, 1e-12);
    EXPECT_GT(end.gap, pair.gap + 1);
}

// The better wetted one keeps more.
TEST(Pair, theBetterWettedSphereKeepsMore) {
    PairCase pair = smallPair(9);
    pair.wetting = {0.12, 0.02};
    TwoFluids fluids = beginPair(pair);
    pour(fluids, pair, 0.02, 2000);
    const PartingEnd end =
        part(fluids, pair, {.speed = 0.01}, TensionLine(pair.fluid), [](const PartingRow&) {});
    ASSERT_TRUE(std::isfinite(end.gap));
    EXPECT_GT(end.share[0], 0.6);
}

TEST(Pair, refusesWhatCannotBe) {
    PairCase pair = smallPair();
    pair.radius[1] = 1;
    EXPECT_THROW((void)beginPair(pair), InputError);
    pair = smallPair(), pair.volume = 0;
    EXPECT_THROW((void)beginPair(pair), InputError);
    pair = smallPair(), pair.wetting[0] = 2;
    EXPECT_THROW((void)beginPair(pair), InputError);
}

}  // namespace
}  // namespace pendular::lattice::pairTest
