// Shear whose rate changes, shear together with strain, and shear under stresses.
#include <gtest/gtest.h>

#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/ShearAndStrain/LeesEdwards.h"
#include "Kernel/Features/ShearAndStrain/StressServo.h"
#include "SelfTests/Periodic/Lattice.h"
#include "SelfTests/Periodic/MovingImages.h"
#include "SelfTests/Periodic/ObliquePair.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/ShearOf.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::shearControlTest {
namespace {

using periodic::againstFlow;
using periodic::Dry;
using periodic::Lattice;
using periodic::linear;
using periodic::Smooth;
using periodic::Wet;
using scenes::boxMaterial;
using scenes::FewGrains;
using scenes::GrainMotion;
using scenes::ShearedCloud;

constexpr double side = 0x1p-6;         // m
constexpr double stepLength = 0x1p-20;  // s

/// Without contacts C_y L_y stays, and C_x changes by -rate C_y: with the strain e along y and from the shear
/// rate g on, by -g C_y0 (1 - exp(-e t)) / e; a change of the rates changes neither, also of a grain that has
/// gone round. Rates are constant over a step but for a share e h: an error of the first order.
TEST(ShearControl, aFreeGrainMovesAsInTheClosedForm) {
    const Vec3D speed(3, -2, 1);
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.position = {0.001, 0.002, 0.003}, .velocity = speed}},
                            stepLength);
    periodic::repeatAlongAllAxes(scene, side);
    scene.setLeesEdwards(0, 1, 5);
    scene.setStrainRate(1, 0);
    scene.initialise();
    const Vec3D first = againstFlow(scene, scene.motion(0));
    const double h = 20000 * stepLength, e = -8;  // s, 1/s
    scene.step(20000);
    Vec3D expected = first - Vec3D(5 * first.y() * h, 0, 0);
    EXPECT_LT((againstFlow(scene, scene.motion(0)) - expected).norm(), 1e-10);
    scene.setShearRate(-30);
    scene.setStrainRate(1, e);
    scene.step(20000);
    expected.x() += 30 * first.y() * (std::exp(-e * h) - 1) / -e;
    expected.y() *= std::exp(-e * h);
    EXPECT_LT((againstFlow(scene, scene.motion(0)) - expected).norm(), 30 * 2 * h * std::abs(e) * stepLength);
    EXPECT_EQ(scene.getShearRate(), -30);
    EXPECT_NEAR(scene.getPeriodicBox().length.y / side, std::exp(e * h), 1e-11);
}

/// Two grains that meet obliquely at a place of a shear with strain, while the shear rate is changed.
template <class S>
class PairInBoth : public FewGrains<S> {
public:
    PairInBoth(const Vec3D& place, double shearRate, double rate)
        : FewGrains<S>(boxMaterial<S>(0), periodic::obliquePair(place), stepLength) {
        periodic::repeatAlongAllAxes(*this, side);
        this->setLeesEdwards(0, 1, shearRate);
        this->setStrainRate(1, rate);
        for (auto&& grain : this->particleHandler)
            grain.setVelocity(grain.getVelocity() + this->shearFlowAt(grain.getPosition()));
    }
    void meet() {
        this->run(700);
        this->setShearRate(-25);
        this->step(800);
    }
};

template <class S>
class PairInShearAndStrain : public testing::Test {};
TYPED_TEST_SUITE(PairInShearAndStrain, periodic::SpeciesOfAllKinds);

/// A pair meets across a face that slides and comes nearer as in the middle; the tolerances are those of
/// LeesEdwardsTest.
TYPED_TEST(PairInShearAndStrain, meetsEverywhereAsInTheMiddle) {
    const Vec3D middle = Vec3D::Constant(side / 2);
    for (const double rate : {50.0, -50.0}) {
        PairInBoth<TypeParam> expected(middle, 40, rate);
        expected.meet();
        ASSERT_TRUE(periodic::haveMet(expected));
        for (int axis = 0; axis < 3; ++axis)
            for (int offset = -4; offset <= 4; ++offset) {
                Vec3D place = middle;
                place[axis] += side / 2 + 0.25 * offset * 1e-3;
                PairInBoth<TypeParam> scene(place, 40, rate);
                scene.meet();
                periodic::expectPairsMoveAlike(scene, expected);
            }
    }
}

/// A cloud that is sheared under a pressure along the gradient and strained along the third axis.
template <class S>
class PressedShear : public ShearedCloud<S> {
public:
    explicit PressedShear(double shearStress = 0) : ShearedCloud<S>(60.0) {
        this->setTargetStress(1, 300, 1e-4, 50);
        this->setStrainRate(2, -20);
        if (shearStress > 0) this->setTargetShearStress(shearStress, 1e-4, 200);
        this->setQuiet();
    }
};

TEST(ShearControl, hasTheSameBitsForAnyThreads) {
    const std::uint64_t hash =
        periodic::expectSameBitsForAnyThreads([] { return PressedShear<Wet>(50); }, {2, 5});
    EXPECT_NE(hash, PressedShear<Wet>().hashAfter(1000));
}

TEST(ShearControl, goesOnAfterARestartWithTheSameBits) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    PressedShear<Wet> whole(50);
    whole.initialise();
    whole.step(300);
    whole.setTargetShearStress(80, 2e-4);
    whole.step(333);
    PressedShear<Wet> resumed(50);
    periodic::expectGoesOnAlike(whole, resumed, file, 600);
    EXPECT_EQ(resumed.getShearRate(), whole.getShearRate());

    PressedShear<Wet> other(60);
    other.restartFrom(file);
    EXPECT_TRUE(support::contains(support::refusal([&] { other.initialise(); }), "firstStress"));
}

TEST(ShearControl, noContactIsMissed) {
    PressedShear<Dry> scene(50);
    EXPECT_GT(periodic::overlapsKnownInRounds(scene, 40, 100), 1000u);
}

/// The ledger closes as with a strain alone (StrainTest).
TEST(ShearControl, energyLedgerCloses) {
    PressedShear<Wet> scene(50);
    scene.keepEnergyLedger();
    scene.initialise();
    const double atStart = scene.energyLedger().closed();
    const EnergyLedger& ledger = scene.energyLedger();
    double scale = 0;  // J, the largest: the servo shears at up to 200 1/s
    for (const double rate : {-40.0, 20.0, 10.0, 5.0}) {
        scene.step(1000);
        scale = std::max(scale, ledger.kinetic + std::abs(ledger.images));
        scene.setShearRate(rate);
    }
    EXPECT_GT(ledger.sliding, 0);
    EXPECT_LT(std::abs(ledger.closed() - atStart), 2.2e-16 * std::sqrt(4000 * 3000.0) * scale);
}

/// Against the flow, energy is gained by the stress times the rates of strain and shear, at each instant.
TEST(ShearControl, theStressDoesTheWorkOfShearAndStrain) {
    PressedShear<Dry> scene;
    scene.setStrainRate(1, -30);
    scene.keepEnergyLedger();
    scene.initialise();
    scene.step(2000);
    const PeriodicBox& box = scene.getPeriodicBox();
    const auto power = [&] {
        const Eigen::Matrix3d stress = meanStress(scene).total();
        const double volume = box.length.x * box.length.y * box.length.z;
        return volume * (30 * stress(1, 1) + 20 * stress(2, 2) - 60 * stress(0, 1));
    };
    const double before = periodic::energyAgainstFlow(scene);
    const double work = periodic::workOver(scene, 2000, power);
    EXPECT_NEAR(periodic::energyAgainstFlow(scene) - before, work, 1e-3 * std::abs(work));
}

/// A crystal that is sheared by 5e-4 has the stresses of the reference table. Rounded as in StrainTest.
TEST(ShearControl, aCrystalHasTheStressOfTheClosedForm) {
    constexpr int steps = 100;
    Lattice<Smooth> scene(linear(), 4, 2 * Lattice<Smooth>::radius * (1 - 1e-3));
    scene.setLeesEdwards(0, 1, 0);
    scene.initialise();
    scene.setShearRate(5e-4 / (steps * scene.timeStep));
    scene.step(steps);
    const Eigen::Matrix3d stress = meanStress(scene).total();
    EXPECT_NEAR(stress(0, 0), 283.378320525433, 6e-10 * 283);
    EXPECT_NEAR(stress(1, 1), 283.404819290934, 6e-10 * 283);
    EXPECT_NEAR(stress(2, 2), 283.400391022337, 6e-10 * 283);
    EXPECT_NEAR(stress(0, 1), -35.2844524283493, 6e-10 * 283);
    const LeesEdwards shear = support::shearOf(0, 1, 0);
    const DiagonalStress same = diagonalStress(scene.contacts(), scene.particleHandler.store(), {}, shear);
    EXPECT_NEAR(same.shear, 35.2844524283493, 6e-10 * 283);
    // C44 = k / (sqrt(2) l) of the crystal that is not sheared; a shear of 5e-4 turns contacts by as much.
    EXPECT_NEAR(same.shearStiffness, 100 / (std::sqrt(2.0) * scene.distance()), 1e-3 * same.shearStiffness);
}

/// The servo brings the crystal to its shear stress, and holds it.
TEST(HeavyShearControl, aServoBringsACrystalToItsShearStress) {
    Lattice<Smooth> scene(linear(), 4, 2 * Lattice<Smooth>::radius * (1 - 1e-3));
    scene.setLeesEdwards(0, 1, 0);
    scene.setTargetShearStress(20, 50 * scene.timeStep);
    scene.initialise();
    scene.step(500);
    // exp(-10), and what the change of the stiffness by the shear, of 3e-4, makes of it
    EXPECT_NEAR(-meanStress(scene).total()(0, 1), 20, 20 * (std::exp(-10) + 1e-3));
    scene.step(50 * 16 * 30);
    EXPECT_NEAR(-meanStress(scene).total()(0, 1), 20, 1e-7);
    EXPECT_NEAR(scene.getShearRate(), 0, 1e-6);
}

/// While a crystal is squeezed along z, its stress along x and y stays: without the integral it would be off
/// by rate x (C12 / (C11 + C12)) x K x time, with K = C11 + C12 of the two controlled axes.
TEST(ShearControl, aStrainAlongAnotherAxisLeavesNoSteadyError) {
    Lattice<Smooth> scene(linear(), 4, 2 * Lattice<Smooth>::radius * (1 - 1e-3));
    const double time = 20 * scene.timeStep, rate = 0.02;
    for (int axis = 0; axis < 2; ++axis) scene.setTargetStress(axis, 280, time);
    scene.setStrainRate(2, -rate);
    scene.initialise();
    const double c12 = 100 / (std::sqrt(2.0) * scene.distance());
    scene.step(20 * 16 * 30);
    const Eigen::Matrix3d stress = meanStress(scene).total();
    EXPECT_GT(stress(2, 2), 290);
    for (int axis = 0; axis < 2; ++axis) EXPECT_NEAR(stress(axis, axis), 280, 0.02 * c12 * rate * time);
}

TEST(ShearControl, whatDoesNotFitIsRefused) {
    const auto refusal = [](auto&& change) { return periodic::refusalOfOneGrain(3, change); };
    using support::contains;
    EXPECT_EQ(refusal([](auto& s) {
                  s.setLeesEdwards(0, 1, 1);
                  s.setStrainRate(1, 1), s.setTargetStress(2, 1, 1), s.setTargetShearStress(1, 1);
              }),
              "");
    EXPECT_TRUE(contains(refusal([](auto& s) { s.setShearRate(1); }), "setLeesEdwards"));
    EXPECT_TRUE(contains(refusal([](auto& s) { s.setTargetShearStress(1, 1); }), "setLeesEdwards"));
    for (const double bad : {std::nan(""), infinity, -infinity}) {
        const auto sheared = [&](auto&& change) {
            return refusal([&](auto& s) {
                s.setLeesEdwards(0, 1, 1);
                change(s);
            });
        };
        EXPECT_TRUE(contains(sheared([=](auto& s) { s.setShearRate(bad); }), "shear rate"));
        EXPECT_TRUE(contains(sheared([=](auto& s) { s.setTargetShearStress(bad, 1); }), "target shear"));
        EXPECT_TRUE(contains(sheared([=](auto& s) { s.setTargetShearStress(1, bad); }), "time"));
        EXPECT_TRUE(contains(sheared([=](auto& s) { s.setTargetShearStress(1, 1, -1); }), "largest"));
        EXPECT_TRUE(contains(sheared([](auto& s) { s.setTargetShearStress(1, 4e-7); }), "half a time step"));
        EXPECT_TRUE(contains(sheared([](auto& s) { s.setStrainRate(0, 1); }), "length along this axis"));
    }
}

/// Stresses that grains cannot bear: none touch, or a gas that cannot be brought to no pressure at all.
TEST(ShearControl, whatTheGrainsCannotBearEndsTheRun) {
    const auto end = [](const std::vector<GrainMotion>& grains, auto&& change) -> std::string {
        FewGrains<Smooth> scene(boxMaterial<Smooth>(0), grains, 1e-5);
        periodic::repeatAlongAllAxes(scene, 0.01);
        scene.setQuiet();
        change(scene);
        return periodic::endWithin(scene, 400000);
    };
    EXPECT_TRUE(support::contains(end({{.position = {0.005, 0.005, 0.005}}},
                                      [](auto& s) {
                                          s.setLeesEdwards(0, 1, 0);
                                          s.setTargetShearStress(100, 1e-2);
                                      }),
                                  "cannot bear"));
    EXPECT_TRUE(support::contains(end({{.position = {0.002, 0.002, 0.002}, .velocity = {0.1, 0, 0}},
                                       {.position = {0.007, 0.007, 0.007}, .velocity = {-0.1, 0, 0}}},
                                      [](auto& s) {
                                          for (int axis = 0; axis < 3; ++axis)
                                              s.setTargetStress(axis, 0, 1e-2, 10);
                                      }),
                                  "cannot bear"));
}

}  // namespace
}  // namespace pendular::shearControlTest
