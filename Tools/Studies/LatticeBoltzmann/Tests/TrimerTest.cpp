#include "Tools/Studies/LatticeBoltzmann/Trimer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::lattice::trimerTest {
namespace {

TrimerCase smallTrimer(double volume, bool isClosed) {
    TrimerCase trimer;
    trimer.radius = 8, trimer.gap = 0.25, trimer.volume = volume, trimer.isClosed = isClosed;
    trimer.pressure = 1;
    return trimer;
}

// At rest the forces on the three spheres are balanced: to what the currents carry.
void expectBalance(const TrimerState& state) {
    EXPECT_NEAR(state.pairForce, state.otherPairForce, 0.01 * state.pairForce);
}

// Two bridges with little liquid stay apart. With more their lines come nearer on the first sphere than an
// interface is wide: one body of liquid is there, which pulls more.
TEST(LongTrimer, twoBridgesMergeWhereTheyMeet) {
    TrimerCase trimer = smallTrimer(0.05, false);
    trimer.radius = 10, trimer.gap = 0.3, trimer.wetting = 0.105;
    TwoFluids fluids = beginTrimer(trimer);
    const TensionLine line(trimer.fluid);
    pour(fluids, trimer, 0.05, 0.02, 2000);
    const TrimerState apart = measure(fluids, trimer, line);
    EXPECT_NEAR(apart.volume, 0.05, 0.2 * 0.05);
    EXPECT_EQ(apart.section, 0);
    EXPECT_FALSE(apart.isPocketFull || apart.isThirdGapFull);
    expectBalance(apart);
    pour(fluids, trimer, 0.08, 0.02, 8000);
    const TrimerState merged = measure(fluids, trimer, line);
    EXPECT_GT(merged.section, 0.1);
    EXPECT_GT(merged.pairForce, 1.1 * apart.pairForce);
    expectBalance(merged);
}

// Three bridges have the symmetry of the triangle, as far as the lattice has it.
TEST(Trimer, threeBridgesPullEachSphereAlike) {
    const TrimerCase trimer = smallTrimer(0.1, true);
    TwoFluids fluids = beginTrimer(trimer);
    EXPECT_TRUE(fluids.solidAt({0, 8 + 8, 0}) == 0);
    pour(fluids, trimer, 0.1, 0.02, 1500);
    const TrimerState state = measure(fluids, trimer, TensionLine(trimer.fluid));
    EXPECT_TRUE(state.isThirdGapFull);
    EXPECT_GT(state.section, 0);
    expectBalance(state);
}

TEST(Trimer, refusesWhatCannotBe) {
    TrimerCase trimer = smallTrimer(0.05, false);
    trimer.gap = -0.1;
    EXPECT_THROW((void)beginTrimer(trimer), InputError);
    EXPECT_THROW((void)beginTrimer(smallTrimer(0, true)), InputError);
    trimer = smallTrimer(0.05, false), trimer.radius = 3;
    EXPECT_THROW((void)beginTrimer(trimer), InputError);
}

}  // namespace
}  // namespace pendular::lattice::trimerTest
