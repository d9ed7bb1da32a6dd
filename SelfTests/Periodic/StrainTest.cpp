// Periodic scenes whose lengths change, at a rate or under a stress.
#include <gtest/gtest.h>

#include <array>

#include "Kernel/Base/RunError.h"
#include "Kernel/CoarseGraining/MeanStress.h"
#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Particles/HomogeneousStrain.h"
#include "Kernel/Parts/StressServo.h"
#include "Kernel/Simulation/StateHash.h"
#include "Kernel/Species/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Species/Friction/Mindlin.h"
#include "Kernel/Species/Normal/HertzianViscoelastic.h"
#include "Kernel/Species/Normal/LinearViscoelastic.h"
#include "SelfTests/Periodic/Lattice.h"
#include "SelfTests/Periodic/MovingImages.h"
#include "SelfTests/Periodic/ObliquePair.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular {
namespace {

using periodic::Lattice;
using periodic::linear;
using scenes::boxMaterial;
using scenes::FewGrains;
using scenes::GrainMotion;
using scenes::ShearedCloud;

using Smooth = Species<LinearViscoelastic>;
using Hertz = Species<HertzianViscoelastic>;
using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

constexpr double side = 0x1p-6;   // m
constexpr double step = 0x1p-20;  // s

Vec3D againstFlow(const Scene& scene, const GrainMotion& motion) {
    return motion.velocity - scene.shearFlowAt(motion.position);
}

/// Without contacts, C x length stays, also of a grain that goes round the box and while the rate changes.
TEST(Strain, aFreeGrainLosesSpeedAsTheLengthGrows) {
    const Vec3D speed(3, -2, 1);
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.position = {0.001, 0.002, 0.003}, .velocity = speed}},
                            step);
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, side);
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
        for (int k = 0; k < 3; ++k) this->setPeriodic(k, 0, side);
        this->setStrainRate(axis, rate);
    }
};

template <class S>
class StrainedPair : public testing::Test {};
using SpeciesOfAllKinds = testing::Types<Smooth, Dry, Wet>;
TYPED_TEST_SUITE(StrainedPair, SpeciesOfAllKinds);

/// A pair with friction or bridges, too, meets across a face as in the middle. The tolerances are those of a
/// pair in shear (LeesEdwardsTest).
TYPED_TEST(StrainedPair, meetsEverywhereAsInTheMiddle) {
    constexpr int steps = 1500;
    constexpr double speedTolerance = 1e-9, spinTolerance = 2.5 / 0.8e-3 * speedTolerance;
    const Vec3D middle = Vec3D::Constant(side / 2);
    for (int axis = 0; axis < 3; ++axis)
        for (const double rate : {60.0, -60.0}) {
            PairInStrain<TypeParam> expected(middle, axis, rate);
            expected.run(steps);
            const Vec3D relative =
                againstFlow(expected, expected.motion(0)) - againstFlow(expected, expected.motion(1));
            ASSERT_LT(relative.dot(Vec3D(2, -3, 4).normalized()), 0.25);  // they met; 0.48 before
            for (int offset = -4; offset <= 4; ++offset) {
                Vec3D place = middle;
                place[axis] += side / 2 + 0.25 * offset * 1e-3;
                PairInStrain<TypeParam> scene(place, axis, rate);
                scene.run(steps);
                for (std::size_t k : {0, 1}) {
                    const GrainMotion a = scene.motion(k), b = expected.motion(k);
                    EXPECT_LT((againstFlow(scene, a) - againstFlow(expected, b)).norm(), speedTolerance);
                    EXPECT_LT((a.spin - b.spin).norm(), spinTolerance);
                    const PeriodicBox& box = scene.getPeriodicBox();
                    Vec3D shift = place - middle;
                    shift[axis] *= toEigen(box.length)[axis] / side;
                    const Vector<double> off = toVector(Vec3D(a.position - b.position - shift));
                    EXPECT_LT(norm(box.nearest(off)), speedTolerance * steps * step);
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
    const std::uint64_t one = PressedCloud<Wet>().hashAfter(1000);
    for (const int threads : {2, 3, 8}) {
        PressedCloud<Wet> scene;
        scene.setNumberOfThreads(threads);
        EXPECT_EQ(scene.hashAfter(1000), one) << threads;
    }
}

TEST(Strain, goesOnAfterARestartWithTheSameBits) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    PressedCloud<Wet> whole;
    whole.initialise();
    whole.step(300);
    whole.setStrainRate(2, 40);  // in the run
    whole.step(333);
    whole.writeRestart(file);
    whole.step(600);
    PressedCloud<Wet> resumed;
    resumed.restartFrom(file);
    resumed.initialise();
    EXPECT_EQ(resumed.getStrainRate(2), 40);
    resumed.step(600);
    EXPECT_EQ(stateHash(resumed.particleHandler.store()), stateHash(whole.particleHandler.store()));
    EXPECT_EQ(resumed.getPeriodicBox().length, whole.getPeriodicBox().length);

    StrainedCloud<Wet> other(3);
    other.restartFrom(file);
    EXPECT_TRUE(support::contains(support::refusal([&] { other.initialise(); }), "firstRate"));
}

/// No pair is missed by a list that lasts.
TEST(Strain, noContactIsMissed) {
    StrainedCloud<Dry> scene(40);
    scene.initialise();
    std::size_t overlaps = 0;
    for (int k = 0; k < 60; ++k) {
        scene.step(100);
        overlaps += periodic::expectAllOverlapsKnown(scene);
    }
    EXPECT_GT(overlaps, 1000u);
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
    const auto refusal = [](auto&& change) {
        FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.position = {0.005, 0.005, 0.005}}}, 1e-6);
        scene.setPeriodic(0, 0, 0.01);
        scene.setPeriodic(1, 0, 0.01);
        const std::string text = support::refusal([&] {
            change(scene);
            scene.initialise();
        });
        EXPECT_TRUE(text.empty() || support::isOneSentence(text));
        return text;
    };
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
                                      wall.set({0, 0, -1}, {0, 0, 0});
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
    const auto end = [](auto&& scene, int steps) {
        scene.initialise();
        try {
            scene.step(static_cast<std::size_t>(steps));
        } catch (const RunError& error) {
            EXPECT_TRUE(support::isOneSentence(error.what()));
            return std::string(error.what());
        }
        return std::string();
    };
    const std::vector<GrainMotion> two{{.position = {0.001, 0.005, 0.005}},
                                       {.position = {0.006, 0.002, 0.005}}};
    const auto periodic = [&](auto&& change) {
        FewGrains<Smooth> scene(boxMaterial<Smooth>(0), two, 1e-6);
        for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, 0.01);
        scene.setQuiet();
        change(scene);
        return end(scene, 20000);
    };
    EXPECT_TRUE(support::contains(periodic([](auto& s) { s.setStrainRate(2, -100); }), "length along z"));
    EXPECT_TRUE(support::contains(periodic([](auto& s) {
                                      for (int axis = 0; axis < 3; ++axis) s.setTargetStress(axis, -10, 1e-3);
                                  }),
                                  "tension"));
    Lattice<Smooth> crushed(linear(), 4);
    for (int axis = 0; axis < 3; ++axis) crushed.setTargetStress(axis, 1e9, 1e-3);
    EXPECT_TRUE(support::contains(end(crushed, 20000), "overlap"));
}

}  // namespace
}  // namespace pendular
