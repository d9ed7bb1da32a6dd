/// Viscous bridges of a pair in the kernel against closed forms.

#include <gtest/gtest.h>

#include <set>

#include "BuildFolders.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"
#include "Tools/Studies/AccuracyVersusCost/ViscousPair.h"

namespace pendular::viscousPairTest {
namespace {

// From 1 to 100 um and without end for V = 1e-11 m^3 between grains of 1 mm, in their radii: the digits that
// an independent program gives.
TEST(ViscousPair, hasTheIntegralOfTheResistance) {
    const double from = ViscousPair::resistanceUpTo(1e-3);
    EXPECT_NEAR(ViscousPair::resistanceUpTo(0.1) - from, 3.00294180, 1e-8);
    EXPECT_NEAR(ViscousPair::resistanceUpTo(1e3) - from, 3.01807157, 1e-8);
}

// The speed that is lost between two gaps is exact at any step, wherever in a step the touch is, as long as
// K dt < eps / X(eps)^2: beyond, the scheme takes the pair for one that creeps. Round-off: some 1e4 steps of
// 2^-53 of the speed, and of the grains' places (1e-16 of 1 mm) over the roughness.
TEST(HeavyViscousPair, touchesWithTheExactSpeedByTheGapScheme) {
    for (const double stokes : {5.0, 15.0, 50.0, 1000.0})
        for (const double way : {0.1, 1.0, 3.0, 10.0})
            for (int k = 0; k < 40 && way < stokes; ++k) {
                const ViscousPair pair{1e-3, 1e-3, stokes};
                const double from = ViscousPair::gap + way * ViscousPair::roughness * k / 40;
                ViscousPairScene scene(pair, ViscousScheme::Gap, from, way, false);
                scene.approach();
                EXPECT_NEAR(scene.closing(), pair.touchingSpeed(from), 1e-9)
                    << stokes << " " << way << " " << k;
            }
}

// A scheme that samples the resistance errs by what that changes in a step: of first order where the
// roughness is resolved, and at ten roughnesses a step, where the plateau may be stepped over, by up to all
// of the plateau, 1/St. So at St = 1/0.068, that of a reference case, by 3e-3, 3e-2 and 0.4 of the speed at
// most at 0.1, 1 and 10 roughnesses; half an order is left for the bridge's other volume.
TEST(HeavyViscousPair, isMissedBySchemesThatSampleTheResistance) {
    for (const ViscousScheme scheme : {ViscousScheme::Implicit, ViscousScheme::Explicit}) {
        const auto errorAt = [&](double way) {
            return viscousErrors({1e-3, 1e-3, 1 / 0.068}, scheme, way, 20).touchingSpeed;
        };
        for (const auto& [way, given] : {std::pair{0.1, 3e-3}, {1.0, 3e-2}, {3.0, 8e-2}}) {
            EXPECT_LT(errorAt(way), 3 * given) << way;
            EXPECT_GT(errorAt(way), given / 3) << way;
        }
        EXPECT_GT(errorAt(10), 0.1);
    }
}

TEST(HeavyViscousChart, hasEverySchemeForEveryPair) {
    const support::TestFolder folder;
    const auto file = folder.path() / "viscous.csv";
    const std::string tool = folders::tools.string() + "/Studies/accuracy-versus-cost --viscous ";
    const auto result =
        support::run(tool + "--viscous-starts 1 --shortest-way 3 --viscous-runs 1 --output " + file.string());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    auto rows = support::rowsOf(support::contentOf(file));
    EXPECT_EQ(rows.size(), 3u * 9 * 2 * 9);
    std::set<std::string> schemes;
    for (auto& row : rows) {
        schemes.insert(row["scheme"]);
        EXPECT_GT(std::stod(row["normal_ns_per_bridge_and_step"]), 0);
        EXPECT_TRUE(std::isfinite(std::stod(row["restitution_error"])));
    }
    EXPECT_EQ(schemes, (std::set<std::string>{"gap", "implicit", "explicit"}));
    support::expectOneSentence(support::run(tool + "--viscous-starts 0"), "viscous starts = 0");
}

}  // namespace
}  // namespace pendular::viscousPairTest
