// The tool that counts what ranks would have.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "BuildFolders.h"
#include "Kernel/Scene/Simulation.h"
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
        EXPECT_TRUE(
            contains(result.output, isPeriodic ? "\n1024,4,256,1,2,2,2,2," : "\n1024,4,256,1,1.5,2,1.5,2,"))
            << result.output;
        EXPECT_TRUE(contains(result.output,
                             isPeriodic ? "\n1024,64,16,1,2,2,2,2," : "\n1024,64,16,1,1.96875,2,1.969,2,"))
            << result.output;
    }
}

/// The numbers in the columns of the rows of a table.
std::vector<std::vector<double>> rowsOf(const std::string& table) {
    std::vector<std::vector<double>> rows;
    std::istringstream lines(table);
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);) {
        std::istringstream cells(line);
        rows.emplace_back();
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
    }
    return rows;
}

/// Of a longer ring ranks with as many grains have the same ghosts; where the file has too few grains, eight
/// times as many for a rank have four times the ghosts, and what a step takes goes towards the time of its
/// own grains.
TEST(CountRanks, tellsOfLargerScenesOnPaper) {
    const TestFolder folder;
    const std::string file = rowOfGrains(folder.path(), true).string();
    const auto longer = rowsOf(run(tool + file + " --grains 16e6 --ranks 1000000").output);
    ASSERT_EQ(longer.size(), 1u);
    EXPECT_EQ(std::vector(longer[0].begin(), longer[0].begin() + 8),
              (std::vector<double>{16e6, 1e6, 16, 1, 2, 2, 2, 2}));
    const auto larger = rowsOf(run(tool + file + " --grains 1.25e8 1e9 --ranks 1000 --rate-1/s 1e7").output);
    ASSERT_EQ(larger.size(), 2u);
    EXPECT_EQ(larger[1][2], 1e6);  // own grains
    EXPECT_NEAR(larger[1][5] / larger[0][5], 4, 1e-5);
    EXPECT_GT(larger[1][9], 0.1);  // s, of a step: own grains over the rate, and more
    EXPECT_LT(larger[1][9], 0.12);
    expectOneSentence(run(tool + file + " --grains 1000"), "number of grains = 1000");
}

/// With more ranks than grains, and a number that no machine has.
TEST(CountRanks, standsAtItsEdges) {
    const TestFolder folder;
    const std::string file = rowOfGrains(folder.path(), false).string();
    EXPECT_TRUE(contains(run(tool + file + " --ranks 2048").output, "\n1024,2048,0.5,2,"));
    expectOneSentence(run(tool + file + " --ranks 0"), "number of ranks = 0");
    expectOneSentence(run(tool + "none.h5"), "does not exist");
    expectOneSentence(run(tool + file + " --rate-1/s 0"), "rate = 0 1/s");
}

}  // namespace
}  // namespace pendular::countRanksToolTest
