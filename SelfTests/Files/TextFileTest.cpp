// One set of rules for all readers of text: marks of UTF-8, ends of lines, decimal commas, files of another
// kind.
#include <gtest/gtest.h>

#include <functional>

#include "Kernel/Core/Run/SummaryFile.h"
#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Foundation/Files/FileContent.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular::textFileTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TemporaryFile;
using namespace std::string_literals;

/// A reader of text, and a good file for it, with lines that end by LF.
struct Reader {
    std::string name, good;
    std::function<double(const std::filesystem::path&)> read;  // a number of what was read
    std::string withComma;  // the same with a decimal comma; empty where the format has none
};

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1.5 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

double lastTriangle(const std::filesystem::path& path) { return readTriangles(path).back()[1].x; }
double lastGrain(const std::filesystem::path& path) { return readGrainFile(path).back().position.x(); }

std::vector<Reader> readers() {
    const std::string data = "a bed\n\n1 atoms\n1 atom types\n\nAtoms # sphere\n\n1 1 0.002 2500 ",
                      dump = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS radius x y z\n0.001 ";
    return {
        {"STL", "solid a\n" + facet + "endsolid a\n", lastTriangle,
         "solid a\n" + std::string(facet).replace(facet.find("1.5"), 3, "1,5") + "endsolid a\n"},
        {"OBJ", "v 0 0 0\nv 1.5 0 0\nv 0 1 0\nf 1 2 3\n", lastTriangle,
         "v 0 0 0\nv 1,5 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"PLY",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
         "z\nelement "
         "face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1.5 0 0\n0 1 0\n3 0 1 2\n",
         lastTriangle,
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
         "z\nelement "
         "face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n"},
        {"triangles", "# walls\n0 0 0 1.5 0 0 0 1 0\n", lastTriangle, "# walls\n0 0 0 1,5 0 0 0 1 0\n"},
        {"grains", "radius x y z\n1e-3 0.25 0 0\n1e-3 1.5 0 0\n", lastGrain,
         "radius x y z\n1e-3 0.25 0 0\n1e-3 1,5 0 0\n"},
        {"LAMMPS data", data + "1.5 0 0\n", lastGrain, data + "1,5 0 0\n"},
        {"dump", dump + "1.5 0 0\n", lastGrain, dump + "1,5 0 0\n"},
        {"spheres", "# a clump\n0 0 0 1\n1.5 0 0 1\n",
         [](const std::filesystem::path& path) { return readSpheres(path).back().centre.x(); },
         "# a clump\n0 0 0 1\n1,5 0 0 1\n"},
        {"sizes", "diameter_mm,single_number\n1.5,1\n",
         [](const std::filesystem::path& path) { return 1e3 * readSizeTable(path).smallest(); },
         "diameter_mm,single_number\n1,5,1\n"},
        {"summary", "quantity,value,unit\ntime,1.5,s\n",
         [](const std::filesystem::path& path) { return std::stod(SummaryFile(path).rows().at(0).value); },
         ""},
    };
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

TEST(TextReaders, takeAnyEndOfLineAndTheMarkOfUtf8) {
    for (const Reader& reader : readers())
        for (const std::string mark : {"", "\xEF\xBB\xBF"})
            for (const std::string lineEnd : {"\n", "\r\n", "\r"}) {
                const TemporaryFile file(".txt", mark + replaced(reader.good, "\n", lineEnd));
                double value = 0;
                EXPECT_EQ(refusal([&] { value = reader.read(file.path); }), "") << reader.name;
                EXPECT_NEAR(value, 1.5, 1e-12) << reader.name;
            }
}

TEST(TextReaders, refuseDecimalCommasWithASentence) {
    for (const Reader& reader : readers()) {
        if (reader.withComma.empty()) continue;
        const std::string text = refusal([&] { reader.read(TemporaryFile(".txt", reader.withComma).path); });
        EXPECT_TRUE(isOneSentence(text)) << reader.name;
        EXPECT_TRUE(contains(text, "decimals have a point")) << reader.name;
        EXPECT_TRUE(contains(text, "line ")) << reader.name;
    }
}

TEST(TextReaders, sayWhatFilesOfAnotherKindAre) {
    const auto utf16 = [](const std::string& text, bool isBig) {
        std::string wide;
        for (const char c : text) wide += isBig ? std::string{'\0', c} : std::string{c, '\0'};
        return wide;
    };
    const std::vector<std::pair<std::string, std::string>> others{
        {"PK\x03\x04\x14\0\x06\0"s, "a ZIP archive, as 3MF files"},
        {"\x1F\x8B\x08\0\0\0"s, "a gzip archive"},
        {"\x89PNG\r\n\x1A\n\0\0"s, "a PNG picture"},
        {"\x89HDF\r\n\x1A\n\0\0"s, "an HDF5 file"},
        {"%PDF-1.4\n", "a PDF document"},
        {"\xFF\xFE" + utf16("1 2 3 4\n", false), "UTF-16 text"},
        {"\xFE\xFF" + utf16("1 2 3 4\n", true), "UTF-16 text"},
        {utf16("1 2 3 4\n", false), "UTF-16 text"},
        {"\n <!DOCTYPE html>\n<html><body>404</body></html>\n", "an HTML page"},
        {"<?xml version=\"1.0\"?>\n<amf/>\n", "an XML file"},
        {"ISO-10303-21;\nHEADER;\n", "a STEP file"},
        {"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "a pointer of Git LFS"},
        {"OFF\n4 4 6\n", "an OFF mesh"},
        {"solid a\n" + facet + "endsolid a\n", "an STL mesh"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "an OBJ mesh"},
        {"# made\nmtllib a.mtl\nusemtl grey\nv 0 0 0\n", "an OBJ mesh"},
        {"ply\nformat ascii 1.0\n", "a PLY mesh"},
        {"ITEM: TIMESTEP\n0\n", "a dump of LAMMPS or LIGGGHTS"},
        {"a bed\n\n1 atoms\n1 atom types\n", "a LAMMPS data file"},
    };
    for (const Reader& reader : readers())
        for (const auto& [bytes, name] : others) {
            EXPECT_TRUE(contains(std::string(recognise(bytes).name), name));
            const bool isMesh = contains(name, "STL") || contains(name, "OBJ") || contains(name, "PLY");
            const bool readsMeshes = reader.name == "STL" || reader.name == "OBJ" || reader.name == "PLY" ||
                                     reader.name == "triangles";
            const bool isGrains = contains(name, "LAMMPS"), readsGrains = reader.name == "grains" ||
                                                                          contains(reader.name, "LAMMPS") ||
                                                                          reader.name == "dump";
            if ((isMesh && readsMeshes) || (isGrains && readsGrains)) continue;  // its own
            const std::string text =
                refusal([&, bytes = bytes] { reader.read(TemporaryFile(".stl", bytes).path); });
            EXPECT_TRUE(isOneSentence(text)) << reader.name;
            EXPECT_TRUE(contains(text, "is " + name)) << reader.name;
        }
}

// A number that begins a row makes it no other kind, whatever words its header has.
TEST(TextReaders, takeRowsForWhatTheyAre) {
    EXPECT_EQ(recognise("v x y z\n1 2 3 4\n").content, FileContent::Unknown);
    EXPECT_EQ(recognise("1e-3 0 0 0\n2 1 1 1\n").content, FileContent::Unknown);
    EXPECT_EQ(recognise("").content, FileContent::Unknown);
    EXPECT_EQ(recognise(std::string(84, '\0')).content, FileContent::BinaryStl);
    EXPECT_EQ(readGrainFile(TemporaryFile(".txt", "solid x y z\n1e-3 1.5 0 0\n").path).size(), 1u);
    EXPECT_EQ(lastTriangle(TemporaryFile(".stl", "0 0 0 1.5 0 0 0 1 0\n").path), 1.5);
}

TEST(TextReaders, takeRowsPartedByCommas) {
    const auto rows = [](const std::string& text) { return readGrainFile(TemporaryFile(".csv", text).path); };
    for (const std::string row : {"1e-3,1.5,2,3", "1e-3, 1.5, 2, 3", " 1e-3 ,1.5\t, 2,3,", "1e-3 1.5 2 3"}) {
        const auto grains = rows("radius,x,y,z\n" + row + "\n");
        ASSERT_EQ(grains.size(), 1u) << row;
        EXPECT_EQ(grains[0].position, Vec3D(1.5, 2, 3)) << row;
    }
    EXPECT_TRUE(contains(refusal([&] { rows("1e-3,,2,3\n"); }), "line 1, column 6: ',' is not a number"));
    EXPECT_TRUE(contains(refusal([&] { rows("0,001 1,5 2,0 3,0\n"); }), "'0,001' is not a number (decimals"));
    EXPECT_TRUE(contains(refusal([&] { rows("0,001;1,5;2,0;3,0\n"); }), "decimals have a point"));
    // These two numbers with decimal commas would be four numbers without.
    EXPECT_TRUE(contains(refusal([] { readSpheres(TemporaryFile(".txt", "0,5 1,25\n").path); }), "'0,5'"));
    EXPECT_TRUE(contains(refusal([&] { rows("1.5D-3 0 0 0\n"); }), "powers of ten"));
    EXPECT_TRUE(contains(refusal([&] { rows("+-1 0 0 0\n"); }), "'+-1' is not a number"));
    EXPECT_TRUE(
        contains(refusal([&] { rows("1e-3 0 0 0\n1\0"s + "e-3 0 0 0\n"); }), "offset 12: a byte is zero"));
}

TEST(TextReaders, normalsOfFacetsMayBeAnyWord) {
    for (const std::string normal :
         {"nan nan nan", "-1.#IND -1.#IND -1.#IND", "1.#QNAN 0 -nan(ind)", "0,5 x -"}) {
        const std::string text =
            "solid a\n" + std::string(facet).replace(facet.find("0 0 1"), 5, normal) + "endsolid\n";
        EXPECT_EQ(lastTriangle(TemporaryFile(".stl", text).path), 1.5) << normal;
    }
}

}  // namespace
}  // namespace pendular::textFileTest
