#include <gtest/gtest.h>

#include <array>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Periodic/ObliquePair.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::faceTest {
namespace {

using scenes::boxMaterial;
using scenes::FewGrains;
using scenes::GrainMotion;

using Smooth = Species<LinearViscoelastic>;
using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

constexpr double r = 1e-3;          // m
constexpr double length = 0x1p-6;   // m, of the period
constexpr double step = 0x1p-20;    // s, some 400 in a contact
constexpr int steps = 1500;         // until the bridge has ruptured
const Vec3D drift{0.9, -0.8, 0.7};  // m/s, of both grains: they pass the face while they touch or are bridged
const Vec3D middle = Vec3D::Constant(0.5 * length);

/// Two grains that meet obliquely at a place.
template <class S>
class OnePair : public FewGrains<S> {
public:
    OnePair(const Vec3D& place, int periodicAxes)
        : FewGrains<S>(boxMaterial<S>(0), periodic::obliquePair(place, drift), step) {
        for (int axis = 0; axis < 3; ++axis)
            if ((periodicAxes >> axis & 1) != 0) this->setPeriodic(axis, 0, length);
    }

    /// Whether grains touch, are joined by a stretched bridge, and have gone over to the other side of the
    /// scene in this state.
    bool touched = false, stretched = false, wrappedTouching = false, wrappedStretched = false;

    void run() {
        this->initialise();
        for (int k = 0; k < steps; ++k) {
            const std::array<Vec3D, 2> before{this->motion(0).position, this->motion(1).position};
            this->step();
            bool wrapped = false;
            for (std::size_t g : {0, 1})
                wrapped |= (this->motion(g).position - before[g]).cwiseAbs().maxCoeff() > 0.5 * length;
            this->contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
                const auto seen = this->contacts().observe(this->particleHandler.store(), bucket, contact);
                const bool touching = seen.separation < 0, apart = seen.bridged && !touching;
                touched |= touching;
                stretched |= apart;
                wrappedTouching |= touching && wrapped;
                wrappedStretched |= apart && wrapped;
                last = seen;
            });
        }
    }
    [[nodiscard]] bool bridgeAtTheEnd() const { return last.bridged; }

private:
    ObservedContact last{};
};

template <class S>
class PeriodicFace : public testing::Test {};
using SpeciesOfAllKinds = testing::Types<Smooth, Dry, Wet>;
TYPED_TEST_SUITE(PeriodicFace, SpeciesOfAllKinds);

// Positions are rounded to 2^-60 m in each step: 1500 steps and both grains make 2.6e-15 m of the overlap. A
// spring with k = m (pi / t_c)^2 turns that, over the contact time t_c = 4e-4 s, into pi^2 / t_c of it as a
// speed: 6.4e-11 m/s. Dashpot, tangential spring and bridge are not stiffer: four times that.
constexpr double speedTolerance = 2.6e-10;  // m/s
constexpr double spinTolerance =
    2.5 / (0.8 * r) * speedTolerance;                             // rad/s: a force's lever arm and r^2 m 2/5
constexpr double placeTolerance = speedTolerance * steps * step;  // m

template <class S>
void expectSameMotion(OnePair<S>& found, OnePair<S>& expected, const Vec3D& shift) {
    const PeriodicBox box{{0, 0, 0}, {length, length, length}};
    for (std::size_t g : {0, 1}) {
        const GrainMotion a = found.motion(g), b = expected.motion(g);
        EXPECT_LT((a.velocity - b.velocity).norm(), speedTolerance);
        EXPECT_LT((a.spin - b.spin).norm(), spinTolerance);
        EXPECT_LT(norm(box.nearest(toVector(Vec3D(a.position - b.position - shift)))), placeTolerance);
    }
}

/// Faces (one axis), edges (two) and corners (three) of the scene; the pair meets there, or a radius before
/// or behind.
TYPED_TEST(PeriodicFace, aCollisionAcrossItIsThatInTheMiddle) {
    int wrappedTouching = 0, wrappedStretched = 0;
    OnePair<TypeParam> expected(middle, 0);
    expected.run();
    ASSERT_TRUE(expected.touched);
    ASSERT_EQ(expected.stretched, TypeParam::Adhesion::acts);
    ASSERT_FALSE(expected.bridgeAtTheEnd());
    ASSERT_GT((expected.motion(0).velocity - drift).norm(), 0.1);
    for (int axes = 1; axes < 8; ++axes)
        for (int offset = -4; offset <= 4; ++offset) {
            SCOPED_TRACE(fmt::format("axes {:03b}, offset {}", axes, offset));
            Vec3D shift = Vec3D::Zero();
            for (int axis = 0; axis < 3; ++axis)
                if ((axes >> axis & 1) != 0) shift[axis] = 0.5 * length + 0.25 * offset * r;
            OnePair<TypeParam> scene(middle + shift, axes);
            scene.run();
            EXPECT_TRUE(scene.touched);
            expectSameMotion(scene, expected, shift);
            wrappedTouching += scene.wrappedTouching ? 1 : 0;
            wrappedStretched += scene.wrappedStretched ? 1 : 0;
        }
    EXPECT_GT(wrappedTouching, 5);
    if (TypeParam::Adhesion::acts) {
        EXPECT_GT(wrappedStretched, 5);
    }
}

TYPED_TEST(PeriodicFace, momentumAndEnergyPassIt) {
    // What both grains have together is that of the free pair; the ledger's sum too.
    OnePair<TypeParam> scene(middle + Vec3D::Constant(0.5 * length), 7), expected(middle, 0);
    for (auto* pair : {&scene, &expected}) {
        pair->keepEnergyLedger();
        pair->run();
    }
    const double mass = scene.particleHandler.getObject(0).getMass();
    EXPECT_LT((scene.linearMomentum() - expected.linearMomentum()).norm(), mass * speedTolerance);
    const EnergyLedger &a = scene.energyLedger(), &b = expected.energyLedger();
    const double tolerance = 2 * mass * drift.norm() * speedTolerance;
    for (const auto& entry : EnergyLedger::entries())
        EXPECT_NEAR(a.*entry.member, b.*entry.member, tolerance) << entry.name;
    EXPECT_GT(a.normalDashpots, 0);
}

template <class S>
std::string refusalOfPeriod(double period, int axis, const std::vector<GrainMotion>& grains) {
    FewGrains<S> scene(boxMaterial<S>(0), grains, 1e-7);
    scene.setPeriodic(axis, -0.25 * period, 0.75 * period);
    return support::refusal([&] { scene.initialise(); });
}

TYPED_TEST(PeriodicFace, aPeriodInWhichAGrainCouldMeetTwoImagesIsRefused) {
    const std::vector<GrainMotion> alone{{.radius = 1.5 * r}},
        two{{.radius = 0.1 * r, .position = {5e-3, 5e-3, 5e-3}}, {.radius = 1.5 * r}};
    // A grain alone still meets its own images.
    double reach = 2 * 1.5 * r;
    if constexpr (TypeParam::Adhesion::acts) reach += boxMaterial<TypeParam>(0).range({1.5 * r, 1.5 * r});
    for (const auto& grains : {alone, two})
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(refusalOfPeriod<TypeParam>(2.0001 * reach, axis, grains), "");
            const std::string text = refusalOfPeriod<TypeParam>(1.9999 * reach, axis, grains);
            EXPECT_TRUE(support::isOneSentence(text));
            EXPECT_TRUE(support::contains(text, fmt::format("periodic length along {}", "xyz"[axis])));
            EXPECT_TRUE(support::contains(text, fmt::format("{:.6g} m is too short", 1.9999 * reach)));
            EXPECT_TRUE(support::contains(text, fmt::format("at least {:.6g} m", 2 * reach)));
        }
    EXPECT_EQ(refusalOfPeriod<TypeParam>(r, 0, {}), "");  // nothing that could meet
}

TEST(PeriodicLength, hasToBeALength) {
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {}, 1e-6);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (double highest : {0.0, -1.0, nan, infinity, -infinity}) {
        const std::string text = support::refusal([&] { scene.setPeriodic(1, 0, highest); });
        EXPECT_TRUE(support::isOneSentence(text));
        EXPECT_TRUE(support::contains(text, "periodic length"));
    }
    for (int axis : {-1, 3}) EXPECT_NE(support::refusal([&] { scene.setPeriodic(axis, 0, 1); }), "");
}

}  // namespace
}  // namespace pendular::faceTest
