#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/LedgerError.h"

// Beds on a floor that shakes: grains of two sizes, six walls, thousands of touches that begin, slide and
// end. However many steps, what the floor has given is found again, to round-off.

namespace pendular::bedTest {
namespace {

using Dry = Species<HertzianViscoelastic, Mindlin>;
using Linear = Species<LinearViscoelastic, SlidingFriction>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

/// 112 grains on a floor that is shaken at 50 Hz with twice the acceleration of gravity.
template <class S>
struct ShakenBed : scenes::SettlingBox<S> {
    explicit ShakenBed(bool ledger = true) : scenes::SettlingBox<S>(7) {
        const double frequency = 2 * std::numbers::pi * 50, way = 2 * 9.81 / (frequency * frequency);
        dynamic_cast<RigidWall&>(this->wallHandler.getObject(5)).setMotion([=](double time) {
            return Eigen::Isometry3d(Eigen::Translation3d(0, 0, way * (1 - std::cos(frequency * time))));
        });
        this->keepEnergyLedger(ledger);
        this->initialise();
    }
};

// Each step rounds each number of the account, and the motion of each grain, by up to 2^-53 of it; the signs
// are at random. After N steps that is sqrt(N) 2^-53 of all that was turned over, five times of which the
// account must never exceed.
template <class S>
void expectCloses(int steps) {
    ShakenBed<S> bed;
    const EnergyLedger& ledger = bed.energyLedger();
    const double start = ledger.closed();
    const auto drift = [&](int n) {
        return std::abs(ledger.closed() - start) / (std::sqrt(n) * 0x1p-53 * support::turnedOver(ledger));
    };
    double largest = 0;
    for (int n = 1; n <= steps; ++n) {
        bed.step();
        if (n % 1000 == 0) largest = std::max(largest, drift(n));
    }
    EXPECT_LT(largest, 5);
    testing::Test::RecordProperty("drift over that of round-off", std::to_string(largest));
    // Most of what the floor has given has been lost, and little in the steps. These two shares are no
    // theory: they say only that the error of the steps is not what is lost. A mechanism is at work where it
    // has lost more than round-off can make of all that was turned over.
    EXPECT_GT(ledger.lost(), 0.9 * (ledger.walls + start - ledger.kinetic - ledger.potential));
    EXPECT_LT(std::abs(ledger.stepError), 0.01 * ledger.lost());
    for (const double lost : {ledger.normalDashpots, ledger.sliding})
        EXPECT_GT(lost, support::roundOff(ledger, steps));
    if constexpr (S::Adhesion::acts) {
        EXPECT_GT(ledger.brokenAdhesion, 0);
    }
}

template <class S>
class HeavyBedLedger : public testing::Test {};
template <class S>
class LongBedLedger : public testing::Test {};
using Beds = testing::Types<Dry, Linear, Wet>;
TYPED_TEST_SUITE(HeavyBedLedger, Beds);
TYPED_TEST_SUITE(LongBedLedger, Beds);

TYPED_TEST(HeavyBedLedger, closesOverAHundredThousandSteps) { expectCloses<TypeParam>(100000); }
TYPED_TEST(LongBedLedger, closesOverAMillionSteps) { expectCloses<TypeParam>(1000000); }

// The bits are the same for any number of threads; a ledger changes no bit of the motion. Three threads come
// when grains slide, for a few steps: where they are more than the processors, they wait for each other long.
TEST(BedLedger, doesNotDependOnThreadsAndChangesNothing) {
    ShakenBed<Dry> one, three, without(false);
    const auto step = [&](int steps) {
        for (int k = 0; k < steps; ++k) one.step(), three.step(), without.step();
    };
    step(1700);
    const double slid = one.energyLedger().sliding;
    EXPECT_GT(slid, 0);
    three.setNumberOfThreads(3);
    step(300);
    EXPECT_EQ(stateHash(one.particleHandler.store()), stateHash(without.particleHandler.store()));
    for (const auto& entry : EnergyLedger::entries())
        EXPECT_EQ(one.energyLedger().*entry.member, three.energyLedger().*entry.member) << entry.name;
    EXPECT_GT(one.energyLedger().sliding, slid);
}

}  // namespace
}  // namespace pendular::bedTest
