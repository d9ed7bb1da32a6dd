#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "BuildFolders.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Scene/BridgeLaws.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"
#include "Tools/Studies/AccuracyVersusCost/BridgePopulations.h"

namespace pendular::programTest {
namespace {

using support::contentOf;
using support::expectOneSentence;
using support::Row;
using support::rowsOf;
using support::TestFolder;

support::ProgramResult runTool(const std::string& arguments) {
    return support::run(folders::tools.string() + "/Studies/" + arguments);
}

TEST(AccuracyVersusCost, chartsEveryLawForEveryPopulation) {
    const TestFolder folder;
    const std::string file = (folder.path() / "bridges.csv").string();
    const auto result = runTool("accuracy-versus-cost --bridges --count 5 --runs 1 --output " + file);
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto rows = rowsOf(contentOf(file));
    std::size_t k = 0;
    for (const NamedPopulation& population : bridgePopulations())
        forEachBridgeLaw([&]<class Law>() {
            ASSERT_LT(k, rows.size());
            Row row = rows[k++];
            EXPECT_EQ(row["law"], Law::name);
            EXPECT_EQ(row["population"], population.name);
            EXPECT_GT(std::stod(row["force_ns_per_bridge"]), 0);
            EXPECT_GT(std::stod(row["prepare_ns_per_bridge"]), 0);
            EXPECT_EQ(row["not_finite_percent"], "0");
            if (row["refused_percent"] == "100") {
                EXPECT_EQ(row["force_median_percent"], "");
                return;
            }
            for (const std::string what : {"force", "force_of_largest", "rupture_distance", "rupture_work"}) {
                const double middle = std::stod(row[what + "_median_percent"]),
                             most = std::stod(row[what + "_largest_percent"]);
                EXPECT_TRUE(std::isfinite(most) && middle <= most) << Law::name << " " << what;
            }
        });
    EXPECT_EQ(k, rows.size());
}

TEST(AccuracyVersusCost, mapsEveryLaw) {
    const TestFolder folder;
    const std::string file = (folder.path() / "maps.csv").string();
    const auto result =
        runTool("accuracy-versus-cost --failure-maps --volumes 4 --angles 3 --output " + file);
    ASSERT_EQ(result.exitCode, 0) << result.output;
    std::map<std::string, int> cells;
    for (Row& row : rowsOf(contentOf(file))) ++cells[row["law"]];
    forEachBridgeLaw([&]<class Law>() { EXPECT_EQ(cells[std::string(Law::name)], 12) << Law::name; });
    EXPECT_EQ(cells["LiquidBridgeYoungLaplace+solveOutsideTable"], 12);
}

TEST(AccuracyVersusCost, refusesInOneSentence) {
    expectOneSentence(runTool("accuracy-versus-cost"), "give one of");
    expectOneSentence(runTool("accuracy-versus-cost --bridges --failure-maps"), "one of");
    expectOneSentence(runTool("accuracy-versus-cost --bridges --count 0"), "number of bridges = 0");
    expectOneSentence(runTool("accuracy-versus-cost --bridges --runs 0"), "runs = 0");
    expectOneSentence(runTool("accuracy-versus-cost --failure-maps --angles 1"), "angles = 1");
    expectOneSentence(runTool("accuracy-versus-cost --bridges --count 1 --output /dev/null/table.csv"),
                      "/dev/null/table.csv");
    expectOneSentence(runTool("bridge-scenes --seeds 0"), "seeds = 0");
    expectOneSentence(runTool("bridge-scenes --contact-angle-deg 200"), "contact-angle-deg = 200");
    expectOneSentence(runTool("accuracy-versus-cost --bulk --beds 1"), "beds = 1");
    expectOneSentence(runTool("accuracy-versus-cost --bulk --scene hopper"), "hopper");
    expectOneSentence(runTool("accuracy-versus-cost --bulk --scene drum --beds 5"), "--beds is of another");
    expectOneSentence(runTool("accuracy-versus-cost --bulk --scene bed --drums 3"), "--drums is of another");
    expectOneSentence(runTool("accuracy-versus-cost --contact-maps --map-offsets 0"), "map-offsets = 0");
    EXPECT_NE(runTool("accuracy-versus-cost --brigdes").exitCode, 0);
    // An option of another mode.
    const auto other = runTool("accuracy-versus-cost --time --beds 3");
    EXPECT_NE(other.exitCode, 0);
    EXPECT_NE(other.output.find("--beds requires --bulk"), std::string::npos) << other.output;
}

TEST(AccuracyVersusCost, hasHelp) {
    for (const std::string tool : {"accuracy-versus-cost", "bridge-scenes"}) {
        const auto result = runTool(tool + " --help");
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_NE(result.output.find("--output"), std::string::npos);
    }
}

// Whatever the size: the first law is its own reference; a softer law takes longer steps, friction costs
// time, and a smooth bed has more contacts.
TEST(HeavyBulkChart, hasEveryLaw) {
    const TestFolder folder;
    const std::string file = (folder.path() / "bulk.csv").string();
    const auto result = runTool(
        "accuracy-versus-cost --bulk --elastic-modulus-Pa 1e6 --scene bed --beds 2 --bed-particles 150 "
        "--rounds 1 --output " +
        file);
    ASSERT_EQ(result.exitCode, 0) << result.output;
    auto rows = rowsOf(contentOf(file));
    ASSERT_EQ(rows.size(), 10 * 7);
    EXPECT_EQ(rows[0]["deviation_percent"], "0");
    double rough = 0, smooth = 0;
    for (Row& row : rows) {
        EXPECT_TRUE(std::isfinite(std::stod(row["mean"]))) << row["law"] << row["figure"];
        EXPECT_GT(std::stod(row["million_particle_steps_per_second"]), 0);
        if (row["figure"] == "vertical_stress_over_weight") {
            EXPECT_NEAR(std::stod(row["mean"]), 1, 0.02);
        }
        if (row["figure"] != "coordination") continue;
        if (row["law"] == "Hertz-Mindlin" && rough == 0) rough = std::stod(row["mean"]);
        if (row["law"] == "Hertz without friction") smooth = std::stod(row["mean"]);
    }
    EXPECT_GT(smooth, rough);
}

// Five collisions by three integrators. The default is the measure of cost; with 500 steps each errs less
// than with 5.
TEST(HeavyTimeChart, hasEveryCollisionAndIntegrator) {
    const TestFolder folder;
    const std::string file = (folder.path() / "time.csv").string();
    const auto result = runTool("accuracy-versus-cost --time --offsets 1 --step-lengths 1 --output " + file);
    ASSERT_EQ(result.exitCode, 0) << result.output;
    std::map<std::string, std::pair<double, double>> firstAndLast;  // %
    for (Row& row : rowsOf(contentOf(file))) {
        const double error = std::stod(row["parting_error_percent"]);
        firstAndLast.try_emplace(row["collision"] + " " + row["integrator"], error, 0).first->second.second =
            error;
        if (row["integrator"] == "PredictedVelocityVerlet") {
            EXPECT_EQ(std::stod(row["cost_in_default_steps"]), std::stod(row["steps_per_contact"]));
        }
    }
    EXPECT_EQ(firstAndLast.size(), 5 * std::size(integrators::all));
    for (const auto& [name, errors] : firstAndLast) EXPECT_LT(errors.second, errors.first) << name;
}

// Wet grains hold together by more than dry ones of the same motion; a bed with walls is refused by a law
// without them.
TEST(HeavyBridgeScenes, haveEveryLaw) {
    const TestFolder folder;
    const std::string file = (folder.path() / "scenes.csv").string();
    const auto result = runTool(
        "bridge-scenes --particles 100 --rounds 1 --seeds 2 --strain-before 0.3 --strain 0.02 --states \"\" "
        "--output " +
        file);
    ASSERT_EQ(result.exitCode, 0) << result.output;
    auto rows = rowsOf(contentOf(file));
    std::map<std::string, Row> of;
    for (Row& row : rows) of[row["law"]] = row;
    EXPECT_EQ(of["none"]["capillary_tension_Pa"], "0");
    EXPECT_EQ(of["LiquidBridgeBagheri"]["bed_time_over_Bagheri"], "1");
    EXPECT_EQ(of["LiquidBridgeSoulie"]["bed_time_over_Bagheri"], "");
    EXPECT_NE(contentOf(file).find("no limit at a wall"), std::string::npos);
    forEachBridgeLaw([&]<class Law>() {
        Row row = of[std::string(Law::name)];
        ASSERT_FALSE(row.empty()) << Law::name;
        EXPECT_GT(std::stod(row["capillary_tension_Pa"]), 0) << Law::name;
        EXPECT_GT(std::stod(row["capillary_tension_standard_error_Pa"]), 0) << Law::name;
        EXPECT_GT(std::stod(row["coordination"]), std::stod(of["none"]["coordination"])) << Law::name;
        EXPECT_GT(std::stod(row["shear_time_over_Bagheri"]), 0) << Law::name;
    });
}

}  // namespace
}  // namespace pendular::programTest
