// Tools/size-distribution as a user runs it.
#include <gtest/gtest.h>

#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular::sizeDistributionToolTest {
namespace {

using support::expectOneSentence;
using support::rowsOf;
using support::run;

const std::string tool = (folders::tools / "size-distribution").string() + " ";
const support::TemporaryFile table(".csv", "radius_mm,class_mass\n1,0\n2,0.5\n3,0.1\n4,0.4\n");
const std::string ofTable = tool + "--file " + table.path.string() + " ";

TEST(SizeDistributionTool, printsCurvesOnAllBases) {
    const auto result = run(ofTable + "--points 3");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_NE(result.output.find("D[4,3] 0.0048 m"), std::string::npos);
    const auto rows = rowsOf(result.output);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[1].at("diameter_m"), "0.004");
    EXPECT_NEAR(std::stod(rows[1].at("cumulative_number")), 0.918367346939, 1e-12);
    EXPECT_NEAR(std::stod(rows[1].at("cumulative_volume")), 0.5, 1e-15);
    EXPECT_NE(run(ofTable + "--in-class number").output.find("D[4,3] 0.00502895 m"), std::string::npos);
}

TEST(SizeDistributionTool, drawsGrainsAndTellsErrors) {
    const auto grains = rowsOf(run(ofTable + "--draw 1000 --exact").output);
    ASSERT_EQ(grains.size(), 1000u);
    EXPECT_GT(std::stod(grains.front().at("diameter_m")), std::stod(grains.back().at("diameter_m")));
    EXPECT_EQ(run(ofTable + "--draw 9").output, run(ofTable + "--draw 9").output);
    EXPECT_NE(run(ofTable + "--draw 9").output, run(ofTable + "--draw 9 --seed 2").output);
    const auto errors = rowsOf(run(ofTable + "--errors --samples 2").output);
    EXPECT_LT(std::stod(errors.back().at("exact_error")), std::stod(errors.back().at("random_mean_error")));
}

TEST(SizeDistributionTool, takesEveryLaw) {
    const std::string cuts = "--smallest-m 5e-4 --largest-m 2e-3 --points 2 ";
    for (const std::string law :
         {"--law even", "--law normal --size-m 1e-3 --deviation 1e-4",
          "--law lognormal --size-m 1e-3 --deviation 1.5 --basis volume",
          "--law rosin-rammler --size-m 1e-3 --exponent 3", "--law bidisperse --volume-of-large 0.5"})
        EXPECT_EQ(run(tool + cuts + law).exitCode, 0) << law;
    EXPECT_NE(
        run(tool + cuts + "--law lognormal --size-m 1e-3 --deviation 1.5").output.find("D[4,3] 0.00138254"),
        std::string::npos);
}

TEST(SizeDistributionTool, refusesInOneSentence) {
    const std::string cuts = "--smallest-m 5e-4 --largest-m 2e-3 ";
    const std::pair<std::string, std::string> cases[] = {
        {tool, "give either --file or --law"},
        {ofTable + "--law even", "give either --file or --law"},
        {tool + "--file /no/such", "does not exist"},
        {ofTable + "--in-class x", "\"x\""},
        {ofTable + "--points 1", "points = 1"},
        {ofTable + "--draw -1", "--draw: '-1'"},
        {ofTable + "--exact", "draw = 0"},
        {ofTable + "--errors --samples 0", "samples = 0"},
        {tool + cuts + "--law nosuch", "\"nosuch\""},
        {tool + "--law even", "smallest diameter"},
        {tool + cuts + "--law normal --size-m nan --deviation 1e-4", "mean diameter"},
        {tool + cuts + "--law normal --size-m 1e-3", "standard deviation"},
        {tool + cuts + "--law lognormal --size-m 1e-3 --deviation 1", "geometric standard deviation"},
        {tool + cuts + "--law lognormal --size-m 1e-3 --deviation 2 --basis mood", "\"mood\""},
        {tool + cuts + "--law rosin-rammler --size-m 1e-3 --exponent nan", "exponent"},
        {tool + cuts + "--law bidisperse --volume-of-large 2", "volume fraction of the large grains"},
        {tool + cuts + "--law bidisperse", "volume fraction of the large grains"}};
    for (const auto& [command, part] : cases) {
        // Standard output may have lines before; the sentence is on standard error.
        expectOneSentence(run("(" + command + " 2>&1 >/dev/null)"), part);
    }
}

}  // namespace
}  // namespace pendular::sizeDistributionToolTest
