#include <gtest/gtest.h>

#include <array>

#include "SelfTests/Drivers/DriverRun.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::shearedSuspensionTest {
namespace {

using driverRuns::drivers;
using driverRuns::headerOf;
using driverRuns::rowsOf;
using support::expectOneSentence;
using support::run;
using support::TestFolder;

const std::string suspension = drivers + "/ShearedSuspension/ShearedSuspension --quiet ";

TEST(ShearedSuspension, countsEachGrainOnceWithEachLaw) {
    for (const std::string law : {"model-c", "model-c-near", "decay", "exact --contact-angle-deg 57"}) {
        const TestFolder folder;
        const auto result =
            run(suspension + "--number 100 --cohesion 5 --strain 0.3 --begin-strain 0.1 --law " + law + " " +
                folder.option());
        ASSERT_EQ(result.exitCode, 0) << result.output;
        double grains = 0, percent = 0;
        for (const auto& row : rowsOf(folder.path() / "histogram.csv"))
            grains += row[0] * row[1], percent += row[2];
        EXPECT_NEAR(grains, 100, 1e-10) << law;
        EXPECT_NEAR(percent, 100, 1e-10) << law;
        const auto rows = rowsOf(folder.path() / "clusters.csv");
        EXPECT_EQ(rows.size(), 3u);
        for (const auto& row : rows) {
            EXPECT_NEAR(row[5] * 100, row[6] * row[4], 1e-9);  // both shares are of the same grains
            EXPECT_GE(row[7], 1);
            EXPECT_LE(row[7], 100);
        }
    }
}

TEST(ShearedSuspension, refusesWhatHasNoSense) {
    const TestFolder folder;
    for (const char* wrong : {"--law none", "--law exact", "--law ''", "--cohesion nan", "--cohesion -1",
                              "--stokes 0", "--contact-angle-deg 181", "--friction -1", "--restitution 0",
                              "--number 2", "--number 1000000", "--strain 0", "--begin-strain 16",
                              "--begin-strain nan", "--interval-strain 0", "--interval-strain 17"})
        expectOneSentence(run(suspension + wrong + " " + folder.option()), "");
    expectOneSentence(run(suspension + "--law exact " + folder.option()),
                      "--law exact does not pull at contact at a contact angle of 123 degrees");
}

/// Shares that are alone (%), of grains and of clusters, as means over strains of 4 to 16.
std::array<double, 2> sharesAlone(const std::string& cohesion) {
    const TestFolder folder;
    const auto result = run(suspension + "--law decay --cohesion " + cohesion + " " + folder.option());
    EXPECT_EQ(result.exitCode, 0) << result.output;
    double ofGrains = 0, ofClusters = 0, samples = 0;
    for (const auto& row : rowsOf(folder.path() / "clusters.csv"))
        if (row[1] > 3.999) ofGrains += row[5], ofClusters += row[6], samples += 1;
    return {ofGrains / samples, ofClusters / samples};
}

/// An independent program with the same attraction, two seeds each: 43.58, 43.67 % of the grains and 69.69,
/// 69.87 % of the clusters; with attraction 17.42, 17.53 % and 46.01, 45.38 %. Standard errors of our means,
/// from ten blocks: 0.19, 0.20 and 1.1, 1.3 %; the limits are three of the differences.
TEST(LongShearedSuspension, hasTheClustersOfAnIndependentProgram) {
    const auto [grains, clusters] = sharesAlone("0");
    EXPECT_NEAR(grains, 43.63, 3 * 0.27);
    EXPECT_NEAR(clusters, 69.78, 3 * 0.28);
    const auto [grainsOfWet, clustersOfWet] = sharesAlone("0.55");
    EXPECT_NEAR(grainsOfWet, 17.48, 3 * 1.1);
    EXPECT_NEAR(clustersOfWet, 45.7, 3 * 1.3);
}

}  // namespace
}  // namespace pendular::shearedSuspensionTest
