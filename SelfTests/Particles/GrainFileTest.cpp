#include <gtest/gtest.h>

#include <filesystem>

#include "BuildFolders.h"
#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/SharedData.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular::grainFileTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TemporaryFile;

std::vector<GrainRow> read(const std::string& text) {
    return readGrainFile(TemporaryFile(".txt", text).path);
}

TEST(GrainFile, readsRowsOfRadiusAndPosition) {
    const auto grains =
        read("Radius[m]\tPosX[m] PosY[m] PosZ[m]\r\n 0.001 -0.5 0.25 3e-2\r\n\r\n# end\r\n2 1 2 3");
    ASSERT_EQ(grains.size(), 2u);
    EXPECT_EQ(grains[0].radius, 0.001);
    EXPECT_EQ(grains[0].position, Vec3D(-0.5, 0.25, 3e-2));
    EXPECT_EQ(grains[1].radius, 2);
    EXPECT_EQ(grains[1].position, Vec3D(1, 2, 3));
}

TEST(GrainFile, readsTheSixNumbersOfASingleSphere) {
    const auto grains = read("0.001 0 0 0\n5 0.01 0.01 1 2 0.06\n");
    ASSERT_EQ(grains.size(), 2u);
    EXPECT_EQ(grains[1].radius, 0.01);
    EXPECT_EQ(grains[1].position, Vec3D(1, 2, 0.06));
}

TEST(GrainFile, refusesWithFilePlaceAndReason) {
    struct Case {
        std::string text, place, reason;
    };
    const std::vector<Case> cases{
        {"", "", "holds no grains"},
        {"radius x y z\n", "", "holds no grains"},
        {"1e-3 0 0\n", "line 1", "3 numbers; a grain has 4"},
        {"r x y z\n1e-3 0 0 0\n1e-3 0 0 0 0\n", "line 3", "5 numbers"},
        {"1e-3 0 0 0\n1e-3 0 up 0\n", "line 2", "'up' is not a number"},
        {"1e-3 0 0 nan\n", "line 1", "not finite"},
        {"1e-3 0 0 1e10\n", "line 1", "above 1e+09 m"},
        {"0 0 0 0\n", "line 1", "the radius 0 m must be "},
        {"1e-310 0 0 0\n", "line 1", "the radius 1e-310 m must be at least 1e-12 m and at most 1000000000 m"},
        {"1e-3 0 0 0\n1e300 0 0 0\n", "line 2, column 1:", "1e300 is not finite or above 1e+09 m"},
        // A first line that is no header is not taken for one.
        {"0,001 0 0 0\n", "line 1, column 1:", "'0,001' is not a number (decimals have a point"},
        {"0x1p-10 0 0 0\n1e-3 0 0 0\n", "line 1, column 1:", "'0x1p-10' is not a number"},
        {"r 0 0 0\n", "line 1, column 1:", "'r' is not a number"},
        {"O.O01 y z x\n1e-3 0 0 0\n", "line 1, column 1:", "'O.O01' is not a number"},
        {"l.001 O O O\n1e-3 0 0 0\n", "line 1, column 1:", "'l.001' is not a number"},
        {"1e-3  O 0 0\n", "line 1, column 7:", "'O' is not a number"},
        {"-1e-3 0 0 0\n", "line 1", "the radius -0.001 m"},
        {"5 0.01 0.02 0 0 0\n", "line 1", "contact radius 0.02 m differ"},
    };
    for (const Case& c : cases) {
        const std::string text = refusal([&] { read(c.text); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "The grain file "));
        EXPECT_TRUE(contains(text, "pendular-")) << "the file's name";
        EXPECT_TRUE(contains(text, c.place));
        EXPECT_TRUE(contains(text, c.reason));
    }
    EXPECT_TRUE(contains(refusal([] { readGrainFile("/no/such/file.txt"); }), "does not exist"));
}

/// Counts, sizes and places as the description of the benchmark gives them.
TEST(GrainFile, readsPublishedStates) {
    const std::filesystem::path data = folders::shared / "data";
    if (!support::hasSharedData("drum38k.txt")) GTEST_SKIP() << support::withoutSharedData("drum38k.txt");
    const auto count = [](const std::vector<GrainRow>& grains, double radius) {
        return std::count_if(grains.begin(), grains.end(),
                             [&](const GrainRow& g) { return g.radius == radius; });
    };
    const auto drum = readGrainFile(data / "drum38k.txt");
    EXPECT_EQ(count(drum, 0.001), 30000);
    EXPECT_EQ(count(drum, 0.002), 8000);
    EXPECT_EQ(drum.size(), 38000u);
    const auto bed = readGrainFile(data / "penetration25k.txt");
    EXPECT_EQ(count(bed, 0.001), 25000);
    ASSERT_EQ(bed.size(), 25001u);
    EXPECT_EQ(bed.back().radius, 0.01);
    EXPECT_EQ(bed.back().position, Vec3D(0, 0, 0.06));
    EXPECT_EQ(readGrainFile(data / "bed25k.txt").size(), 25000u);
}

}  // namespace
}  // namespace pendular::grainFileTest
