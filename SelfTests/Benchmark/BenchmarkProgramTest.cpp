#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/SharedData.h"
#include "SelfTests/Support/TemporaryFile.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::benchmarkProgramTest {
namespace {

support::ProgramResult benchmark(const std::string& arguments) {
    return support::run(folders::tools.string() + "/benchmark-scenes " + arguments);
}

std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) result.push_back(cell);
    return result;
}

TEST(BenchmarkProgram, printsARowOfItsColumns) {
    const support::ProgramResult run = benchmark("--scene gas --particles 100 --steps 10 --warm 5 --header");
    ASSERT_EQ(run.exitCode, 0) << run.output;
    std::istringstream lines(run.output);
    std::string names, values;
    std::getline(lines, names), std::getline(lines, values);
    const std::vector<std::string> name = cells(names), value = cells(values);
    ASSERT_EQ(name.size(), value.size());
    const auto of = [&](const std::string& wanted) {
        return value.at(static_cast<std::size_t>(std::find(name.begin(), name.end(), wanted) - name.begin()));
    };
    EXPECT_EQ(of("scene"), "gas");
    EXPECT_EQ(of("species"), "HertzianViscoelasticMindlinSpecies");
    EXPECT_EQ(of("particles"), "100");
    EXPECT_EQ(of("steps"), "10");
    EXPECT_EQ(of("threads"), "1");
    const double rate = 100 * 10 / std::stod(of("seconds")) * 1e-6;
    // Six digits of the time are printed, and four behind the point of the rate.
    EXPECT_NEAR(std::stod(of("million_particle_steps_per_second")), rate, 1e-5 * rate + 1e-4);
    // The records of a grain: 64 + 64 + 24 + 2 + 4 + 4.
    EXPECT_GE(std::stod(of("bytes_per_particle")), 162);
    // Nothing touches yet: 100 grains whose speeds are even from -1 to 1 m/s along each axis have m/2 each in
    // the mean, m = 1.047e-5 kg. A square of such a speed has the deviation sqrt(4/45), the mean of 100 sums
    // of three sqrt(12/45) / 10 = 0.052; 0.35 is seven times that.
    EXPECT_NEAR(std::stod(of("kinetic_energy_J")), 100 * 0.5 * 1.0472e-5, 0.35 * 100 * 0.5 * 1.0472e-5);
    EXPECT_EQ(of("state_hash").size(), 16u);
}

/// Grains of soft material in flow, from a start that is kept as a file for LIGGGHTS; wet ones begin with the
/// dry ones.
TEST(BenchmarkProgram, hasFlowsDryAndWet) {
    const support::TestFolder folder;
    for (const std::string scene :
         {"flowing-drum", "flowing-hopper", "flowing-mixer", "wet-flowing-drum", "wet-flowing-mixer"}) {
        std::string first;
        for (const char* again : {"", " --threads 2"}) {
            const support::ProgramResult run =
                benchmark("--scene " + scene + " --particles 300 --steps 40 --warm 10 --states " +
                          folder.path().string() + again);
            ASSERT_EQ(run.exitCode, 0) << run.output;
            const std::size_t row = run.output.rfind(scene);  // after warnings, if there are any
            ASSERT_NE(row, std::string::npos) << run.output;
            const std::vector<std::string> value = cells(run.output.substr(row));
            const double grains = std::stod(value.at(2));
            EXPECT_NEAR(grains, 250, 150);  // the screw of so small a mixer takes much of the room
            // In flow: 0.005 m/s in the mean at least; of 4.2e-9 m^3 and 2500 kg/m^3 at most. At rest grains
            // have less than they fall in a step, 2e-4 m/s.
            EXPECT_GT(std::stod(value.at(11)), grains * 0.5 * 1e-5 * 0.005 * 0.005);
            if (first.empty()) first = value.at(12);
            EXPECT_EQ(value.at(12), first);  // the hash of the state
            const bool isWet = scene.starts_with("wet-");
            EXPECT_EQ(value.at(1).find("LiquidBridge") != std::string::npos, isWet);
            const std::size_t bridges = run.output.find(" bridges\n");
            ASSERT_EQ(bridges != std::string::npos, isWet);
            // Those that touch have a bridge (but for walls'), and so have some that touched: each grain has
            // one at least.
            if (isWet) {
                const std::size_t number = run.output.rfind('\n', bridges) + 1;
                EXPECT_GT(std::stod(run.output.substr(number)), 0.5 * grains);
            }
        }
        EXPECT_TRUE(std::filesystem::exists(folder.path() / (scene + "-300.data")));
    }
}

/// What LIGGGHTS and LAMMPS read of a flow: grains, numbers and meshes.
TEST(BenchmarkProgram, writesTheFilesOfAFlowForOtherCodes) {
    const support::TestFolder folder;
    const std::filesystem::path files = folder.path() / "files";
    const support::ProgramResult run =
        benchmark("--scene flowing-mixer --particles 300 --states '' --peer-files " + files.string());
    ASSERT_EQ(run.exitCode, 0) << run.output;
    const auto textOf = [&](const char* name) {
        std::ifstream file(files / name);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    EXPECT_NE(textOf("start").find("4 atom types"), std::string::npos);
    const std::string variables = textOf("variables");
    for (const char* line :
         {"variable boundary index \"f f p \"", "variable meshed index 1", "variable drum index 0"})
        EXPECT_NE(variables.find(line), std::string::npos) << variables;
    for (const char* mesh : {"tube.stl", "rotor.stl"})
        EXPECT_NE(textOf(mesh).find("vertex"), std::string::npos);
}

TEST(BenchmarkProgram, refusesWithOneSentence) {
    const auto expectRefusal = [](const std::string& arguments, const std::string& words) {
        support::expectOneSentence(benchmark(arguments), words);
    };
    expectRefusal("--scene bde", "bed");
    expectRefusal("--scene gas --species Hertz", "instantiated species");
    expectRefusal("--scene gas --positions grains.txt", "takes no positions");
    expectRefusal("--scene drum --positions grains.txt", "both positions and walls");
    expectRefusal("--scene bed --walls walls.txt", "takes no walls");
    expectRefusal("--scene drum --species LinearViscoelasticSpecies", "has its own species");
    expectRefusal("--scene flowing-drum --species LinearViscoelasticSpecies", "has its own species");
    expectRefusal("--scene flowing-hopper --shear 5", "takes no shear");
    expectRefusal("--scene flowing-hopper --grains", "prints no grains");
    expectRefusal("--scene bed --peer-files files", "has no files for other codes");
    expectRefusal("--scene bed --positions /nowhere/grains.txt", "/nowhere/grains.txt");
    expectRefusal("--scene clumps --clumps 2", "needs positions");
    expectRefusal("--scene gas --clumps 2", "takes no clumps");
    expectRefusal("--scene flowing-drum --particles 10", "needs at least 200");
    expectRefusal("--scene gas --particles 10 --steps 0", "steps = 0");
    expectRefusal("--scene gas --particles 10 --threads 0", "threads = 0");
}

TEST(BenchmarkProgram, hasHelp) {
    const support::ProgramResult run = benchmark("--help");
    EXPECT_EQ(run.exitCode, 0);
    for (const char* option : {"--scene", "--particles", "--threads", "--steps", "--positions", "--warm"})
        EXPECT_NE(run.output.find(option), std::string::npos) << option;
}

/// LIGGGHTS gives 4.52e-6 J and LAMMPS 4.56e-6 J after the same 2500 steps; ours must not be farther from
/// them than they are from each other.
TEST(HeavyBenchmarkProgram, publishedBedHasTheEnergyOfItsPeers) {
    if (!support::hasSharedData("bed25k.txt")) GTEST_SKIP() << support::withoutSharedData("bed25k.txt");
    const std::string bed = support::sharedData("bed25k.txt").string();
    const support::ProgramResult run =
        benchmark("--scene bed --positions " + bed + " --warm 500 --steps 2000");
    ASSERT_EQ(run.exitCode, 0) << run.output;
    const double energy = std::stod(cells(run.output).at(11));
    EXPECT_GT(energy, 4.52e-6 - 0.04e-6);
    EXPECT_LT(energy, 4.56e-6 + 0.04e-6);
}

}  // namespace
}  // namespace pendular::benchmarkProgramTest
