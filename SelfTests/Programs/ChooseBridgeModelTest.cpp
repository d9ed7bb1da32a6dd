// The adviser as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>

#include <sstream>
#include <string>

#include "BuildFolders.h"
#include "Kernel/Scene/BridgeLaws.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"

namespace pendular::chooseBridgeModelTest {
namespace {

using support::contains;
using support::expectOneSentence;
using support::run;

const std::string every = std::string(folders::tools) + "/choose-bridge-model --runs 1 ";
const std::string choose = every + "--count 40 ";
const std::string largeBridges =
    "--smallest-radius-m 1e-4 --largest-radius-m 1e-3 --smallest-volume-m3 1e-12 --largest-volume-m3 1e-10 ";
const std::string bridges =
    "--smallest-radius-m 0.5e-3 --largest-radius-m 1e-3 --smallest-volume-m3 1e-12 --walls ";

TEST(ChooseBridgeModel, listsAllLawsAndAnswersWithTheOnlyAccurateOne) {
    const auto result = run(choose + bridges + "--tolerance-percent 1 --all");
    EXPECT_EQ(result.exitCode, 0);
    std::istringstream lines(result.output);
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line.substr(0, 18), "law,error_percent,");
    forEachBridgeLaw([&]<class Law>() {
        ASSERT_TRUE(std::getline(lines, line));
        EXPECT_EQ(line.substr(0, line.find(',')), Law::name);
        EXPECT_EQ(contains(line, "has no limit at a wall"), Law::name == LiquidBridgeSoulie::name);
    });
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line.substr(0, line.find(':')), "LiquidBridgeYoungLaplace");
    for (const char* part : {"% from the exact bridge", "ns a bridge and step", "times LiquidBridgeBagheri"})
        EXPECT_TRUE(contains(line, part));
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(line, "none is better");
}

TEST(ChooseBridgeModel, saysWhichIsBestAndWhichIsBetterButDearer) {
    const auto result = run(choose + bridges + "--tolerance-percent 0.001 --cost-at-most 1.2");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(contains(result.output,
                         "no law is within 0.001 % at 1.2 times the cost of LiquidBridgeBagheri; "
                         "the best is LiquidBridge"));
    EXPECT_TRUE(contains(result.output, "\nnext better: LiquidBridge"));
}

// Set-up refuses Bagheri for V* = 100, which the exact solver does not find.
TEST(ChooseBridgeModel, asksLawsForBridgesWithoutExactSolutionToo) {
    const auto result = run(every + largeBridges + "--tolerance-percent 40");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(contains(result.output, "1 of 300 bridges have no exact solution"));
    EXPECT_TRUE(contains(result.output, "no law is within 40 %"));
    EXPECT_FALSE(contains(result.output, "LiquidBridgeBagheri:"));
}

TEST(ChooseBridgeModel, solvesOutsideOfTheTable) {
    const auto result =
        run(choose + "--smallest-radius-m 1e-3 --smallest-volume-m3 6e-10 --tolerance-percent 1");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.output.substr(0, result.output.find(':')), "LiquidBridgeYoungLaplace+solveOutsideTable");
}

TEST(ChooseBridgeModel, refusesInOneSentence) {
    expectOneSentence(run(choose), "smallest-radius-m is not set");
    expectOneSentence(run(choose + "--smallest-radius-m 1e-3"), "smallest-volume-m3 is not set");
    expectOneSentence(run(choose + bridges + "--largest-volume-m3 1e-13"), "largest-volume-m3 = 1e-13 m^3");
    expectOneSentence(run(choose + bridges + "--contact-angle-deg 181"), "contact-angle-deg = 181 degrees");
    expectOneSentence(run(choose + bridges + "--tolerance-percent 0"), "tolerance-percent = 0 %");
    expectOneSentence(run(choose + bridges + "--cost-at-most -1"), "cost-at-most = -1");
    expectOneSentence(run(every + bridges + "--count -3"), "count = -3 is");
    expectOneSentence(run(choose + bridges + "--seed -3"), "seed = -3 is");
    // Above 90 degrees only the exact law serves, and V* = 100 has no stable bridge.
    const auto none = run(choose + largeBridges + "--contact-angle-deg 120");
    EXPECT_NE(none.exitCode, 0);
    EXPECT_TRUE(contains(none.output, "no law serves"));
    EXPECT_NE(run(choose + "--radius 1").exitCode, 0);
    const auto help = run(choose + "--help");
    EXPECT_EQ(help.exitCode, 0);
    for (const char* part : {"m^3", "degrees", "--walls", "--tolerance-percent"})
        EXPECT_TRUE(contains(help.output, part));
}

TEST(TwoParticleCollisionAdvice, isALineAtSetUpWhereAskedFor) {
    const std::string collision = std::string(folders::drivers) +
                                  "/TwoParticleCollision/TwoParticleCollision --output " +
                                  testing::TempDir() + "pendular-advice --adhesion LiquidBridgeWillett";
    const auto silent = run(collision), advised = run(collision + " --advise-within-percent 5");
    EXPECT_EQ(silent.exitCode, 0);
    EXPECT_EQ(advised.exitCode, 0);
    EXPECT_FALSE(contains(silent.output, "exact"));
    EXPECT_TRUE(contains(advised.output, "the cheapest law within 5 % is LiquidBridgeYoungLaplace"));
    const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
    EXPECT_EQ(lines(advised.output), lines(silent.output) + 1);
    EXPECT_EQ(run(collision + " --advise-within-percent 5 --quiet").output, "");
    expectOneSentence(run(collision + " --advise-within-percent -5"), "advise-within-percent = -5 %");
}

}  // namespace
}  // namespace pendular::chooseBridgeModelTest
