#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Studies/LatticeBoltzmann/Bridge.h"

namespace pendular::lattice::bridgeGatesTest {
namespace {

BridgeCase caseOf(double radius, double gap = 0.625, double volume = 0.133, double wetting = 0.1) {
    BridgeCase bridge;
    bridge.radius = radius, bridge.gap = gap, bridge.volume = volume, bridge.wetting = wetting;
    bridge.pressure = 1.4;
    return bridge;
}

// The pull on the sphere is what the fluids press on the mid plane less than on the far side. The scheme is
// not at rest: its currents have a capillary number of about 0.01.
TEST(BridgeGates, pullAsMuchAsTheyPressOnTheMidPlane) {
    const BridgeCase bridge = caseOf(8);
    TwoFluids fluids = beginBridge(bridge);
    pour(fluids, bridge, 0.02, 8000);
    const BridgeState state = measure(fluids, bridge, TensionLine(bridge.fluid));
    EXPECT_NEAR(state.volume, bridge.volume, 0.1 * bridge.volume);
    EXPECT_NEAR(state.force, state.thrust, 1e-4 * state.force);
    EXPECT_GT(state.force, 1);
    EXPECT_GT(state.capillaryNumber, 0.005);
    EXPECT_LT(state.capillaryNumber, 0.02);
}

TEST(BridgeGates, refuseWhatCannotBe) {
    EXPECT_THROW((void)beginBridge(caseOf(2)), InputError);
    EXPECT_THROW((void)beginBridge(caseOf(8, -0.1)), InputError);
    EXPECT_THROW((void)beginBridge(caseOf(8, 0.6, 0)), InputError);
    EXPECT_THROW((void)beginBridge(caseOf(8, 0.6, 0.1, 1)), InputError);
}

}  // namespace
}  // namespace pendular::lattice::bridgeGatesTest
