// Whole runs that several ranks do together: their files are those of one process, byte for byte, and they go
// on from each other's restart files.
#include <gtest/gtest.h>

#include <array>

#include "Kernel/Output/EnergyFile.h"
#include "Kernel/Output/Hdf5Output.h"
#include "Kernel/Output/MercuryOutput.h"
#include "Kernel/Output/ParaViewOutput.h"
#include "Kernel/Output/RunTable.h"
#include "Kernel/Output/WallForceFile.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/SameFiles.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::runOnRanksTest {
namespace {

using namespace support;
using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
namespace fs = std::filesystem;

constexpr std::size_t half = 210, whole = 420;  // steps

/// Wet grains that fall and touch, with a table of the driver and all kinds of files.
class SharedRun : public scenes::SettlingBox<Wet> {
public:
    /// @param finer of how many steps one is made
    SharedRun(const fs::path& folder, std::size_t steps, int finer = 1)
        : SettlingBox(6), table(folder / "table.csv", "time_s,z_m,J") {
        setQuiet();
        // Slowly: evaluations of too large overlaps, across ranks, would count twice
        // (Kernel/Ranks/README.md).
        for (GrainReference grain : particleHandler) grain.setVelocity(0.2 * grain.getVelocity());
        setName((folder / "run").string());
        setTimeMax(static_cast<double>(steps) * getTimeStep());
        const double interval = 100 * getTimeStep();
        setTimeStep(getTimeStep() / finer);
        setSaveCount(70 * finer);
        keepRestartFile();
        addOutput(ParaViewOutput().withInterval(interval));
        addOutput(Hdf5Output().withInterval(interval));
        addOutput(WallForceFile(interval));
        addOutput(MercuryOutput().withEnergies(false));
        if (fs::exists(restartFile())) restartFrom(restartFile());
    }
    void writeOutput() override {
        table.row(getTime(), particleHandler.getObject(3).getPosition().z(), getKineticEnergy());
    }
    void completeOutput() override { table.close(); }
    void visitState(StateArchive& archive) override { table.visitState(archive); }

private:
    RunTable table;
};

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

/// With rigid bodies, an account of the energy, and grains that leave at the bottom.
class RichRun : public SharedRun {
public:
    RichRun(const fs::path& folder, std::size_t steps) : SharedRun(folder, steps, 4) {
        for (std::uint32_t k = 0; k + 1 < 96; k += 8) bodyHandler.join({k, k + 1});
        keepEnergyLedger();
        addOutput(EnergyFile(200 * getTimeStep()));
        Outlet outlet;
        outlet.setPlane({0, 0, -1}, {0, 0, 0.0018});
        outletHandler.copyAndAddObject(outlet);
        wallHandler.keepForces();
    }
    void writeOutput() override {}
};

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

TEST(RunOnRanks, goesOnFromTheFilesOfAnyNumber) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "serial";
    SharedRun(serial, whole).solve();
    for (const std::size_t first : {1u, 2u, 3u, 4u}) {
        const fs::path begun = folder.path() / fmt::format("{}", first);
        runOn(first, begun, half);
        for (const std::size_t second : {1u, 2u, 3u, 4u}) {
            const fs::path own = folder.path() / fmt::format("{}-{}", first, second);
            SCOPED_TRACE(fmt::format("{} ranks, then {}", first, second));
            fs::copy(begun, own);
            runOn(second, own, whole);
            EXPECT_EQ(contentOf(serial / "table.csv"), contentOf(own / "table.csv"));
            EXPECT_TRUE(contentOf(serial / "run-restart.h5") == contentOf(own / "run-restart.h5"));
        }
    }
}

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
TEST(RunOnRanks, divideTheLoadAgain) {
    std::array<double, 4> loads{};
    VirtualRanks(4).run([&](Exchange& exchange) {
        Simulation<LinearViscoelasticSpecies> scene;
        auto* const species =
            scene.speciesHandler.copyAndAddObject(scenes::boxMaterial<LinearViscoelasticSpecies>(0));
        SphericalParticle grain;
        grain.setSpecies(species);
        grain.setRadius(1e-3);
        for (int k = 0; k < 16 * 16 * 16; ++k) {
            grain.setPosition(2.5e-3 * Vec3D(k % 16, k / 16 % 16, k / 256));
            grain.setVelocity({500 * grain.getPosition().x(), 0, 0});
            scene.particleHandler.copyAndAddObject(grain);
        }
        scene.setTimeStep(1e-5);
        scene.setQuiet();
        scene.setRanks(exchange, {});
        scene.initialise();
        scene.step(200);
        loads[exchange.rank()] = scene.rankCounts().load;
    });
    EXPECT_EQ(loads[0] + loads[1] + loads[2] + loads[3], 4096);
    for (const double load : loads) EXPECT_LT(load, 1.15 * 1024);
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
