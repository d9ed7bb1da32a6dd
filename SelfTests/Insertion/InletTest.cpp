// Inlets, outlets and flux planes: what comes, what goes, and what is counted on the way.
#include <gtest/gtest.h>

#include <fstream>

#include "Kernel/Analysis/Output/GrainFlowFiles.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Insertion/FilledScene.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::inletTest {
namespace {

using scenes::equalSizes;
using scenes::FilledScene;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

constexpr double d = 1e-3;  // m
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SizeDistribution wideSizes() { return evenSizes(0.5 * d, 1.5 * d); }
double massOf(double diameter) { return sphereMass(0.5 * diameter, FilledScene::density); }

Inlet inletOf(const FilledScene& scene, const SizeDistribution& sizes,
              const Vec3D& velocity = Vec3D::Zero()) {
    Inlet inlet;
    inlet.setRegion(BoxRegion({0, 0, 20 * d}, {10 * d, 10 * d, 24 * d}));
    inlet.setSizes(sizes);
    inlet.setGrain(scene.grain(velocity));
    inlet.setMassFlow(0.02);
    return inlet;
}

/// Grains fall through a box without walls, and leave it below.
class Falling : public FilledScene {
public:
    explicit Falling(int threads = 1, double step = 5e-6) : FilledScene(threads) {
        setGravity({0, 0, -9.81});
        setTimeStep(step);
        inletHandler.copyAndAddObject(inletOf(*this, wideSizes(), {0, 0, -1}));
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0});
        outlet.setSizeClasses(std::array{0.8 * d, 1.2 * d});
        outletHandler.copyAndAddObject(outlet);
        fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 10 * d}});
    }
};

TEST(Inlet, bringsTheLargestSumOfWholeGrainsForAnyStep) {
    for (const double step : {5e-6, 4.1e-6, 2.3e-6}) {
        Falling scene(1, step);
        scene.initialise();
        for (int k = 0; k < 3000; ++k) {
            scene.step();
            const InletCount& count = scene.inletHandler.countOf(0);
            const double due = 0.02 * scene.getTime();
            ASSERT_LE(count.mass, due * (1 + 1e-12));
            const double next = sphereMass(wideSizes().drawRadius(CountedRandom(1), count.number), 2500);
            ASSERT_GT(count.mass + next, due * (1 - 1e-12));
        }
        EXPECT_GT(scene.inletHandler.countOf(0).number, 50u);
    }
}

TEST(Inlet, insertedIsInsideAndRemovedAtEachStep) {
    Falling scene;
    scene.initialise();
    for (int k = 0; k < 20000; ++k) {
        scene.step();
        ASSERT_EQ(scene.inletHandler.countOf(0).number,
                  scene.particleHandler.getSize() + scene.outletHandler.removedNumber());
        ASSERT_EQ(scene.inletHandler.countOf(0).number, scene.particleHandler.store().nextIdentity());
    }
    EXPECT_GT(scene.outletHandler.removedNumber(), 200u);
    // Those between the plane in the middle and the outlet.
    std::size_t below = 0;
    for (GrainReference grain : scene.particleHandler) below += grain.getPosition().z() <= 10 * d;
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(0).net(),
              static_cast<std::int64_t>(scene.outletHandler.removedNumber() + below));
    double mass = scene.outletHandler.removedMass();
    for (GrainReference grain : scene.particleHandler) mass += grain.getMass();
    EXPECT_NEAR(mass, scene.inletHandler.countOf(0).mass, 1e-12 * mass);
    // Even sizes from 0.5 to 1.5 d: 0.3, 0.4, 0.3 of the grains in the classes (five deviations).
    const GrainTally& tally = scene.outletHandler.countOf(0);
    const auto all = static_cast<double>(tally.all().number);
    EXPECT_NEAR(static_cast<double>(tally.of(0, 0).number), 0.3 * all, 5 * std::sqrt(0.21 * all));
    EXPECT_NEAR(static_cast<double>(tally.of(0, 1).number), 0.4 * all, 5 * std::sqrt(0.24 * all));
    EXPECT_EQ(tally.of(0, 0).number + tally.of(0, 1).number + tally.of(0, 2).number, tally.all().number);
}

TEST(Inlet, givesTheSameBitsForAnyThreadsAndThroughRestarts) {
    const TestFolder folder;
    Falling whole;
    whole.initialise();
    whole.steps(5000);
    whole.writeRestart(folder.path() / "half.h5");
    whole.steps(5000);
    whole.writeRestart(folder.path() / "whole.h5");
    for (const int threads : {1, 3}) {
        Falling restarted(threads);
        restarted.restartFrom(folder.path() / "half.h5");
        restarted.initialise();
        restarted.steps(5000);
        restarted.writeRestart(folder.path() / "again.h5");
        support::expectSameState(folder.path() / "whole.h5", folder.path() / "again.h5");
    }
    FilledScene none;
    none.setGravity({0, 0, -9.81});
    none.setTimeStep(5e-6);
    none.restartFrom(folder.path() / "half.h5");
    EXPECT_TRUE(isOneSentence(refusal([&] { none.initialise(); })));
}

TEST(Inlet, putsNothingOntoWhatIsThere) {
    Falling scene;
    scene.addWall({0, 0, 1}, {0, 0, 23 * d});
    scene.initialise();
    std::uint32_t known = 0;
    for (int k = 0; k < 4000; ++k) {
        scene.step();
        const ParticleStore& grains = scene.particleHandler.store();
        for (; known < grains.nextIdentity(); ++known) {
            const TranslationRecord& grain = grains.translation[grains.place[known]];
            ASSERT_LE(grain.position.z + grain.radius, 23 * d * (1 + 1e-12));
            for (const std::uint32_t at : grains.place) {
                if (grains.identity[at] == known) continue;
                const TranslationRecord& other = grains.translation[at];
                ASSERT_GE(norm(other.position - grain.position), other.radius + grain.radius);
            }
        }
    }
    EXPECT_GT(known, 200u);
}

TEST(Inlet, seesWallsOnTheOtherSideOfAPeriodicFace) {
    FilledScene scene;
    scene.setPeriodic(0, 0, 20 * d);
    scene.addMesh({d, 4 * d, 4 * d}, {6 * d, 16 * d, 16 * d});
    Inlet inlet;
    inlet.setRegion(BoxRegion({18 * d, 0, 0}, {28 * d, 20 * d, 20 * d}));
    inlet.setSizes(equalSizes(d)), inlet.setGrain(scene.grain()), inlet.setNumberFlow(1e6);
    inlet.setTries(10'000);
    scene.inletHandler.copyAndAddObject(inlet);
    scene.initialise();
    scene.steps(300);  // none overlaps the wall, which would end the run
    EXPECT_GE(scene.inletHandler.countOf(0).number, 299u);
    for (GrainReference grain : scene.particleHandler)
        EXPECT_GE(scene.gapToMesh(toVector(grain.getPosition())), 0.5 * d * (1 - 1e-12));
}

// Grains at rest fill a periodic region across its faces until no try finds room.
TEST(Inlet, putsNothingOntoPeriodicImages) {
    FilledScene scene;
    PeriodicBox periodic;
    periodic.length = {6 * d, 6 * d, 6 * d};
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, 6 * d);
    Inlet inlet;
    inlet.setRegion(BoxRegion({-2 * d, -2 * d, -2 * d}, {4 * d, 4 * d, 4 * d}));
    inlet.setSizes(wideSizes());
    inlet.setGrain(scene.grain());
    inlet.setNumberFlow(2e6);
    scene.inletHandler.copyAndAddObject(inlet);
    scene.initialise();
    scene.steps(300);
    EXPECT_TRUE(scene.inletHandler.countOf(0).waits);
    EXPECT_GT(scene.particleHandler.getSize(), 60u);
    EXPECT_GE(scene.leastGap(periodic), -1e-15 * d);
    std::size_t cut = 0;
    for (const TranslationRecord& grain : scene.particleHandler.store().translation)
        cut += std::abs(periodic.nearest(grain.position).x) < grain.radius;
    EXPECT_GT(cut, 5u);
}

/// A large grain fills the inlet's region, until it is taken away.
class Blocked : public FilledScene {
public:
    explicit Blocked(NoRoom noRoom) {
        Inlet inlet;
        inlet.setRegion(SphereRegion({0, 0, 0}, 10 * d));
        inlet.setSizes(equalSizes(d));
        inlet.setGrain(grain());
        inlet.setNumberFlow(1000);
        inlet.setTimes(0.01, 0.05);
        inlet.setNoRoom(noRoom);
        inlet.setTries(20);
        inletHandler.copyAndAddObject(inlet);
        SphericalParticle plug = grain();
        plug.setRadius(10 * d), plug.fixParticle();
        particleHandler.copyAndAddObject(plug);
        setTimeStep(1e-5);
        initialise();
    }
    void actionsAfterTimeStep() override {
        // Grains stay where they come: they are held, and far enough from each other.
        if (getTime() > 0.0301 && particleHandler.contains(0)) particleHandler.removeObject(0);
    }
    [[nodiscard]] std::size_t numberAt(double time) {
        while (getTime() < time - 0.5 * getTimeStep()) step();
        return inletHandler.countOf(0).number;
    }
};

TEST(Inlet, makesUpForLackOfRoomOrLosesIt) {
    Blocked later(NoRoom::Later);
    EXPECT_EQ(later.numberAt(0.03), 0u);
    EXPECT_TRUE(later.inletHandler.countOf(0).waits);
    EXPECT_EQ(later.numberAt(0.0305), 20u);  // 1000/s since 0.01 s
    EXPECT_EQ(later.numberAt(0.0405), 30u);
    EXPECT_EQ(later.numberAt(0.06), 40u);
    EXPECT_EQ(later.inletHandler.countOf(0).lost, 0);
    Blocked lost(NoRoom::Lost);
    EXPECT_EQ(lost.numberAt(0.03), 0u);
    // The grain that waited comes at once; the next one after 1 ms.
    EXPECT_EQ(lost.numberAt(0.0305), 1u);
    EXPECT_EQ(lost.numberAt(0.0405), 11u);
    EXPECT_EQ(lost.numberAt(0.06), 20u);
    EXPECT_NEAR(lost.inletHandler.countOf(0).lost, 19.1, 0.05);
}

TEST(Inlet, saysOnceThatThereIsNoRoom) {
    Blocked scene(NoRoom::Later);
    scene.setQuiet(false);
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(scene.numberAt(0.0301), 0u);
    const std::string said = ::testing::internal::GetCapturedStderr();
    EXPECT_TRUE(contains(said, "inlet 0: at 0.011")) << said;
    EXPECT_TRUE(contains(said, "0 grains, 0 kg, had come; the flow of such times is made up for later."));
    EXPECT_EQ(said.find("inlet 0"), said.rfind("inlet 0"));
}

TEST(Inlet, isRefusedWhereItCannotBe) {
    const auto refused = [](const auto& change, std::string_view part) {
        FilledScene scene;
        scene.setTimeStep(1e-6);
        scene.addWall({0, 0, -1}, {0, 0, 0});
        Inlet inlet = inletOf(scene, wideSizes(), {0, 0, -1});
        const std::string text = refusal([&] {
            change(inlet, scene);
            scene.inletHandler.copyAndAddObject(inlet);
            scene.initialise();
        });
        EXPECT_TRUE(isOneSentence(text)) << part;
        EXPECT_TRUE(contains(text, part));
    };
    using S = FilledScene;
    // 0.25 * 2500 kg/m^3 * 1 m/s * 1e-4 m^2
    refused([](Inlet& i, S&) { i.setMassFlow(0.0626); }, "at most 0.0625 kg/s, a solid fraction of 0.25");
    refused([](Inlet& i, S&) { i.setNumberFlow(1e6); }, "at most 0.0625 kg/s");
    refused([](Inlet& i, S&) { i.setSizes(equalSizes(5 * d)); }, "does not fit the region");
    refused([](Inlet& i, S&) { i.setRegion(BoxRegion({0, 0, -9 * d}, {9 * d, 9 * d, 0})); }, "behind wall 0");
    refused([](Inlet& i, S&) { i = Inlet(); }, "its region is not set");
    refused([](Inlet& i, S&) { i.setGrain(SphericalParticle()); }, "the species of its grains");
    refused([](Inlet&, S& s) { s.setTimeStep(1e-3); }, "is above the stability limit");
    for (const double bad : {nan, infinity, 0.0, -1.0}) {
        refused([&](Inlet& i, S&) { i.setMassFlow(bad); }, "mass flow");
        refused([&](Inlet& i, S&) { i.setNumberFlow(bad); }, "number flow");
    }
    refused([](Inlet& i, S&) { i.setTimes(nan, 1); }, "first time");
    refused([](Inlet& i, S&) { i.setTimes(2, 1); }, "last time");
    refused([](Inlet& i, S&) { i.setTries(0); }, "number of tries");
    refused([](Inlet&, S& s) { static_cast<void>(s.inletHandler.countOf(1)); }, "There is no inlet 1");
    FilledScene scene;
    scene.initialise();
    EXPECT_TRUE(
        isOneSentence(refusal([&] { scene.inletHandler.copyAndAddObject(inletOf(scene, wideSizes())); })));
    // 0.0625 kg/s is let in.
    Falling exact;
    Inlet full = inletOf(exact, wideSizes(), {0, 0, -1});
    full.setMassFlow(0.0625);
    exact.inletHandler.copyAndAddObject(full);
    exact.initialise();
}

TEST(Inlet, theStabilityLimitKnowsTheSizesToCome) {
    FilledScene scene;
    scene.inletHandler.copyAndAddObject(inletOf(scene, wideSizes()));
    FilledScene same;
    same.initialise();
    std::vector<SphericalParticle> toCome;
    for (int k = 0; k < 20; ++k) {
        toCome.push_back(same.grain());
        toCome.back().setRadius(k < 10 ? 0.25 * d : 0.75 * d);
    }
    EXPECT_DOUBLE_EQ(scene.stabilityLimit(), same.stabilityLimit(toCome));
    EXPECT_LT(scene.stabilityLimit(), infinity);
}

TEST(Outlet, takesWhatIsInARegionExceptWhatIsHeld) {
    FilledScene scene;
    Outlet outlet;
    outlet.setRegion(SphereRegion({0, 0, 0}, 3 * d));
    scene.outletHandler.copyAndAddObject(outlet);
    const auto add = [&](double x, double y, bool fixed) {
        SphericalParticle grain = scene.grain({-1, 0, 0});
        grain.setRadius(0.5 * d), grain.setPosition({x, y, 0});
        if (fixed) grain.fixParticle();
        scene.particleHandler.copyAndAddObject(grain);
    };
    add(4 * d, 0, false), add(0, 2.5 * d, true), add(9 * d, 0, false);
    scene.setTimeMax(3e-3);
    scene.solve();
    EXPECT_FALSE(scene.particleHandler.contains(0));
    EXPECT_TRUE(scene.particleHandler.contains(1));
    EXPECT_TRUE(scene.particleHandler.contains(2));
    EXPECT_EQ(scene.outletHandler.removedNumber(), 1u);
    EXPECT_DOUBLE_EQ(scene.outletHandler.removedMass(), massOf(d));
}

TEST(Outlet, theEnergyOfWhatLeavesIsInTheLedger) {
    Falling scene;
    scene.keepEnergyLedger();
    scene.addWall({0, 0, -1}, {0, 0, 0});  // grains pile up on a floor, and leave from a heap
    Outlet hole;
    hole.setRegion(SphereRegion({5 * d, 5 * d, 0}, 3 * d));
    scene.outletHandler.copyAndAddObject(hole);
    scene.initialise();
    double largest = 0;
    const double before = scene.energyLedger().closed();
    for (int k = 0; k < 16000; ++k) {
        scene.step();
        largest = std::max(largest, scene.energyLedger().kinetic);
    }
    EXPECT_GT(scene.outletHandler.removedNumber(), 20u);
    EXPECT_NE(scene.energyLedger().driver, 0);
    // Round-off of 16000 steps and some 400 grains, as the ledger's own tests have it: 1e-16 for each sum.
    EXPECT_NEAR(scene.energyLedger().closed(), before, 16000 * 400 * 1e-16 * largest);
}

// A region that begins in one period and ends in the next one, and grains that have left the box by one, two
// or no periods.
TEST(Outlet, takesImagesAsTheyAre) {
    FilledScene scene;
    scene.setPeriodic(0, 0, 20 * d), scene.setPeriodic(1, 0, 20 * d);
    Outlet outlet;
    outlet.setRegion(BoxRegion({38 * d, 0, 0}, {42 * d, 20 * d, 20 * d}));
    scene.outletHandler.copyAndAddObject(outlet);
    const auto add = [&](double x, double y, const Vec3D& velocity) {
        SphericalParticle grain = scene.grain(velocity);
        grain.setRadius(0.5 * d), grain.setPosition({x, y, 10 * d});
        scene.particleHandler.copyAndAddObject(grain);
    };
    // In the region, two of them beyond a face of the box; and outside of it on both sides.
    add(d, 2 * d, {0, 0, 0}), add(19 * d, 4 * d, {0, 0, 0}), add(21 * d, 6 * d, {0, 0, 0});
    add(3 * d, 8 * d, {0, 0, 0}), add(17 * d, 10 * d, {0, 0, 0});
    // It goes into the region through the face, 1.9 d in 19 steps of 0.1 d.
    add(17 * d, 12 * d, {10, 0, 0}), add(3 * d, 19.9 * d, {-10, 1, 0});
    scene.setTimeStep(1e-5);
    scene.initialise();
    scene.step();
    EXPECT_EQ(scene.outletHandler.removedNumber(), 3u);
    scene.steps(20);
    EXPECT_EQ(scene.outletHandler.removedNumber(), 5u);
    for (const std::size_t k : {3u, 4u}) EXPECT_TRUE(scene.particleHandler.contains(k));
}

TEST(Outlet, isRefusedWhereTheSceneCannotHaveIt) {
    const auto refused = [](const auto& change, std::string_view part) {
        FilledScene scene;
        for (const double x : {2 * d, 4 * d}) {
            SphericalParticle grain = scene.grain();
            grain.setRadius(0.5 * d), grain.setPosition({x, d, d});
            scene.particleHandler.copyAndAddObject(grain);
        }
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0});
        change(scene, outlet);
        scene.outletHandler.copyAndAddObject(outlet);
        const std::string text = refusal([&] { scene.initialise(); });
        EXPECT_TRUE(isOneSentence(text)) << part;
        EXPECT_TRUE(contains(text, part)) << text;
    };
    refused([](FilledScene& s, Outlet&) { s.setPeriodic(2, 0, 9 * d); }, "outlet 0: the normal of its plane");
    refused(
        [](FilledScene& s, Outlet& o) {
            s.setPeriodic(1, 0, 9 * d);
            o.setPlane({0, 1, -9}, {0, 0, 0});
        },
        "along y, along which the scene repeats itself");
    refused(
        [](FilledScene& s, Outlet& o) {
            s.setPeriodic(0, 0, 9 * d);
            o.setRegion(SphereRegion({0, 0, 0}, 5 * d));
        },
        "longer than the period");
}

using WetScene = Simulation<LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies>;

/// Wet grains come one by one, far from each other; each brings more liquid than all bridges could hold.
void letWetGrainsCome(WetScene& scene, double toCome) {
    auto* const material = scene.speciesHandler.copyAndAddObject({});
    material->setDensity(2500), material->setStiffness(60), material->setDissipation(1e-3);
    material->setSlidingStiffness(16), material->setSlidingFrictionCoefficient(0.4);
    material->setLiquidBridgeVolumeMax(1e-18), material->setContactAngle(0.3);
    material->setSurfaceTension(0.072);
    SphericalParticle grain;
    grain.setSpecies(material), grain.setLiquidVolume(1e-12), grain.setVelocity({0, 0, -1});
    Inlet inlet;
    inlet.setRegion(BoxRegion({0, 0, 0}, {20 * d, 20 * d, 20 * d}));
    inlet.setSizes(equalSizes(d)), inlet.setGrain(grain);
    inlet.setMassFlow(1000 * massOf(d));  // 1000 grains/s
    scene.inletHandler.copyAndAddObject(inlet);
    if (toCome > 0) scene.setLiquidToCome(toCome);
    scene.setTimeStep(std::min(1e-5, scene.stabilityLimit())), scene.setTimeMax(0.1), scene.setQuiet();
    scene.initialise();
}

// 100 grains of 1 nl; without them it would be 2^20 bridges, 1 nl.
TEST(Inlet, theLiquidOfItsGrainsIsKnownToCome) {
    WetScene scene;
    letWetGrainsCome(scene, 0);
    while (scene.getTime() < 0.0995) scene.step();
    EXPECT_EQ(scene.inletHandler.countOf(0).number, 99u);
    EXPECT_NEAR(scene.liquidLedger().absorbed, 99e-12, 1e-12 * 99e-12);
}

TEST(Inlet, endsTheRunBeforeAStepWhenNoMoreLiquidCanBeCounted) {
    WetScene scene;
    letWetGrainsCome(scene, 10e-12);
    std::string text;
    Vec3D before = Vec3D::Zero();
    double time = 0;
    for (int k = 0; k < 100'000 && text.empty(); ++k) {
        time = scene.getTime();
        if (scene.particleHandler.contains(0)) before = scene.particleHandler.getObject(0).getPosition();
        try {
            scene.step();
        } catch (const RunError& end) {
            text = end.what();
        }
    }
    EXPECT_TRUE(contains(text, "say by setLiquidToCome()")) << text;
    EXPECT_GE(scene.inletHandler.countOf(0).number, 10u);
    EXPECT_EQ(scene.getTime(), time);
    EXPECT_EQ(scene.particleHandler.getObject(0).getPosition(), before);
    EXPECT_EQ(scene.inletHandler.countOf(0).number, scene.particleHandler.getSize());
    EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
    FilledScene dry;
    Inlet inlet = inletOf(dry, wideSizes());
    SphericalParticle wet = dry.grain();
    wet.setLiquidVolume(1e-12);
    inlet.setGrain(wet);
    dry.inletHandler.copyAndAddObject(inlet);
    EXPECT_TRUE(contains(refusal([&] { dry.initialise(); }), "inlet 0: the liquid volume of its grains"));
}

// A step that fails is no part of the run: its crossing is counted when it is made again.
TEST(FluxPlane, countsNothingOfAStepThatFails) {
    FilledScene scene;
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, 1}, {0, 0, 1.5e-6}});
    for (const Vec3D& velocity : {Vec3D(0, 0, 1), Vec3D(0, 0, 0)}) {
        SphericalParticle grain = scene.grain(velocity);
        grain.setRadius(0.5 * d), grain.setPosition({velocity.z() * 20 * d, 0, 0});
        scene.particleHandler.copyAndAddObject(grain);
    }
    scene.initialise();
    scene.step();
    scene.particleHandler.getObject(1).setVelocity({1e6, 0, 0});  // farther than a radius in a step
    EXPECT_THROW(scene.step(), RunError);
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(0).forwards, 0u);
    scene.particleHandler.getObject(1).setVelocity({0, 0, 0});
    scene.steps(2);
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(0).forwards, 1u);
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(0).massForwards, massOf(d));
}

/// Wet grains come onto a floor, touch and share their liquid, and leave through a hole.
TEST(Outlet, theLiquidOfWhatComesAndLeavesIsInTheLedger) {
    Simulation<LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies> scene;
    auto* const material = scene.speciesHandler.copyAndAddObject({});
    material->setDensity(2500), material->setStiffness(60), material->setDissipation(1e-3);
    material->setSlidingStiffness(16), material->setSlidingFrictionCoefficient(0.4);
    material->setLiquidBridgeVolumeMax(4e-12), material->setContactAngle(0.3);
    material->setSurfaceTension(0.072);
    InfiniteWall floor;
    floor.setSpecies(material), floor.set({0, 0, -1}, {0, 0, 0});
    scene.wallHandler.copyAndAddObject(floor);
    SphericalParticle grain;
    grain.setSpecies(material), grain.setLiquidVolume(1e-12), grain.setVelocity({0, 0, -1});
    Inlet inlet;
    inlet.setRegion(BoxRegion({0, 0, 8 * d}, {6 * d, 6 * d, 12 * d}));
    inlet.setSizes(wideSizes()), inlet.setGrain(grain), inlet.setMassFlow(0.015);
    scene.inletHandler.copyAndAddObject(inlet);
    Outlet hole;
    hole.setRegion(SphereRegion({3 * d, 3 * d, 0}, 2.5 * d));
    scene.outletHandler.copyAndAddObject(hole);
    scene.setLiquidToCome(1e-9);
    scene.setGravity({0, 0, -9.81});
    scene.setTimeStep(std::min(5e-6, scene.stabilityLimit())), scene.setTimeMax(1), scene.setQuiet();
    scene.initialise();
    bool hadBridges = false;
    for (int k = 0; k < 12000; ++k) {
        scene.step();
        const LiquidLedger ledger = scene.liquidLedger();
        ASSERT_EQ(ledger.unaccounted(), 0) << k;
        hadBridges |= ledger.bridges > 0;
    }
    EXPECT_TRUE(hadBridges);
    EXPECT_GT(scene.outletHandler.removedNumber(), 20u);
    EXPECT_GT(scene.liquidLedger().removed, 15e-12);
    EXPECT_NEAR(scene.liquidLedger().absorbed,
                1e-12 * static_cast<double>(scene.inletHandler.countOf(0).number),
                1e-15 * static_cast<double>(scene.inletHandler.countOf(0).number));
}

TEST(Outlet, writesWhatHasGoneAsATable) {
    const TestFolder folder;
    Falling scene;
    scene.setName((folder.path() / "run").string());
    scene.addOutput(OutletFile(0.02));
    scene.addOutput(FluxFile(0.02));
    scene.addOutput(InletFile(0.02));
    scene.setTimeMax(0.08);
    scene.solve();
    std::ifstream table(folder.path() / "run-outlets.csv"), flux(folder.path() / "run-flux.csv"),
        inlets(folder.path() / "run-inlets.csv");
    const auto lines = [](std::ifstream& file) {
        std::vector<std::string> all;
        for (std::string line; std::getline(file, line);) all.push_back(line);
        return all;
    };
    const auto rows = lines(table);
    ASSERT_EQ(rows.size(), 1u + 5 * 3);
    EXPECT_EQ(rows[0], "time_s,outlet,species,diameter_from_m,diameter_to_m,number,mass_kg");
    const GrainTally::Entry last = scene.outletHandler.countOf(0).of(0, 2);
    EXPECT_GT(last.number, 0u);
    EXPECT_TRUE(contains(rows.back(), fmt::format(",0,0,0.0012,inf,{},", last.number)));
    EXPECT_EQ(lines(flux).size(), 1u + 5);
    EXPECT_EQ(lines(inlets).size(), 1u + 5);
}

TEST(Outlet, isRefusedWhereItCannotBe) {
    FilledScene scene;
    EXPECT_TRUE(isOneSentence(refusal([&] { scene.outletHandler.copyAndAddObject(Outlet()); })));
    Outlet outlet;
    EXPECT_TRUE(isOneSentence(refusal([&] { outlet.setPlane({0, 0, 0}, {0, 0, 0}); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { outlet.setPlane({0, 0, 1}, {0, nan, 0}); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { outlet.setSizeClasses(std::array{2 * d, d}); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { outlet.setSizeClasses(std::array{nan}); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { static_cast<void>(scene.outletHandler.countOf(0)); })));
    scene.initialise();
    outlet.setPlane({0, 0, 1}, {0, 0, 0});
    EXPECT_TRUE(isOneSentence(refusal([&] { scene.outletHandler.copyAndAddObject(outlet); })));
}

TEST(FluxPlane, countsALatticeThatGoesThrough) {
    FilledScene scene;
    // 6 x 6 x 40 grains, 2 d apart, at 1 m/s along z.
    for (int x = 0; x < 6; ++x)
        for (int y = 0; y < 6; ++y)
            for (int z = 0; z < 40; ++z) {
                SphericalParticle grain = scene.grain({0, 0, 1});
                grain.setRadius(0.5 * d), grain.setPosition({2 * d * x, 2 * d * y, -2 * d * (z + 0.5)});
                scene.particleHandler.copyAndAddObject(grain);
            }
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, 3}, {7, 7, 0}});
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 0}});
    scene.setTimeStep(1e-5);
    scene.initialise();
    scene.steps(5000);  // 50 mm: 25 layers
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(0).forwards, 36u * 25);
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(0).backwards, 0u);
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(1).net(), -36 * 25);
    EXPECT_NEAR(scene.fluxPlaneHandler.countOf(0).netMass(), 36 * 25 * massOf(d),
                1e-12 * 36 * 25 * massOf(d));
}

TEST(FluxPlane, ofAGrainThatSwingsNetsNothing) {
    FilledScene scene;
    SphericalParticle grain = scene.grain();
    grain.setRadius(0.5 * d), grain.fixParticle();
    scene.particleHandler.copyAndAddObject(grain);
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{1, 0, 0}, {0, 0, 0}});
    scene.setTimeStep(1e-5);
    scene.initialise();
    for (int k = 0; k < 4001; ++k) {  // it is held, and moves with the velocity that it is given
        scene.particleHandler.getObject(0).setVelocity({k % 4 < 2 ? -1.0 : 1.0, 0, 0});
        scene.step();
    }
    const FluxCount& count = scene.fluxPlaneHandler.countOf(0);
    EXPECT_GE(count.forwards, 999u);
    EXPECT_GE(count.backwards, 999u);
    EXPECT_LE(std::abs(count.net()), 1);
}

TEST(FluxPlane, takesNoJumpAcrossAPeriodForACrossing) {
    FilledScene scene;
    scene.setPeriodic(0, 0, 10 * d);
    SphericalParticle grain = scene.grain({1, 0, 0});
    grain.setRadius(0.5 * d), grain.setPosition({9 * d, 0, 0});
    scene.particleHandler.copyAndAddObject(grain);
    for (const double x : {0.0, 0.5 * d, 5 * d, 10 * d, 23 * d})
        scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{1, 0, 0}, {x, 0, 0}});
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{-1, 0, 0}, {2 * d, 0, 0}});
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 1, 0}, {0, 1 * d, 0}});
    scene.setTimeStep(1e-5);
    scene.initialise();
    scene.steps(9999);  // 99.99 mm: ten times round, less than a step to the start
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_EQ(scene.fluxPlaneHandler.countOf(k).forwards, 10u) << k;
        EXPECT_EQ(scene.fluxPlaneHandler.countOf(k).backwards, 0u) << k;
    }
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(5).net(), -10);
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(6).net(), 0);
    scene.particleHandler.getObject(0).setPosition({3 * d, 0, 0});  // a hook's jump is none, either
    scene.step();
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(5).net(), -10);

    FilledScene inclined;
    inclined.setPeriodic(0, 0, 10 * d);
    inclined.fluxPlaneHandler.copyAndAddObject(FluxPlane{{1, 1, 0}, {0, 0, 0}});
    EXPECT_TRUE(isOneSentence(refusal([&] { inclined.initialise(); })));
    EXPECT_TRUE(isOneSentence(refusal([&] {
        scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, nan, 0}, {0, 0, 0}});
    })));
}

// A silo that is filled and emptied ten times: what it takes is that of its fullest time.
TEST(Outlet, theMemoryOfASceneThatIsFilledAndEmptiedStaysFlat) {
    FilledScene scene;
    scene.setTimeStep(1e-5);
    Outlet outlet;
    outlet.setPlane({0, 0, -1}, {0, 0, -d});
    scene.outletHandler.copyAndAddObject(outlet);
    scene.addWall({0, 0, -1}, {0, 0, -20 * d});
    scene.initialise();
    const BoxRegion box({0, 0, 0}, {10 * d, 10 * d, 10 * d});
    std::vector<std::size_t> most;  // bytes, in each round
    for (int round = 0; round < 12; ++round) {
        const Inserted made =
            scene.insert(equalSizes(d), box, Amount::solidFraction(0.3), scene.grain({0, 0, -1}));
        EXPECT_EQ(made.number, made.wanted);
        most.push_back(0);
        while (scene.particleHandler.getSize() > 0) {
            scene.step();
            most.back() = std::max(most.back(), scene.particleHandler.store().bytes());
        }
    }
    EXPECT_EQ(scene.outletHandler.removedNumber(), 12u * 572);
    // But for the index of identities, of which a thousand that are gone take 28 bytes, in a vector that
    // doubles.
    EXPECT_LE(most.back(), most.front() + 2 * 28 * (12 * 572 / 1024 + 1));
    EXPECT_GT(most.front(), 572u * 64);
}

}  // namespace
}  // namespace pendular::inletTest
