#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <filesystem>

#include "BuildFolders.h"
#include "Kernel/Features/Meshes/TriangleReader.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/SharedData.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular::readerTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::Random;
using support::refusal;
using support::TemporaryFile;

std::vector<Triangle> read(const std::string& ending, const std::string& text, double scale = 1) {
    return readTriangles(TemporaryFile(ending, text).path, scale);
}
std::string refused(const std::string& ending, const std::string& text) {
    return refusal([&] { read(ending, text); });
}

std::string facet(const std::string& vertices = "vertex 0 0 0 vertex 1 0 0 vertex 0 1 0",
                  const std::string& normal = "0 0 1") {
    return "facet normal " + normal + "\nouter loop\n" + vertices + "\nendloop\nendfacet\n";
}
std::string solid(const std::string& facets) { return "solid some name\n" + facets + "endsolid some name\n"; }

std::string binary(const std::vector<float>& coordinates, std::uint32_t count,
                   const std::string& header = "made by hand") {
    std::string text(84, '\0');
    std::memcpy(text.data(), header.data(), header.size());
    const auto put = [&](std::uint32_t bits, std::size_t at) {
        for (int k = 0; k < 4; ++k)
            text[at + static_cast<std::size_t>(k)] = static_cast<char>(bits >> (8 * k) & 255);
    };
    put(count, 80);
    for (std::size_t f = 0; f < coordinates.size() / 9; ++f) {
        const std::size_t at = text.size();
        text.resize(at + 50, '\0');
        for (std::size_t k = 0; k < 9; ++k)
            put(std::bit_cast<std::uint32_t>(coordinates[9 * f + k]), at + 12 + 4 * k);
    }
    return text;
}
const std::vector<float> twoFacets{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 1, 0, 0, 0, 1, -2.25f};

TEST(StlReader, readsAscii) {
    const auto t =
        read(".stl", solid(facet() + facet("vertex +1e-3 2.5E0 -3 vertex 4 5 6 vertex 7 8 9", "nan 0 0")));
    ASSERT_EQ(t.size(), 2u);
    EXPECT_EQ(t[0][1], (Vector<double>{1, 0, 0}));
    EXPECT_EQ(t[1][0], (Vector<double>{1e-3, 2.5, -3}));
    EXPECT_EQ(t[1][2], (Vector<double>{7, 8, 9}));
    EXPECT_EQ(
        read(".STL",
             "SOLID\r\nFacet Normal 0 0 1\r\nOuter Loop\r\nVertex 0 0 0\r\nVertex 1 0 0\r\nVertex 0 1 0\r\n"
             "EndLoop\r\nEndFacet\r\nEndSolid\r\n")
            .size(),
        1u);
    EXPECT_EQ(read(".stl", solid(facet()) + solid(facet())).size(), 2u);
}

TEST(StlReader, readsBinaryWhateverItsHeader) {
    for (const std::string header : {"made by hand", "solid but binary", ""}) {
        const auto t = read(".stl", binary(twoFacets, 2, header), 1e-3);
        ASSERT_EQ(t.size(), 2u);
        EXPECT_DOUBLE_EQ(t[1][0].z, 0.5e-3);
        EXPECT_DOUBLE_EQ(t[1][2].z, -2.25e-3);
    }
}

TEST(RowReader, readsRowsWithAndWithoutHeader) {
    const std::string row = "0 0 0\t1 0 0\t0 1 -2.25e0\n";
    EXPECT_EQ(read(".txt", "v1_X[m] v1_Y[m] ...\n" + row + "\n# a comment\n" + row).size(), 2u);
    EXPECT_EQ(read(".csv", "v1.x,v1.y,v1.z,v2.x,v2.y,v2.z,v3.x,v3.y,v3.z\n" + row).size(), 1u);
    EXPECT_EQ(read(".txt", row)[0][2].z, -2.25);
    EXPECT_EQ(read(".csv", "0 0 0 1 0 0 0 1 5\r\n0 0 0 1 0 0 0 1 5")[1][2].z, 5);
}

TEST(RowReader, readsPublishedWalls) {
    if (!support::hasSharedData("drum38k-walls.txt"))
        GTEST_SKIP() << support::withoutSharedData("drum38k-walls.txt");
    const std::filesystem::path drum = support::sharedData("drum38k-walls.txt");
    EXPECT_EQ(readTriangles(drum).size(), 1200u);
}

TEST(Readers, refuseWithFilePlaceAndReason) {
    struct Case {
        std::string ending, text, place, reason;
    };
    const auto badVertex = [](const std::string& v) {
        return solid(facet("vertex 0 0 0 vertex 1 0 0 vertex " + v));
    };
    const std::vector<Case> cases{
        {".stl", "", "", "0 bytes"},
        {".stl", "solid", "line 1", "ends without 'endsolid'"},
        {".stl", solid(""), "", "holds no triangles"},
        {".stl", "solid a\n" + facet(), "line 7", "ends without 'endsolid'"},
        {".stl", "solid a\nfacet", "line 2", "ends where 'normal'"},
        {".stl", "solid a\nfacets", "line 2", "'facets' where"},
        {".stl", solid(facet("vertex 0 0 0 vertex 1 0 0")), "line 5", "'endloop' where 'vertex'"},
        {".stl", badVertex("0 1 x"), "line 4", "'x' is not a number"},
        {".stl", badVertex("0 1 nan"), "line 4", "not finite"},
        {".stl", badVertex("0 1 inf"), "line 4", "not finite"},
        {".stl", badVertex("0 1 1e10"), "line 4", "not finite or above"},
        {".stl", badVertex("0 1 1e999"), "line 4", "is not a number"},
        {".stl", badVertex("0 1 2 3"), "line 4", "'3' where 'endloop'"},
        {".stl", badVertex("0 1 2,5"), "line 4", "not a number"},
        {".stl", solid(facet("vertex 0 0 0 vertex 1 0 0 vertex 0 1 0", "up")), "line 2", "normal"},
        {".stl", "hello", "", "5 bytes"},
        {".stl", std::string(84, '\0'), "", "holds no triangles"},
        {".stl", binary(twoFacets, 3), "offset 80", "3 facets need 234 bytes; the file has 184"},
        {".stl", binary(twoFacets, 1), "offset 80", "bytes"},
        {".stl", binary(twoFacets, 0xffffffffu), "offset 80", "bytes"},
        {".stl", binary({0, 0, 0, 1, 0, 0, 0, NAN, 0}, 1), "offset 124", "not finite"},
        {".stl", binary({0, 0, 0, 1, 0, 0, 0, 1e30f, 0}, 1), "offset 124", "not finite or above"},
        {".txt", "", "", "holds no triangles"},
        {".txt", "header only\n", "", "holds no triangles"},
        {".txt", "h\n0 0 0 1 0 0 0 1\n", "line 2", "8 numbers"},
        {".txt", "0 0 0 1 0 0 0 1 0 7\n", "line 1", "more than the 9"},
        {".txt", "h\n\nsecond header\n", "line 3", "'second' is not a number"},
        {".txt", "0 0 0 1 0 0 0 1 0\n0 0 0 1 0 zero 0 1 0\n", "line 2", "'zero' is not a number"},
        {".txt", "nan 0 0 1 0 0 0 1 0\n", "line 1", "not finite"},
        {".txt", "0 " + std::string(100000, '7'), "line 1", "not a number"},
    };
    for (const Case& c : cases) {
        const std::string text = refused(c.ending, c.text);
        EXPECT_TRUE(isOneSentence(text)) << c.reason;
        EXPECT_TRUE(contains(text, c.place)) << c.reason;
        EXPECT_TRUE(contains(text, c.reason));
        EXPECT_TRUE(contains(text, "pendular-")) << "the file's name";
        EXPECT_LT(text.size(), 400u);
    }
    EXPECT_TRUE(contains(refusal([] { readTriangles("/no/such/file.stl"); }), "does not exist"));
    EXPECT_TRUE(contains(refusal([] { readTriangles(std::filesystem::temp_directory_path()); }), "regular"));
    if (std::filesystem::exists("/dev/zero")) {
        EXPECT_TRUE(contains(refusal([] { readTriangles("/dev/zero"); }), "regular"));
    }
    EXPECT_TRUE(isOneSentence(refusal([] { read(".txt", "0 0 0 1 0 0 0 1 0", 0); })));
}

TEST(Readers, damagedFilesNeverDoMoreThanRefuse) {
    const std::vector<std::pair<std::string, std::string>> good{
        {".stl", solid(facet() + facet())},
        {".stl", binary(twoFacets, 2)},
        {".txt", "h h h\n0 0 0 1 0 0 0 1 0\n0 0 0 1 0 0 0 1 0\n"}};
    Random draw(5);
    for (const auto& [ending, text] : good)
        for (int k = 0; k < 500; ++k) {
            std::string damaged = text.substr(
                0, static_cast<std::size_t>(draw.uniform(0, static_cast<double>(text.size()) + 1)));
            for (int change = 0; change < 3 && !damaged.empty(); ++change)
                damaged[static_cast<std::size_t>(draw.uniform(0, static_cast<double>(damaged.size())))] =
                    static_cast<char>(static_cast<int>(draw.uniform(0, 256)));
            try {
                for (const Triangle& t : read(ending, damaged))
                    for (const auto& vertex : t) EXPECT_TRUE(std::isfinite(norm(vertex)));
            } catch (const InputError& error) {
                const std::string text = error.what();  // may quote a few characters of the file
                EXPECT_EQ(text.find('\n'), std::string::npos);
                EXPECT_EQ(text.back(), '.');
                EXPECT_LT(text.size(), 400u);
            }
        }
}

}  // namespace
}  // namespace pendular::readerTest
