// The tool that counts what ranks would have.
#include <gtest/gtest.h>

#include "BuildFolders.h"
#include "Kernel/Simulation/Simulation.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::countRanksToolTest {
namespace {

using namespace support;

const std::string tool = (folders::tools / "count-ranks").string() + " ";

/// The restart file of a row of equal grains that touch, 1024 of them.
std::filesystem::path rowOfGrains(const std::filesystem::path& folder, bool isPeriodic) {
    Simulation<LinearViscoelasticSpecies> scene;
    auto* const species =
        scene.speciesHandler.copyAndAddObject(scenes::boxMaterial<LinearViscoelasticSpecies>(0));
    for (int k = 0; k < 1024; ++k) {
        SphericalParticle grain;
        grain.setSpecies(species);
        grain.setRadius(0x1p-10);
        grain.setPosition({0x1p-9 * (k + 0.5), 0, 0});
        scene.particleHandler.copyAndAddObject(grain);
    }
    if (isPeriodic) scene.setPeriodic(0, 0, 2);
    scene.setTimeStep(1e-6);
    scene.setQuiet();
    scene.initialise();
    scene.writeRestart(folder / "row.h5");
    return folder / "row.h5";
}

/// Each cut has a ghost on each side: R ranks have 2 (R - 1), of a ring 2 R.
TEST(CountRanks, countsTheGhostsOfARow) {
    for (const bool isPeriodic : {false, true}) {
        const TestFolder folder;
        const ProgramResult result =
            run(tool + rowOfGrains(folder.path(), isPeriodic).string() + " --ranks 1 4 64 --skin 0.1");
        EXPECT_EQ(result.exitCode, 0) << result.output;
        EXPECT_TRUE(contains(result.output, isPeriodic ? "\n4,256,1,2,2,2,2," : "\n4,256,1,1.5,2,1.5,2,"))
            << result.output;
        EXPECT_TRUE(
            contains(result.output, isPeriodic ? "\n64,16,1,2,2,2,2," : "\n64,16,1,1.96875,2,1.969,2,"))
            << result.output;
    }
}

/// With more ranks than grains, and a number that no machine has.
TEST(CountRanks, standsAtItsEdges) {
    const TestFolder folder;
    const std::string file = rowOfGrains(folder.path(), false).string();
    EXPECT_TRUE(contains(run(tool + file + " --ranks 2048").output, "\n2048,0.5,2,"));
    expectOneSentence(run(tool + file + " --ranks 0"), "number of ranks = 0");
    expectOneSentence(run(tool + "none.h5"), "does not exist");
    expectOneSentence(run(tool + file + " --rate-1/s 0"), "rate = 0 1/s");
}

}  // namespace
}  // namespace pendular::countRanksToolTest
