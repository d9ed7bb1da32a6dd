// Whole runs that several ranks do together: their files are those of one process, byte for byte, and they go
// on from each other's restart files.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <thread>

#include "SelfTests/Ranks/SharedRuns.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/SameFiles.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::runOnRanksTest {
namespace {

using namespace support;
using namespace ranks;
namespace fs = std::filesystem;

template <class SomeRun = SharedRun>
void runOn(std::size_t ranks, const fs::path& folder, std::size_t steps, const RankOptions& options = {}) {
    VirtualRanks(ranks).run([&](Exchange& exchange) {
        SomeRun run(folder, steps);
        run.setRanks(exchange, options);
        run.solve();
    });
}

TEST(RunOnRanks, writesTheFilesOfOneProcess) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "1";
    SharedRun(serial, whole).solve();
    EXPECT_GT(filesOf(serial).size(), 10u);
    for (const std::size_t ranks : {2u, 3u}) {
        const fs::path own = folder.path() / fmt::format("{}", ranks);
        SCOPED_TRACE(fmt::format("{} ranks", ranks));
        runOn(ranks, own, whole, {.cutsWander = ranks == 3});
        expectSameFiles(serial, own);
    }
}

TEST(RunOnRanks, writesTheFilesOfBodiesAndEnergy) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "1";
    RichRun alone(serial, whole);
    alone.solve();
    EXPECT_GT(alone.energyLedger().lost(), 0);
    EXPECT_GT(alone.outletHandler.countOf(0).all().number, 0u);
    for (const std::size_t ranks : {2u, 3u}) {
        const fs::path own = folder.path() / fmt::format("{}", ranks), parts = folder.path() / "parts";
        SCOPED_TRACE(fmt::format("{} ranks", ranks));
        runOn<RichRun>(ranks, own, whole, {.cutsWander = ranks == 3});
        expectSameFiles(serial, own);
        fs::remove_all(parts);
        runOn<RichRun>(ranks, parts, half);
        runOn<RichRun>(5 - ranks, parts, whole);
        expectSameState(serial / "run-restart.h5", parts / "run-restart.h5");
    }
}

TEST(RunOnRanks, writesTheFilesOfLiquidThatMovesAndOfEvents) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "1";
    MovingRun alone(serial, whole);
    alone.solve();
    EXPECT_GT(alone.contactEventCounts().bridgesRuptured, 20u);
    EXPECT_GT(alone.liquidLedger().removed, 0);
    EXPECT_NE(alone.liquidLedger().walls, 0);
    EXPECT_GT(alone.inletHandler.countOf(0).number, 10u);
    EXPECT_GT(alone.contacts().overlaps().countAbove(), 0u);
    for (const std::size_t ranks : {2u, 3u}) {
        const fs::path own = folder.path() / fmt::format("{}", ranks);
        SCOPED_TRACE(fmt::format("{} ranks", ranks));
        runOn<MovingRun>(ranks, own, whole, {.cutsWander = ranks == 3});
        expectSameFiles(serial, own);
    }
}

/// Two ranks go on with what three have begun, and the other way round, with cuts that wander.
template <class SomeRun>
void expectToGoOnWith(const fs::path& serial, const fs::path& folder) {
    for (const std::size_t ranks : {2u, 3u}) {
        const fs::path own = folder / fmt::format("{}", ranks);
        SCOPED_TRACE(fmt::format("{} ranks", ranks));
        runOn<SomeRun>(ranks, own, half, {.cutsWander = ranks == 3});
        runOn<SomeRun>(5 - ranks, own, whole, {.cutsWander = ranks == 2});
        EXPECT_EQ(contentOf(serial / "table.csv"), contentOf(own / "table.csv"));
        EXPECT_TRUE(contentOf(serial / "run-restart.h5") == contentOf(own / "run-restart.h5"));
    }
}

TEST(RunOnRanks, conductsHeat) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "1";
    HeatedRun alone(serial, whole);
    alone.solve();
    EXPECT_GT(alone.heat->ledger().fromWalls, 0);
    EXPECT_GT(alone.heat->ledger().fromContacts, 0);
    expectToGoOnWith<HeatedRun>(serial, folder.path());
}

TEST(RunOnRanks, bondsGrains) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "1";
    BondedRun alone(serial, whole);
    alone.solve();
    EXPECT_GT(alone.bonds->broken(), 1u);
    EXPECT_GT(alone.bonds->all().size(), 3u);
    EXPECT_GT(alone.outletHandler.countOf(0).all().number, 0u);
    expectToGoOnWith<BondedRun>(serial, folder.path());
}

/// From a restart file of each number of ranks on each other one.
template <class SomeRun>
void expectToGoOnFromEach() {
    const TestFolder folder;
    const fs::path serial = folder.path() / "serial";
    SomeRun(serial, whole).solve();
    for (const std::size_t first : {1u, 2u, 3u, 4u}) {
        const fs::path begun = folder.path() / fmt::format("{}", first);
        runOn<SomeRun>(first, begun, half);
        for (const std::size_t second : {1u, 2u, 3u, 4u}) {
            const fs::path own = folder.path() / fmt::format("{}-{}", first, second);
            SCOPED_TRACE(fmt::format("{} ranks, then {}", first, second));
            fs::copy(begun, own);
            runOn<SomeRun>(second, own, whole);
            expectSameFiles(serial, own);
        }
    }
}

TEST(RunOnRanks, goesOnFromTheFilesOfAnyNumber) { expectToGoOnFromEach<SharedRun>(); }
TEST(RunOnRanks, goesOnWithLiquidInletAndOutlet) { expectToGoOnFromEach<MovingRun>(); }
TEST(LongRunOnRanks, goesOnWithDryGrains) { expectToGoOnFromEach<DryRun>(); }
TEST(LongRunOnRanks, goesOnWithBodiesAndEnergy) { expectToGoOnFromEach<RichRun>(); }
TEST(LongRunOnRanks, goesOnWithBodiesThatCome) { expectToGoOnFromEach<ClumpRun>(); }
TEST(LongRunOnRanks, goesOnWithASpray) { expectToGoOnFromEach<SprayedRun>(); }
TEST(LongRunOnRanks, goesOnWithHeat) { expectToGoOnFromEach<HeatedRun>(); }
TEST(LongRunOnRanks, goesOnWithBonds) { expectToGoOnFromEach<BondedRun>(); }

/// Between parts of a run, and in a hook after gather(), all is there on all ranks, and may be changed.
TEST(RunOnRanks, mayBeChangedBetweenParts) {
    const auto runParts = [](SharedRun& run) {
        run.runSteps(100);
        EXPECT_EQ(run.particleHandler.getSize(), 96u);
        run.particleHandler.removeObject(5);
        run.particleHandler.getObject(7).setVelocity({0.03, 0, 0.1});
        run.runSteps(100);
        run.setTimeStep(0x1p-18);
        run.runSteps(50);
        run.finishRun();
        return stateHash(run.particleHandler.store());
    };
    const TestFolder folder;
    SharedRun alone(folder.path() / "1", whole);
    const std::uint64_t expected = runParts(alone);
    VirtualRanks(3).run([&](Exchange& exchange) {
        SharedRun run(folder.path() / "3", whole);
        run.setRanks(exchange, {});
        EXPECT_EQ(runParts(run), expected);
        EXPECT_EQ(run.rankCounts().unequal, 0u);
    });
    expectSameState(folder.path() / "1/run-restart.h5", folder.path() / "3/run-restart.h5");
}

/// A cloud that becomes twice as long along x: with the first cuts, one half of space would have three
/// quarters of the grains in the end. Cuts are made anew where a rank has a tenth more than the mean; the
/// list at which that is found comes a little later.
class GrowingCloud : public Simulation<LinearViscoelasticSpecies> {
public:
    static constexpr int perSide = 16, grains = perSide * perSide * perSide;

    GrowingCloud() {
        auto* const species =
            speciesHandler.copyAndAddObject(scenes::boxMaterial<LinearViscoelasticSpecies>(0));
        SphericalParticle grain;
        grain.setSpecies(species);
        grain.setRadius(1e-3);
        for (int k = 0; k < grains; ++k) {
            const double x = k % perSide, y = k / perSide % perSide, z = k / perSide / perSide;
            grain.setPosition(2.5e-3 * Vec3D(x + y / perSide + z / perSide / perSide, y, z));  // all differ
            grain.setVelocity({500 * grain.getPosition().x(), 0, 0});
            particleHandler.copyAndAddObject(grain);
        }
        setTimeStep(1e-5);
        setQuiet();
    }
};

TEST(RunOnRanks, divideTheLoadAgain) {
    std::array<double, 4> loads{};
    VirtualRanks(4).run([&](Exchange& exchange) {
        GrowingCloud scene;
        scene.setRanks(exchange, {.balanceAfter = infinity});
        scene.initialise();
        scene.step(200);
        loads[exchange.rank()] = scene.rankCounts().load;
    });
    EXPECT_EQ(loads[0] + loads[1] + loads[2] + loads[3], GrowingCloud::grains);
    for (const double load : loads) EXPECT_LT(load, 1.15 * GrowingCloud::grains / 4);
}

/// Remembers how many grains the rank has in the steps.
class CloudWithOutputs : public GrowingCloud {
public:
    struct Output : RemembersNothing {
        static void write(const Scene&) {}
    };
    CloudWithOutputs() {
        setSaveCount(1);
        addOutput(Output());
    }
    std::size_t own = 0;

private:
    void actionsAfterTimeStep() override { own = particleHandler.ownGrains().size(); }
};

/// Where an output comes after each step, before contacts are due to be listed.
TEST(RunOnRanks, divideTheLoadAtOutputs) {
    std::array<std::size_t, 4> own{};
    VirtualRanks(4).run([&](Exchange& exchange) {
        CloudWithOutputs scene;
        scene.setRanks(exchange, {.balanceAfter = infinity});
        scene.runSteps(200);
        own[exchange.rank()] = scene.own;
    });
    EXPECT_EQ(own[0] + own[1] + own[2] + own[3], std::size_t{GrowingCloud::grains});
    for (const std::size_t size : own) EXPECT_LT(size, 1.15 * GrowingCloud::grains / 4);
}

/// The grains of the half that moves least take four times as long as the others. Where they count alike, the
/// ranks that have them take 1.6 times the mean.
class UnevenCloud : public GrowingCloud {
public:
    /// 4 us
    [[nodiscard]] int timeOfStep() {
        int time = 0;
        for (const GrainReference grain : particleHandler.ownGrains())
            time += static_cast<int>(grain.getId()) % perSide < perSide / 2 ? 4 : 1;
        return time;
    }
    void actionsAfterTimeStep() override {
        std::this_thread::sleep_for(std::chrono::microseconds(4 * timeOfStep()));
    }
};

TEST(RunOnRanks, divideTheTimeThatWasMeasured) {
    const double mean = 2.5 * GrowingCloud::grains / 4;
    double most =
        infinity;  // over the mean; other programs may take the processor of a rank, but not each time
    for (int attempt = 0; attempt < 10 && !(most < 1.4); ++attempt) {
        std::array<int, 4> times{};
        VirtualRanks(4).run([&](Exchange& exchange) {
            UnevenCloud scene;
            scene.setRanks(exchange, {.balanceAfter = 0.05});
            scene.initialise();
            scene.step(80);
            times[exchange.rank()] = scene.timeOfStep();
        });
        EXPECT_EQ(times[0] + times[1] + times[2] + times[3], 4 * mean);
        most = std::min(most, *std::ranges::max_element(times) / mean);
    }
    EXPECT_LT(most, 1.4);
}

/// What one rank is asked, all do.
TEST(RunOnRanks, stopsWhereOneIsAskedTo) {
    const TestFolder folder;
    try {
        VirtualRanks(3).run([&](Exchange& exchange) {
            SharedRun run(folder.path(), whole);
            run.setRanks(exchange, {});
            if (exchange.rank() == 2) run.requestStop();
            run.solve();
        });
        ADD_FAILURE() << "it has not stopped";
    } catch (const RunStopped& stop) {
        EXPECT_TRUE(contains(stop.what(), "requestStop() has stopped the run at time 0 s, after 0 steps"));
    }
    EXPECT_FALSE(fs::exists(folder.path() / "run-restart.h5.part"));
    runOn(2, folder.path(), whole);
    const fs::path serial = folder.path() / "serial";
    SharedRun(serial, whole).solve();
    EXPECT_TRUE(contentOf(serial / "run-restart.h5") == contentOf(folder.path() / "run-restart.h5"));
}

}  // namespace
}  // namespace pendular::runOnRanksTest
