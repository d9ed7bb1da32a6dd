// Streams of clumps, and of mixtures of grains and clumps.
#include <gtest/gtest.h>

#include <numbers>

#include "Kernel/Core/Step/SummaryRows.h"
#include "SelfTests/Insertion/ClumpScene.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::clumpInletTest {
namespace {

using scenes::ClumpScene;
using scenes::dimer;
using scenes::equalSizes;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

constexpr double d = 1e-3, flow = 0.02;  // m, kg/s

SizeDistribution wideSizes() { return evenSizes(0.7 * d, 1.3 * d); }
double massOf(double diameter) { return sphereMass(0.5 * diameter, ClumpScene::density); }

/// m; clumps come in the upper part of a box without walls.
BoxRegion above() { return {{0, 0, 20 * d}, {10 * d, 10 * d, 24 * d}}; }

Inlet streamOf(const ClumpScene& scene, double aspect = 1.6) {
    Inlet inlet;
    inlet.setRegion(above());
    inlet.setSizes(wideSizes());
    inlet.setClump(scene.clump(dimer(aspect), {0, 0, -1}));
    inlet.setMassFlow(flow);
    return inlet;
}

/// Clumps fall through a box without walls, and leave it below. On a plane in between they collide.
class Falling : public ClumpScene {
public:
    explicit Falling(int threads = 1, double step = 2e-6, bool withPlane = false) : ClumpScene(threads) {
        setGravity({0, 0, -9.81});
        setTimeStep(step);
        inletHandler.copyAndAddObject(streamOf(*this));
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0});
        outletHandler.copyAndAddObject(outlet);
        fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 10 * d}});
        if (!withPlane) return;
        addWall({1.5, 0, -1}, {5 * d, 5 * d, 8 * d});
        keepEnergyLedger();
    }
    /// kg
    [[nodiscard]] double massThere() {
        double mass = 0;
        for (std::size_t k = 0, found = 0; found < bodyHandler.getSize(); ++k)
            if (particleHandler.store().bodies.find(k) != RigidBodies::none)
                mass += bodyHandler.getObject(k).getMass(), ++found;
        return mass;
    }
};

TEST(ClumpInlet, bringsTheLargestSumOfWholeClumpsForAnyStep) {
    for (const double step : {2e-6, 1.3e-6}) {
        Falling scene(1, step);
        scene.initialise();
        for (int k = 0; k < 6000; ++k) {
            scene.step();
            const InletCount& count = scene.inletHandler.countOf(0);
            const double due = flow * scene.getTime();
            ASSERT_LE(count.mass, due * (1 + 1e-12));
            ASSERT_GT(count.mass + massOf(2 * wideSizes().drawRadius(CountedRandom(1), count.number)),
                      due * (1 - 1e-9));
        }
        EXPECT_GT(scene.inletHandler.countOf(0).number, 40u);
    }
}

TEST(ClumpInlet, bringsANumberASecond) {
    ClumpScene scene;
    Inlet inlet = streamOf(scene);
    inlet.setNumberFlow(5000);
    inlet.setTimes(1e-3, 4e-3);
    scene.inletHandler.copyAndAddObject(inlet);
    scene.setTimeStep(2e-6);
    scene.initialise();
    for (int k = 0; k < 3000; ++k) {
        scene.step();
        const double lasted = std::clamp(scene.getTime() - 1e-3, 0.0, 3e-3);
        const auto come = static_cast<double>(scene.inletHandler.countOf(0).number);
        ASSERT_LE(come, 5000 * lasted + 1e-9);
        ASSERT_GT(come + 1, 5000 * lasted - 1e-9);
        ASSERT_EQ(scene.bodyHandler.getSize(), scene.inletHandler.countOf(0).number);
    }
    EXPECT_EQ(scene.bodyHandler.getSize(), 15u);
}

// What has come is there or has gone: numbers exactly, masses to round-off.
TEST(HeavyClumpInlet, isBalancedByAnOutlet) {
    Falling scene;
    scene.initialise();
    for (int k = 0; k < 30000; ++k) {
        scene.step();
        const InletCount& come = scene.inletHandler.countOf(0);
        ASSERT_EQ(come.number, scene.bodyHandler.getSize() + scene.outletHandler.removedNumber());
        ASSERT_EQ(scene.particleHandler.getSize(), 2 * scene.bodyHandler.getSize());
        if (k % 100 != 0) continue;
        ASSERT_NEAR(scene.massThere() + scene.outletHandler.removedMass(), come.mass, 1e-12 * come.mass);
    }
    EXPECT_GT(scene.outletHandler.removedNumber(), 100u);
    // Those between the plane in the middle and the outlet.
    std::size_t below = 0;
    const RigidBodies& bodies = scene.particleHandler.store().bodies;
    for (std::size_t k = 0; k < bodies.size(); ++k) below += bodies[k].position.z <= 10 * d;
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(0).net(),
              static_cast<std::int64_t>(scene.outletHandler.removedNumber() + below));
    SummaryRows rows;
    scene.addPartsTo(rows);
    EXPECT_TRUE(contains(rows.shown(), fmt::format("inlet 0: grains and bodies that have come {}\n",
                                                   scene.inletHandler.countOf(0).number)))
        << rows.shown();
}

TEST(ClumpInlet, givesTheSameBitsForAnyThreadsAndThroughRestarts) {
    const TestFolder folder;
    Falling whole(1, 2e-6, true);
    whole.initialise();
    whole.steps(8000);
    whole.writeRestart(folder.path() / "half.h5");
    EXPECT_GT(whole.bodyHandler.getSize(), 50u);
    whole.steps(8000);
    whole.writeRestart(folder.path() / "whole.h5");
    for (const int threads : {1, 3}) {
        Falling restarted(threads, 2e-6, true);
        restarted.restartFrom(folder.path() / "half.h5");
        restarted.initialise();
        restarted.steps(8000);
        restarted.writeRestart(folder.path() / "again.h5");
        support::expectSameState(folder.path() / "whole.h5", folder.path() / "again.h5");
    }
    // Other clumps, and grains of the same sizes, are not what came.
    for (const bool isGrain : {false, true}) {
        ClumpScene other;
        Inlet inlet = streamOf(other, 1.5);
        if (isGrain) inlet.setGrain(other.grain({0, 0, -1}));
        other.inletHandler.copyAndAddObject(inlet);
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0});
        other.outletHandler.copyAndAddObject(outlet);
        other.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 10 * d}});
        other.addWall({1.5, 0, -1}, {5 * d, 5 * d, 8 * d});
        other.keepEnergyLedger();
        other.setGravity({0, 0, -9.81});
        other.setTimeStep(2e-6);
        other.restartFrom(folder.path() / "half.h5");
        const std::string text = refusal([&] { other.initialise(); });
        EXPECT_TRUE(isOneSentence(text) &&
                    contains(text, isGrain ? "inlets/0/kind0/kind is clump in the file and grain in the scene"
                                           : "inlets/0/kind0/spheres is ("))
            << text;
    }
}

// What came is there, has gone, or was dissipated, to the round-off of each step: 16 000 times 2^-53, of some
// ten sums.
TEST(HeavyClumpInlet, keepsTheEnergyLedgerClosed) {
    Falling scene(1, 2e-6, true);
    scene.initialise();
    const double before = scene.energyLedger().closed();
    scene.steps(16000);
    // J, an upper bound of what came
    const double come = scene.inletHandler.countOf(0).mass * (0.5 + 9.81 * 24 * d);
    EXPECT_GT(scene.outletHandler.removedNumber(), 10u);
    EXPECT_GT(scene.energyLedger().normalDashpots, 1e-3 * come);
    EXPECT_LT(std::abs(scene.energyLedger().closed() - before), 1.8e-11 * come);
}

/// Clumps fall onto a floor of a scene that repeats itself along x and y, with the adaptive step; in the run
/// others come by a hook, which are larger and moved more easily than those of the inlet.
class OntoAFloor : public ClumpScene {
public:
    explicit OntoAFloor(int threads = 1) : ClumpScene(threads) {
        for (const int axis : {0, 1}) setPeriodic(axis, 0, 10 * d);
        setGravity({0, 0, -9.81});
        addWall({0, 0, -1}, {0, 0, 16 * d});
        keepEnergyLedger();
        inletHandler.copyAndAddObject(streamOf(*this));
        setTimeStep(1e-6);
        setAdaptiveTimeStep(0.9);
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 1500 == 1000)
            insert(equalSizes(1.5 * d), BoxRegion({0, 0, 26 * d}, {10 * d, 10 * d, 32 * d}),
                   Amount::grains(2), clump(dimer(2), {0, 0, -1}), {.seed = getNumberOfTimeSteps()});
    }
};

TEST(HeavyClumpInlet, goesWithPeriodsTheAdaptiveStepAndClumpsOfHooks) {
    const TestFolder folder;
    OntoAFloor whole;
    whole.initialise();
    const double before = whole.energyLedger().closed();
    whole.steps(3300);
    whole.writeRestart(folder.path() / "half.h5");
    whole.steps(3000);
    whole.writeRestart(folder.path() / "whole.h5");
    const std::size_t number = whole.inletHandler.countOf(0).number;
    EXPECT_GT(number, 100u);
    EXPECT_EQ(whole.bodyHandler.getSize(), number + 8);
    const double come = 2 * whole.inletHandler.countOf(0).mass * (0.5 + 9.81 * 32 * d);  // J, and of hooks
    EXPECT_LT(std::abs(whole.energyLedger().closed() - before), 1e-11 * come);
    for (const int threads : {1, 3}) {
        OntoAFloor restarted(threads);
        restarted.restartFrom(folder.path() / "half.h5");
        restarted.initialise();
        restarted.steps(3000);
        restarted.writeRestart(folder.path() / "again.h5");
        support::expectSameState(folder.path() / "whole.h5", folder.path() / "again.h5");
    }
}

// At the step in which a clump comes it overlaps nothing; it moves as it is told to.
TEST(ClumpInlet, putsNothingOntoWhatIsThere) {
    ClumpScene scene;
    scene.addWall({0, 0, 1}, {0, 0, 23 * d});
    for (const int axis : {0, 1}) scene.setPeriodic(axis, 0, 10 * d);
    Inlet inlet = streamOf(scene);
    Clump clump = scene.clump(dimer(1.8), {0, 0, -2});
    clump.setAngularVelocity({0, 30, 0});
    inlet.setClump(clump);
    inlet.setMassFlow(0.06);
    scene.inletHandler.copyAndAddObject(inlet);
    scene.setTimeStep(2e-6);
    scene.initialise();
    std::uint32_t known = 0;
    for (int k = 0; k < 6000; ++k) {
        scene.step();
        const ParticleStore& grains = scene.particleHandler.store();
        if (grains.nextIdentity() == known) continue;
        ASSERT_GE(scene.leastGapOfBodies(known), 0);
        const RigidBody& last = grains.bodies[grains.bodies.size() - 1];
        ASSERT_EQ(last.velocity, (Vector<double>{0, 0, -2}));
        ASSERT_NEAR(norm(last.spin() - Vector<double>{0, 30, 0}), 0, 1e-12);
        for (; known < grains.nextIdentity(); ++known) {
            const TranslationRecord& grain = grains.translation[grains.place[known]];
            ASSERT_LE(grain.position.z + grain.radius, 23 * d * (1 + 1e-12));
            ASSERT_GE(grain.position.z - grain.radius, 20 * d * (1 - 1e-12));
        }
    }
    EXPECT_GT(known, 300u);
}

// Evenly turned: the mean of u u is 1/3 to five deviations, and S below its bound; or as they are given.
TEST(ClumpInlet, turnsThemEvenlyOrAsGiven) {
    for (const bool isRandom : {true, false}) {
        ClumpScene scene;
        Inlet inlet = streamOf(scene);
        Clump clump = scene.clump(dimer(1.6), {0, 0, -4});
        clump.setOrientation({1, 0.5, 0, 0});
        inlet.setClump(clump);
        inlet.setMassFlow(0.1);
        inlet.setRandomTurns(isRandom);
        scene.inletHandler.copyAndAddObject(inlet);
        scene.setTimeStep(2e-6);
        scene.initialise();
        scene.steps(4000);
        const OrientationOrder order = orientationOrder(scene.particleHandler.store().bodies);
        EXPECT_GT(order.count, 300u);
        if (isRandom) {
            EXPECT_LT(order.value, scenes::mostOrder(order.count));
            continue;
        }
        EXPECT_NEAR(order.value, 1, 1e-12);
        EXPECT_NEAR(std::abs(order.direction.dot(clump.getOrientation() * Vec3D(0, 0, 1))), 1, 1e-12);
    }
}

// Kinds and sizes are counted random numbers of their place in the stream; no order of tries changes them.
TEST(ClumpInlet, bringsMixturesByTheirShares) {
    ClumpScene scene;
    BodyMixture mixture(SizeBasis::Volume);
    mixture.add(scene.clump(dimer(1.4), {0, 0, -4}), equalSizes(d), 3);
    mixture.add(scene.grain({0, 0, -4}), evenSizes(0.5 * d, 0.8 * d), 1);
    Inlet inlet;
    inlet.setRegion(above());
    inlet.setBodies(mixture);
    inlet.setMassFlow(0.1);
    scene.inletHandler.copyAndAddObject(inlet);
    scene.setTimeStep(2e-6);
    scene.initialise();
    scene.steps(6000);
    const ParticleStore& grains = scene.particleHandler.store();
    const InletCount& count = scene.inletHandler.countOf(0);
    const std::size_t clumps = grains.bodies.size(), single = grains.count() - 2 * clumps;
    EXPECT_EQ(clumps + single, count.number);
    EXPECT_GT(count.number, 500u);
    // Of the volume three quarters are clumps: of the number 3 / V1 over 3 / V1 + 1 / V2.
    const double v1 = d * d * d, v2 = evenSizes(0.5 * d, 0.8 * d).moment(3);
    const double share = 3 / v1 / (3 / v1 + 1 / v2), all = static_cast<double>(count.number);
    EXPECT_NEAR(static_cast<double>(clumps), share * all, 5 * std::sqrt(share * (1 - share) * all));
    EXPECT_NEAR(scene.volume() * ClumpScene::density, count.mass, 1e-9 * count.mass);
    EXPECT_LE(count.mass, 0.1 * scene.getTime());
    EXPECT_GT(count.mass, 0.1 * scene.getTime() - massOf(1.001 * d));
}

// The step that is stable for the scene with its clumps is asked for before the first has come.
TEST(ClumpInlet, isKnownToTheStabilityLimit) {
    ClumpScene none, later, now;
    Clump clump = now.clump(dimer(2));
    clump.setScale(0.7 * d / clump.getTemplate().getDiameter());
    for (const double side : {-d, d}) {  // two, so that one may meet another one
        clump.setPosition({side, 0, 0});
        now.bodyHandler.copyAndAddObject(clump);
    }
    Inlet inlet = streamOf(later, 2);
    inlet.setSizes(equalSizes(0.7 * d));
    later.inletHandler.copyAndAddObject(inlet);
    const double most = later.stabilityLimit();
    // Twelve more grains of the size: as many as there may be around one.
    std::vector<SphericalParticle> more(13, now.grain());
    for (SphericalParticle& grain : more) grain.setRadius(clump.getSpheres()[0].getRadius());
    // Each number of the shape is larger by 2/1024, and rounded upwards by 1/512 at most. The squared
    // frequency is a product of three: of the contacts, of the spheres that one touches, whose mean counts
    // three times, and of the room for others.
    constexpr double digit = 2 / 1024.0 + 1 / 512.0;
    EXPECT_NEAR(most / now.stabilityLimit(more), 1, 0.5 * (1 + 3 + 1) * digit);
    EXPECT_LE(most, now.stabilityLimit(more));
    EXPECT_LT(most, none.stabilityLimit(more));
}

TEST(ClumpInlet, refusesWhatCannotBe) {
    const auto refused = [](auto&& change) {
        ClumpScene scene;
        Inlet inlet = streamOf(scene);
        return refusal([&] {
            change(scene, inlet);
            scene.inletHandler.copyAndAddObject(inlet);
            scene.initialise();
        });
    };
    const auto expect = [&](std::string_view words, auto&& change) {
        const std::string text = refused(change);
        EXPECT_TRUE(isOneSentence(text) && contains(text, words)) << text;
    };
    expect("more than its region can let in", [](ClumpScene&, Inlet& inlet) { inlet.setMassFlow(0.08); });
    expect("half of that", [](ClumpScene& scene, Inlet&) { scene.setPeriodic(0, 0, 3 * d); });
    expect("sizes are given twice", [](ClumpScene& scene, Inlet& inlet) {
        BodyMixture mixture;
        mixture.add(scene.grain(), equalSizes(d));
        inlet.setBodies(mixture);
    });
    expect("the species of its grains", [](ClumpScene&, Inlet& inlet) { inlet.setClump(Clump(dimer(1.5))); });
    expect("share = 0", [](ClumpScene& scene, Inlet& inlet) {
        BodyMixture mixture;
        mixture.add(scene.grain(), equalSizes(d), 0);
        inlet.setBodies(mixture);
    });
    expect("does not fit the region", [](ClumpScene&, Inlet& inlet) { inlet.setSizes(equalSizes(8 * d)); });
}

}  // namespace
}  // namespace pendular::clumpInletTest
