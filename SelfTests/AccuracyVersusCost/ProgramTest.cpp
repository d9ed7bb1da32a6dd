#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "BuildFolders.h"
#include "Kernel/Species/BridgeLaws.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TemporaryFile.h"
#include "Tools/AccuracyVersusCost/BridgePopulations.h"

namespace pendular {
namespace {

using support::contentOf;
using support::expectOneSentence;
using support::TemporaryFolder;

support::ProgramResult runTool(const std::string& arguments) {
    return support::run(folders::tools.string() + "/" + arguments);
}

using Row = std::map<std::string, std::string>;

/// The rows of a table, by the names of its columns.
std::vector<Row> rowsOf(const std::string& table) {
    const auto cells = [](const std::string& line) {
        std::vector<std::string> parts;
        std::istringstream stream(line + ",");
        for (std::string cell; std::getline(stream, cell, ',');) parts.push_back(cell);
        return parts;
    };
    std::istringstream lines(table);
    std::vector<std::string> names;
    std::vector<Row> rows;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("#")) continue;
        const auto parts = cells(line);
        if (names.empty()) {
            names = parts;
            continue;
        }
        EXPECT_EQ(parts.size(), names.size()) << line;
        for (std::size_t k = 0; k < std::min(parts.size(), names.size()); ++k) {
            if (k == 0) rows.emplace_back();
            rows.back()[names[k]] = parts[k];
        }
    }
    return rows;
}

TEST(AccuracyVersusCost, chartsEveryLawForEveryPopulation) {
    const TemporaryFolder folder;
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
    const TemporaryFolder folder;
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
    expectOneSentence(runTool("accuracy-versus-cost"), "one of --bridges, --failure-maps and --time");
    expectOneSentence(runTool("accuracy-versus-cost --bridges --failure-maps"), "one of");
    expectOneSentence(runTool("accuracy-versus-cost --bridges --count 0"), "number of bridges = 0");
    expectOneSentence(runTool("accuracy-versus-cost --bridges --runs 0"), "runs = 0");
    expectOneSentence(runTool("accuracy-versus-cost --failure-maps --angles 1"), "angles = 1");
    expectOneSentence(runTool("accuracy-versus-cost --bridges --count 1 --output /dev/null/table.csv"),
                      "/dev/null/table.csv");
    expectOneSentence(runTool("bridge-scenes --seeds 0"), "seeds = 0");
    expectOneSentence(runTool("bridge-scenes --contact-angle-deg 200"), "contact-angle-deg = 200");
    EXPECT_NE(runTool("accuracy-versus-cost --brigdes").exitCode, 0);
}

TEST(AccuracyVersusCost, hasHelp) {
    for (const std::string tool : {"accuracy-versus-cost", "bridge-scenes"}) {
        const auto result = runTool(tool + " --help");
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_NE(result.output.find("--output"), std::string::npos);
    }
}

// Wet grains hold together by more than dry ones of the same motion; a bed with walls is refused by a law
// without them.
TEST(HeavyBridgeScenes, haveEveryLaw) {
    const TemporaryFolder folder;
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
}  // namespace pendular
