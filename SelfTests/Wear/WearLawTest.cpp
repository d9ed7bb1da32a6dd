// The laws alone, and what is refused.
#include "Kernel/Features/Wear/WearLaw.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Wear/WearScene.h"

namespace pendular::wearLawTest {
namespace {

using namespace wearTests;
using support::contains, support::isOneSentence, support::refusal;

double finnieFactor(double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return finnieEnergy(1, std::sin(angle), std::cos(angle));
}

TEST(WearLaw, ofFinnieIsThatOfAnIndependentTable) {
    // wear_finnie.csv: angle (degrees), f. Its numbers have 15 digits.
    constexpr std::array<std::array<double, 2>, 5> table{{{10, 0.251559074504531},
                                                          {18.4349488229, 0.300000000000077},
                                                          {20, 0.29434074051983},
                                                          {45, 0.166666666666667},
                                                          {75, 0.0223290993692602}}};
    for (const auto& [degrees, factor] : table) EXPECT_NEAR(finnieFactor(degrees), factor, 2e-15) << degrees;
    EXPECT_EQ(finnieFactor(0), 0);
    EXPECT_NEAR(finnieFactor(90), 0, 1e-30);
}

TEST(WearLaw, ofFinnieIsSmoothWhereItsBranchesMeetAndLargestBelow) {
    const double meet = std::atan(1.0 / 3) * 180 / std::numbers::pi;  // 18.43 degrees
    // Both branches are 0.3 there; their slopes, 2 cos 2a - 3 sin 2a and -sin 2a / 3, are both -0.2 a radian;
    // the second derivative, -4 sin 2a - 6 cos 2a = -7.2, makes 1.1e-6 of the difference.
    const double h = 1e-3, perDegree = -0.2 * std::numbers::pi / 180;
    EXPECT_NEAR(finnieFactor(meet), 0.3, 1e-15);
    EXPECT_NEAR((finnieFactor(meet + h) - finnieFactor(meet)) / h, perDegree, 1.2e-6);
    EXPECT_NEAR((finnieFactor(meet) - finnieFactor(meet - h)) / h, perDegree, 1.2e-6);
    // The slope of the first branch is zero at tan 2a = 2/3, where f = (sqrt(13) - 3) / 2.
    const double steepest = 0.5 * std::atan(2.0 / 3) * 180 / std::numbers::pi;
    EXPECT_NEAR(finnieFactor(steepest), 0.5 * (std::sqrt(13.0) - 3), 1e-15);
    for (double a = 0; a <= 90; a += 0.25) EXPECT_LE(finnieFactor(a), finnieFactor(steepest)) << a;
}

TEST(WearLaw, countsOnlyWhatItIsOf) {
    const ContactWear slid{.slidingWork = 2e-3, .loadTimesPath = 5e-3};
    EXPECT_DOUBLE_EQ(WearLaw::reye(3e-12).volume(slid), 6e-15);
    EXPECT_DOUBLE_EQ(WearLaw::archard(1e-3, 1e9).volume(slid), 5e-15);
    EXPECT_EQ(WearLaw::finnie(0.5, 1e9).volume(slid), 0);
    EXPECT_EQ(WearLaw::none().volume(slid), 0);
    const ContactWear hit{.isImpact = true, .mass = 2e-6, .normalSpeed = 3, .tangentialSpeed = 4};
    EXPECT_DOUBLE_EQ(WearLaw::finnie(0.5, 1e9).volume(hit), 0.5 * 2e-6 * 16 / 3 / 1e9);  // tan a = 3/4
    EXPECT_EQ(WearLaw::reye(3e-12).volume(hit), 0);
    EXPECT_DOUBLE_EQ(hit.impactWork(), 9e-6);
}

TEST(WearLaw, refusesWhatIsNone) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& text :
         {refusal([] { WearLaw::reye(-1e-12); }), refusal([&] { WearLaw::reye(nan); }),
          refusal([] { WearLaw::archard(-1e-3, 1e9); }), refusal([] { WearLaw::archard(1e-3, 0); }),
          refusal([] { WearLaw::archard(1e-3, infinity); }), refusal([] { WearLaw::finnie(1.5, 1e9); }),
          refusal([] { WearLaw::finnie(-0.1, 1e9); }), refusal([] { WearLaw::finnie(0.5, 0); })})
        EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(refusal([] { WearLaw::archard(1e-3, 0); }), "hardness H"));
    EXPECT_TRUE(contains(refusal([] { WearLaw::archard(1e-3, 0); }), "Pa"));
}

TEST(Wear, isRefusedWhereItCannotBeKept) {
    TriangleWall shapeless;
    EXPECT_TRUE(isOneSentence(refusal([&] { shapeless.keepWear(WearLaw::none()); })));
    EXPECT_TRUE(isOneSentence(refusal([] { static_cast<void>(plate(1).getWear()); })));

    WallScene<Smooth> smooth({{.position = {0, 0, 1.1 * radius}}});
    TriangleWall wall = plate(0.1);
    wall.keepWear(WearLaw::reye(1e-12));
    smooth.add(wall);
    EXPECT_TRUE(contains(refusal([&] { smooth.initialise(); }), "no friction"));

    WallScene<Dry> inRun({{.position = {0, 0, 1.1 * radius}}});
    TriangleWall* without = inRun.add(plate(0.1));
    inRun.initialise();
    inRun.step();
    EXPECT_TRUE(isOneSentence(refusal([&] { without->keepWear(WearLaw::none()); })));
    TriangleWall late = wallTests::mesh(wallTests::parallelogram({0, 0, -1}, {1, 0, 0}, {0, 1, 0}));
    late.keepWear(WearLaw::none());
    inRun.add(late);
    try {
        inRun.step();
        ADD_FAILURE() << "nothing was refused";
    } catch (const std::runtime_error& error) {
        EXPECT_TRUE(contains(error.what(), "keepEnergyLedger()"));
    }
}

}  // namespace
}  // namespace pendular::wearLawTest
