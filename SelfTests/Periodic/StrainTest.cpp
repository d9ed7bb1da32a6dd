// Periodic scenes whose lengths change, at a rate or under a stress.
#include <gtest/gtest.h>

#include <array>

#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/ShearAndStrain/HomogeneousStrain.h"
#include "Kernel/Features/ShearAndStrain/StressServo.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Periodic/Lattice.h"
#include "SelfTests/Periodic/MovingImages.h"
#include "SelfTests/Periodic/ObliquePair.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::strainTest {
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

using Hertz = Species<HertzianViscoelastic>;

constexpr double side = 0x1p-6;   // m
constexpr double step = 0x1p-20;  // s

/// Without contacts, C x length stays, also of a grain that goes round the box and while the rate changes.
TEST(Strain, aFreeGrainLosesSpeedAsTheLengthGrows) {
    const Vec3D speed(3, -2, 1);
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.position = {0.001, 0.002, 0.003}, .velocity = speed}},
                            step);
    periodic::repeatAlongAllAxes(scene, side);
    scene.setStrainRate(0, 10);
    scene.setStrainRate(2, -5);
    scene.initialise();
    constexpr int steps = 100000;
    scene.step(steps / 2);
    scene.setStrainRate(0, -20);
    scene.step(steps / 2);
    const GrainMotion now = scene.motion(0);
    EXPECT_LT(std::abs(now.position.x()), 2 * side);  // it went round some 10 times
    const Vector<double> length = scene.getPeriodicBox().length;
    const double half = 0.5 * steps * step;
    // A step rounds each length and velocity once or twice.
    const double bound = 4 * steps * 1.1e-16;
    EXPECT_NEAR(length.x / side, std::exp((10 - 20) * half), bound);
    EXPECT_EQ(length.y, side);
    EXPECT_NEAR(length.z / side, std::exp(-5 * 2 * half), bound);
    const Vec3D found = againstFlow(scene, now);
    EXPECT_NEAR(found.x() * length.x, 3 * side, 3 * side * bound);
    EXPECT_EQ(found.y(), -2);
    EXPECT_NEAR(found.z() * length.z, side, side * bound);
}

/// Two grains that meet obliquely at a place of a strain.
template <class S>
class PairInStrain : public FewGrains<S> {
public:
    PairInStrain(const Vec3D& place, int axis, double rate)
        : FewGrains<S>(boxMaterial<S>(0), periodic::obliquePair(place), step) {
        periodic::repeatAlongAllAxes(*this, side);
        this->setStrainRate(axis, rate);
    }
};

template <class S>
class StrainedPair : public testing::Test {};
TYPED_TEST_SUITE(StrainedPair, periodic::SpeciesOfAllKinds);

/// A pair with friction or bridges, too, meets across a face as in the middle. The tolerances are those of a
/// pair in shear (LeesEdwardsTest).
TYPED_TEST(StrainedPair, meetsEverywhereAsInTheMiddle) {
    constexpr int steps = 1500;
    const Vec3D middle = Vec3D::Constant(side / 2);
    for (int axis = 0; axis < 3; ++axis)
        for (const double rate : {60.0, -60.0}) {
            PairInStrain<TypeParam> expected(middle, axis, rate);
            expected.run(steps);
            ASSERT_TRUE(periodic::haveMet(expected));
            for (int offset = -4; offset <= 4; ++offset) {
                Vec3D place = middle;
                place[axis] += side / 2 + 0.25 * offset * 1e-3;
                PairInStrain<TypeParam> scene(place, axis, rate);
                scene.run(steps);
                periodic::expectPairsMoveAlike(scene, expected);
                for (std::size_t k : {0, 1}) {
                    const PeriodicBox& box = scene.getPeriodicBox();
                    Vec3D shift = place - middle;
                    shift[axis] *= toEigen(box.length)[axis] / side;
                    const Vector<double> off =
                        toVector(Vec3D(scene.motion(k).position - expected.motion(k).position - shift));
                    EXPECT_LT(norm(box.nearest(off)), periodic::pairSpeedTolerance * steps * step);
                }
            }
        }
}

/// A cloud that is squeezed along x and y and stretched along z.
template <class S>
class StrainedCloud : public ShearedCloud<S> {
public:
    explicit StrainedCloud(double rate) : ShearedCloud<S>(std::nullopt) {
        this->setStrainRate(0, -rate);
        this->setStrainRate(1, -0.5 * rate);
        this->setStrainRate(2, 1.3 * rate);
        this->setQuiet();
    }
};

/// A cloud under a stress, another one along z.
template <class S>
class PressedCloud : public ShearedCloud<S> {
public:
    PressedCloud() : ShearedCloud<S>(std::nullopt) {
        for (int axis = 0; axis < 3; ++axis) this->setTargetStress(axis, axis == 2 ? 300 : 200, 1e-4, 50);
        this->setQuiet();
    }
};

TEST(Strain, ofRateZeroHasTheBitsOfAPeriodicScene) {
    ShearedCloud<Dry> periodic(std::nullopt);
    EXPECT_EQ(StrainedCloud<Dry>(0).hashAfter(1000), periodic.hashAfter(1000));
}

TEST(Strain, hasTheSameBitsForAnyThreads) {
    periodic::expectSameBitsForAnyThreads([] { return PressedCloud<Wet>(); }, {2, 3, 8});
}

TEST(Strain, goesOnAfterARestartWithTheSameBits) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    PressedCloud<Wet> whole;
    whole.initialise();
    whole.step(300);
    whole.setStrainRate(2, 40);  // in the run
    whole.step(333);
    PressedCloud<Wet> resumed;
    periodic::expectGoesOnAlike(whole, resumed, file, 600);
    EXPECT_EQ(resumed.getStrainRate(2), 40);

    StrainedCloud<Wet> other(3);
    other.restartFrom(file);
    EXPECT_TRUE(support::contains(support::refusal([&] { other.initialise(); }), "firstRate"));
}

/// No pair is missed by a list that lasts.
TEST(Strain, noContactIsMissed) {
    StrainedCloud<Dry> scene(40);
    EXPECT_GT(periodic::overlapsKnownInRounds(scene, 60, 100), 1000u);
    EXPECT_LT(scene.contacts().rebuildCount(), 1000u);
}

TEST(Strain, energyLedgerCloses) {
    StrainedCloud<Wet> scene(40);
    scene.keepEnergyLedger();
    scene.initialise();
    const double atStart = scene.energyLedger().closed();
    scene.step(2000);
    scene.setStrainRate(0, 10);
    scene.step(2000);
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_NE(ledger.images, 0);
    EXPECT_GT(ledger.sliding, 0);
    // 4000 steps add some 3000 contacts each, whose largest is the kinetic energy: round-off of the sums
    // grows as the root of their number.
    const double scale = ledger.kinetic + std::abs(ledger.images);
    EXPECT_LT(std::abs(ledger.closed() - atStart), 2.2e-16 * std::sqrt(4000 * 3000.0) * scale);
}

/// Against the flow, energy is gained by -rate x volume x stress along each axis and lost in contacts.
TEST(Strain, theStressDoesTheWorkOfTheStrain) {
    constexpr double rate = 40;
    StrainedCloud<Dry> scene(rate);
    scene.keepEnergyLedger();
    scene.initialise();
    scene.step(2000);
    const PeriodicBox& box = scene.getPeriodicBox();
    const auto power = [&] {
        const Eigen::Matrix3d stress = meanStress(scene).total();
        const double volume = box.length.x * box.length.y * box.length.z;
        return -rate * volume * (-stress(0, 0) - 0.5 * stress(1, 1) + 1.3 * stress(2, 2));
    };
    const double before = periodic::energyAgainstFlow(scene);
    const double work = periodic::workOver(scene, 2000, power);
    EXPECT_GT(std::abs(work), 0);
    EXPECT_NEAR(periodic::energyAgainstFlow(scene) - before, work, 1e-3 * std::abs(work));
}

Hertz hertz() {
    Hertz material;
    material.setEffectiveElasticModulus(1e7), material.setDissipation(0);
    return material;
}

/// Crystals that were strained have the stress of the closed form c F / l^2. Places are rounded to 1.1e-16 of
/// the box in each of 100 steps, together at most 6e-17 m, of the overlap of at least 1e-7 m: 6e-10, and 1.5
/// times that of Hertz's force.
TEST(Strain, crystalsHaveTheStressOfTheClosedForm) {
    constexpr int steps = 100;
    const auto pressure = [](auto material, int inCube, double approach) {
        Lattice<decltype(material)> scene(material, inCube);
        for (int axis = 0; axis < 3; ++axis)
            scene.setStrainRate(axis, std::log(1 - approach) / (steps * scene.timeStep));
        scene.initialise();
        scene.step(steps);
        EXPECT_NEAR(scene.distance() / (2 * scene.radius), 1 - approach, 4 * steps * 1.1e-16);
        const Eigen::Matrix3d stress = meanStress(scene).total();
        EXPECT_NEAR(stress(0, 0), stress(2, 2), 1e-9 * stress(0, 0));
        EXPECT_NEAR(stress(0, 1), 0, 1e-9 * stress(0, 0));
        const DiagonalStress same = diagonalStress(scene.contacts(), scene.particleHandler.store(), {});
        EXPECT_NEAR(same.stress[1], stress(1, 1), 1e-12 * stress(1, 1));
        return stress(1, 1);
    };
    struct Row {
        int inCube;
        double approach, ofHertz, ofLinear;  // Pa
    };
    for (const Row& row :
         {Row{1, 1e-4, 6.66800020002667, 10.00200030004}, Row{1, 0.01, 6802.02700404721, 1020.30405060708},
          Row{4, 1e-4, 18.8599526335685, 28.2899289503527}, Row{4, 0.01, 19239.0376815032, 2885.85565222548},
          Row{4, 1e-3, 597.479154830375, 283.409247560469}}) {
        EXPECT_NEAR(pressure(linear(), row.inCube, row.approach), row.ofLinear, 6e-10 * row.ofLinear);
        EXPECT_NEAR(pressure(hertz(), row.inCube, row.approach), row.ofHertz, 9e-10 * row.ofHertz);
    }
}

/// The servo brings a crystal to the length of the closed form: by exp(-t / time) at small steps, one step of
/// the time lands on it, 1.9 of them ring (reference table of the law without its integral, whose lengths
/// grow by 1 + strain instead of exp(strain): half the square of the first strain, 4.8e-4, is 1.2e-10 m). The
/// integral takes what stiffness changes over the first approach, 2.5e-4 m/m of 2.5e-7 m, for a drift, at
/// most, which it forgets by exp(-t / (16 time)). Rounded as above.
TEST(Strain, aServoBringsACrystalToItsTarget) {
    const auto distance = [](double stepOverTime, double times) {
        Lattice<Smooth> scene(linear(), 4, 2 * Lattice<Smooth>::radius * (1 - 1e-4));
        const double time = scene.timeStep / stepOverTime;
        for (int axis = 0; axis < 3; ++axis) scene.setTargetStress(axis, 100, time);
        scene.initialise();
        scene.step(static_cast<std::size_t>(std::lround(times / stepOverTime)));
        return scene.distance();
    };
    constexpr double target = 0.999646696388808e-3;
    EXPECT_NEAR(distance(1, 400), target, 4e-16);
    EXPECT_NEAR(distance(0.1, 400), target, 4e-16);
    EXPECT_NEAR(distance(0.01, 20), target, 6.2e-11 * std::exp(-20 / 16.));
    EXPECT_NEAR(distance(1.9, 20), 0.999565892440565e-3, 1.2e-10);
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { distance(2.1, 20); })));
}

/// One axis under a stress, the others held: the stiffness is C11 = sqrt(2) k / l of the crystal.
TEST(Strain, oneAxisAloneFollowsItsOwnStiffness) {
    Lattice<Smooth> scene(linear(), 4, 2 * Lattice<Smooth>::radius * (1 - 1e-4));
    HomogeneousStrain alongX;
    alongX.axes[0].isControlled = true;
    scene.initialise();
    const DiagonalStress now = diagonalStress(scene.contacts(), scene.particleHandler.store(), alongX);
    EXPECT_NEAR(now.stiffness[0], std::sqrt(2.0) * 100 / scene.distance(), 1e-12 * now.stiffness[0]);
    EXPECT_NEAR(now.stiffness[1], 0.5 * now.stiffness[0], 1e-12 * now.stiffness[0]);  // C12
}

/// Loose grains are pressed, with another stress along z, and keep it: within what one grain in 512 makes of
/// it.
TEST(HeavyStrain, looseGrainsComeUnderTheirStress) {
    PressedCloud<Dry> scene;
    for (int axis = 0; axis < 3; ++axis) scene.setTargetStress(axis, axis == 2 ? 300 : 200, 2e-3, 20);
    scene.initialise();
    scene.step(200000);
    const Eigen::Matrix3d stress = meanStress(scene).total();
    EXPECT_NEAR(stress(0, 0), 200, 2);
    EXPECT_NEAR(stress(1, 1), 200, 2);
    EXPECT_NEAR(stress(2, 2), 300, 3);
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(std::abs(scene.getStrainRate(axis)), 0.1);
}

TEST(Strain, whatDoesNotFitIsRefused) {
    const auto refusal = [](auto&& change) { return periodic::refusalOfOneGrain(2, change); };
    EXPECT_EQ(refusal([](auto& s) { s.setStrainRate(0, 3); }), "");
    for (const double bad : {std::nan(""), infinity, -infinity}) {
        EXPECT_TRUE(support::contains(refusal([=](auto& s) { s.setStrainRate(0, bad); }), "strain rate"));
        EXPECT_TRUE(
            support::contains(refusal([=](auto& s) { s.setTargetStress(0, bad, 1); }), "target stress"));
        EXPECT_TRUE(support::contains(refusal([=](auto& s) { s.setTargetStress(0, 1, bad); }), "time"));
    }
    EXPECT_TRUE(support::contains(refusal([=](auto& s) { s.setTargetStress(0, 1, 0); }), "time"));
    EXPECT_TRUE(support::contains(refusal([=](auto& s) { s.setTargetStress(0, 1, 1, -1); }), "largest"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) { s.setStrainRate(3, 1); }), "axis"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) { s.setStrainRate(2, 1); }), "setPeriodic"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) { s.setTargetStress(0, 1, 1); }), "all three axes"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) {
                                      s.setStrainRate(0, 1);
                                      s.setGravity({0, 0, -9.81});
                                  }),
                                  "gravity"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) {
                                      s.setLeesEdwards(0, 1, 1);
                                      s.setStrainRate(0, 1);
                                  }),
                                  "length along this axis stays"));
    EXPECT_TRUE(support::contains(refusal([](auto& s) {
                                      s.setStrainRate(0, 1);
                                      InfiniteWall wall;
                                      wall.set({-1, 0, 0}, {0, 0, 0});  // across the period
                                      wall.setSpecies(s.speciesHandler.getObject(0));
                                      s.wallHandler.copyAndAddObject(wall);
                                  }),
                                  "walls"));
    FewGrains<Smooth> begun(boxMaterial<Smooth>(0), {{.position = {0.005, 0.005, 0.005}}}, 1e-6);
    begun.setPeriodic(0, 0, 0.01);
    begun.initialise();
    EXPECT_TRUE(support::contains(support::refusal([&] { begun.setStrainRate(0, 1); }), "set up"));
}

/// What cannot go on ends with a sentence.
TEST(Strain, whatTheGrainsCannotBearEndsTheRun) {
    const std::vector<GrainMotion> two{{.position = {0.001, 0.005, 0.005}},
                                       {.position = {0.006, 0.002, 0.005}}};
    const auto ofTwo = [&](auto&& change) {
        FewGrains<Smooth> scene(boxMaterial<Smooth>(0), two, 1e-6);
        periodic::repeatAlongAllAxes(scene, 0.01);
        scene.setQuiet();
        change(scene);
        return periodic::endWithin(scene, 20000);
    };
    EXPECT_TRUE(support::contains(ofTwo([](auto& s) { s.setStrainRate(2, -100); }), "length along z"));
    EXPECT_TRUE(support::contains(ofTwo([](auto& s) {
                                      for (int axis = 0; axis < 3; ++axis) s.setTargetStress(axis, -10, 1e-3);
                                  }),
                                  "tension"));
    Lattice<Smooth> crushed(linear(), 4);
    for (int axis = 0; axis < 3; ++axis) crushed.setTargetStress(axis, 1e9, 1e-3);
    EXPECT_TRUE(support::contains(periodic::endWithin(crushed, 20000), "overlap"));
}

}  // namespace
}  // namespace pendular::strainTest
