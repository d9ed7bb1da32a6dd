// Faults of the readers that were found by fuzzing, or on the way to it.
#include <gtest/gtest.h>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "SelfTests/Fuzz/Target.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::foundFaultsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

/// The size of the mesh is 0, and the numbers of the cells in which equal corners are sought were not finite.
TEST(FoundFaults, aMeshThatIsAPointIsRefused) {
    TriangleWall wall;
    const Vector<double> p{1, 2, 3};
    const std::string text = refusal([&] { wall.set(std::vector<Triangle>{{p, p, p}}); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "there is no triangle with an area"));
}

/// The numbers of these cells, for a mesh of 2^-20 m at 2^29 m, went beyond 2^63.
TEST(FoundFaults, aSmallMeshFarAwayKeepsItsShape) {
    const double far = 0x1p29, edge = 0x1p-20;  // m; the spacing of doubles there is 2^-23 m
    const Vector<double> a{far, far, 0}, b{far + edge, far, 0}, c{far + edge, far + edge, 0},
        d{far, far + edge, 0};
    TriangleWall wall;
    wall.set(std::vector<Triangle>{{a, b, c}, {a, c, d}});
    EXPECT_EQ(wall.getNumberOfTriangles(), 2u);
    EXPECT_EQ(wall.getNumberLeftOut(), 0u);
}

/// Cells with corners that are no points, because the array of the points was missing.
TEST(FoundFaults, aVtkFileWithoutItsPointsIsRefused) {
    const support::TestFolder folder = support::TestFolder::inMemory();
    const std::filesystem::path path = folder.path() / "grains.vtp";
    std::string bytes = fuzz::polyData().makeSeeds().front();
    ASSERT_NE(bytes.find("<Points>"), bytes.npos);
    bytes.replace(bytes.find("<Points>"), 8, "<Pounds>");
    fuzz::writeBytes(path, bytes);
    const std::string text = refusal([&] { readPolyData(path); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "has arrays of the wrong size"));
}

class FoundFaultsOfRestart : public testing::Test {
protected:
    void SetUp() override {
        if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library.";
    }
    template <class Write, class Read>
    std::string refusalOf(Write&& write, Read&& read) const {
        writeRestartFile(path, write);
        const std::string text = refusal([&] { readRestartFile(path, read); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, path.string()));
        return text;
    }

    const support::TestFolder folder = support::TestFolder::inMemory();
    const std::filesystem::path path = folder.path() / "state.h5";
};

/// A bool that is neither true nor false.
TEST_F(FoundFaultsOfRestart, aYesOrNoThatIsSevenIsRefused) {
    std::uint8_t seven = 7;
    bool answer = false;
    EXPECT_TRUE(contains(refusalOf([&](StateArchive& archive) { archive.value("stopped", seven); },
                                   [&](StateArchive& archive) { archive.value("stopped", answer); }),
                         "stopped is neither 0 nor 1"));
}

TEST_F(FoundFaultsOfRestart, aRandomGeneratorOfOtherWordsIsRefused) {
    std::string words = "1 2 three";
    UniformRandom random(1);
    EXPECT_TRUE(contains(refusalOf([&](StateArchive& archive) { archive.text("generator", words); },
                                   [&](StateArchive& archive) { random.visitState(archive); }),
                         "generator is not the state of one"));
}

/// A table that promises 2^50 rows took the memory for them. HDF5 1.10 opens it, and 1.14 does not.
TEST_F(FoundFaultsOfRestart, aTableLargerThanTheFileIsRefused) {
    std::vector<double> curve(12345);
    const auto visit = [&](StateArchive& archive) { archive.column<double>("curve", curve); };
    writeRestartFile(path, visit);
    std::string bytes = fuzz::bytesOf(path);
    const auto asBytes = [](std::uint64_t number) {
        return std::string(reinterpret_cast<const char*>(&number), sizeof number);
    };
    int found = 0;
    for (std::size_t at = bytes.find(asBytes(12345)); at != bytes.npos; at = bytes.find(asBytes(12345), at)) {
        bytes.replace(at, 8, asBytes(std::uint64_t{1} << 50));
        ++found;
    }
    ASSERT_GT(found, 0);
    fuzz::writeBytes(path, bytes);
    sealRestartFile(path);
    const std::string text = refusal([&] { readRestartFile(path, visit); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "has fewer bytes than curve is to have numbers") ||
                contains(text, "has no table or text at curve that can be read"))
        << text;
}

}  // namespace
}  // namespace pendular::foundFaultsTest
