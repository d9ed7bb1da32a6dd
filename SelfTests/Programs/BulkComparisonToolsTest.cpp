// The tables of the comparison of bulk figures with other codes, made of runs with known figures.
#include <gtest/gtest.h>

#include <fstream>

#include "BuildFolders.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::bulkComparisonToolsTest {
namespace {

using support::contains;
using support::run;

const std::string study = (folders::source / "Tools/Studies/BulkComparison/").string();

/// The table that a script makes of these runs.
std::string tableOf(const std::string& script, const std::string& runs, const std::string& rows,
                    const std::string& table) {
    const support::TestFolder folder;
    std::ofstream(folder.path() / runs) << rows;
    const auto result =
        run("PATH=/usr/bin:/bin " + study + script + " --seeds 0 --output " + folder.path().string());
    EXPECT_EQ(result.exitCode, 0) << result.output;
    std::ifstream file(folder.path() / table);
    return {std::istreambuf_iterator<char>(file), {}};
}

// Ours keeps to 1 % at 0.4 and to 5 % at 0.6 of Rayleigh's time, the other code only at 0.2 and 0.4: 8 s over
// 2 s, and 4 s over 1 s. All seeds have the same figures, so that there is no scatter.
TEST(BulkComparisonTools, findTheTimeForTheSameError) {
    std::string rows;
    for (const char* seed : {"1", "2"}) {
        const auto add = [&](const std::string& code, const std::string& step, const std::string& seconds,
                             const std::string& figure) {
            rows += "bed," + code + "," + step + "," + seed + ",1e-5,1," + seconds + ",coordination," +
                    figure + "\n";
        };
        add("pendular-default", "0.2", "4", "5"), add("pendular-default", "0.4", "2", "5.04");
        add("pendular-default", "0.6", "1", "5.2"), add("pendular-default", "0.7", "0.5", "6");
        add("liggghts", "0.2", "8", "5"), add("liggghts", "0.4", "4", "5.2"),
            add("liggghts", "0.6", "3", "6");
    }
    const std::string table = tableOf("compare-bulk.sh", "bulk-runs.csv", rows, "same-error.csv");
    EXPECT_TRUE(contains(table, "\nbed,coordination,1,liggghts,0.4,0.2,2,8,4.00,4.00,4.00,0\n")) << table;
    EXPECT_TRUE(contains(table, "\nbed,coordination,5,liggghts,0.6,0.4,1,4,4.00,4.00,4.00,0\n")) << table;
}

// The hardest is the reference; 1.1 and 1.0 with a scatter of 0.01 each differ by 10 % +- 1.5 %.
TEST(BulkComparisonTools, findWhatSofterGrainsDo) {
    std::string rows;
    for (const double scatter : {-0.01, 0.01})
        for (const double figure : {1.1, 1.0})
            rows += "bed,pendular-adaptive," + std::string(figure > 1 ? "1e5" : "1e6") +
                    ",1,1e-5,1,2,solid_fraction," + std::to_string(figure + scatter) + "\n";
    const std::string table = tableOf("soften-bulk.sh", "softness-runs.csv", rows, "softness.csv");
    EXPECT_TRUE(contains(table, ",1e5,1e-5,2,2,2,solid_fraction,1.1,0.01,10,1.5\n")) << table;
    EXPECT_TRUE(contains(table, ",1e6,1e-5,2,2,2,solid_fraction,1,0.01,0,0\n")) << table;
}

TEST(BulkComparisonTools, refuseInOneSentence) {
    for (const auto& [arguments, part] :
         {std::pair{"compare-bulk.sh --seeds none", "--seeds is 'none'; it must be a whole number above 0"},
          {"soften-bulk.sh --scenes silo",
           "there is no scene silo; there are bed, drum, hopper, shear and wet-shear"}}) {
        const auto result = run(study + arguments);
        EXPECT_EQ(result.exitCode, 2);
        EXPECT_TRUE(contains(result.output, part)) << result.output;
    }
}

}  // namespace
}  // namespace pendular::bulkComparisonToolsTest
