// The files of VTK's kind "PolyData": what was written is read again, by our reader and, where it is
// installed, by VTK's own.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "BuildFolders.h"
#include "Kernel/Analysis/Output/Compression.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "SelfTests/Support/Dependency.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::polyDataTest {
namespace {

using support::contentOf;
using support::refusal;
using support::TestFolder;

/// Points with numbers of each type, joined by triangles; more than one block of compressed data.
PolyData example(std::size_t triangles) {
    support::Random random(7);
    PolyData data;
    data.time = 0.1;
    data.kind = PolyData::Cells::Polygons;
    std::vector<float> floats;
    std::vector<double> doubles;
    std::vector<std::int32_t> integers;
    for (std::size_t k = 0; k < 3 * triangles; ++k) {
        data.corners.push_back(static_cast<std::int32_t>(data.points.size()));
        data.points.push_back(
            {random.uniform(-1, 1), random.uniform(-1e-9, 1e-9), random.uniform(-1e9, 1e9)});
        for (int c = 0; c < 3; ++c) floats.push_back(static_cast<float>(random.uniform(-1, 1)));
        doubles.push_back(std::exp(random.uniform(-300, 300)));
        if (k % 3 != 2) continue;
        data.ends.push_back(static_cast<std::int32_t>(data.corners.size()));
        integers.push_back(static_cast<std::int32_t>(k) * (k % 2 == 0 ? 1 : -1));
    }
    data.pointFields = {{"velocity_m_per_s", 3, floats}, {"size_m", 1, doubles}};
    data.cellFields = {{"number", 1, integers}};
    return data;
}

void expectSame(const PolyDataField& a, const PolyDataField& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.components, b.components);
    EXPECT_EQ(a.numbers, b.numbers) << a.name;
}

void expectSame(const PolyData& a, const PolyData& b) {
    EXPECT_EQ(a.time, b.time);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.ends, b.ends);
    EXPECT_EQ(a.corners, b.corners);
    if (!a.ends.empty()) {
        EXPECT_EQ(a.kind, b.kind);
    }
    ASSERT_EQ(a.pointFields.size(), b.pointFields.size());
    for (std::size_t k = 0; k < a.pointFields.size(); ++k) expectSame(a.pointFields[k], b.pointFields[k]);
    ASSERT_EQ(a.cellFields.size(), b.cellFields.size());
    for (std::size_t k = 0; k < a.cellFields.size(); ++k) expectSame(a.cellFields[k], b.cellFields[k]);
}

TEST(Compression, givesBackTheBytesOfAnyLength) {
    support::Random random(1);
    // Around the size of a block, 131072 bytes, and of whole blocks.
    for (const std::size_t size : {0, 1, 4095, 4097, 131071, 131072, 131073, 262144, 300000})
        for (const bool repeats : {false, true}) {
            std::string bytes;
            for (std::size_t k = 0; k < size; ++k)
                bytes +=
                    static_cast<char>(repeats ? k / 1000 : static_cast<std::size_t>(random.uniform(0, 256)));
            const std::string packed = compressInBlocks(std::as_bytes(std::span(bytes)));
            EXPECT_EQ(decompressBlocks(packed, size), bytes) << size;
            EXPECT_EQ(compressInBlocks(std::as_bytes(std::span(bytes)), 3), packed) << size;
            if (repeats && size > 100000) {
                EXPECT_LT(packed.size(), size / 50);
            }
            // Noise is stored: 5 bytes for 65535, 11 for the stream, and the table.
            EXPECT_LT(packed.size(), size + size / 1000 + 100);
            EXPECT_THROW(decompressBlocks(packed, size + 1), std::runtime_error);
            if (size > 0) {
                EXPECT_THROW(decompressBlocks(packed, size - 1), std::runtime_error);
            }
        }
}

TEST(PolyDataFile, isReadAsItWasWritten) {
    const TestFolder folder;
    const auto path = folder.path() / "a.vtp";
    for (const std::size_t triangles : {0, 1, 2, 20000}) {
        const PolyData data = example(triangles);
        writePolyData(path, data);
        expectSame(readPolyData(path), data);
        const std::string bytes = contentOf(path);
        writePolyData(path, data, 3);
        EXPECT_EQ(contentOf(path), bytes);
    }
    PolyData lines = example(4);
    lines.kind = PolyData::Cells::Lines;
    writePolyData(path, lines);
    expectSame(readPolyData(path), lines);
}

/// No damage to a file crashes the reader: it is read, or refused in one sentence with its name.
TEST(PolyDataFile, thatIsDamagedIsRefused) {
    const TestFolder folder;
    const auto path = folder.path() / "a.vtp";
    writePolyData(path, example(3));
    const std::string whole = contentOf(path);
    const auto refusalOf = [&](const std::string& text) {
        std::ofstream(path, std::ios::binary) << text;
        return refusal([&] { readPolyData(path); });
    };
    EXPECT_EQ(refusalOf(whole), "");
    int refused = 0;
    support::Random random(3);
    for (int k = 0; k < 400; ++k) {
        std::string text = whole;
        const auto at = static_cast<std::size_t>(random.uniform(0, static_cast<double>(text.size())));
        if (k % 4 == 0) text.resize(at);
        else text[at] = static_cast<char>(static_cast<int>(random.uniform(0, 256)));
        const std::string reason = refusalOf(text);
        if (reason.empty()) continue;
        ++refused;
        EXPECT_TRUE(support::contains(reason, path.string()));
        EXPECT_EQ(reason.find('\n'), std::string::npos) << reason;
    }
    EXPECT_GT(refused, 99);  // all that were cut, a quarter, to begin with
    EXPECT_TRUE(support::contains(refusalOf("<VTKFile type=\"PolyData\">"), "no VTK file with raw appended"));
    std::string huge = whole;
    huge.replace(huge.find("NumberOfPoints=\"9\""), 18, "NumberOfPoints=\"999999999999\"");
    EXPECT_TRUE(support::contains(refusalOf(huge), "ends too early"));
}

const std::string python = "/usr/bin/python3";

bool isVtkMissing() {
    return support::isMissing(support::run(python + " -c 'import vtk'").exitCode == 0, "python3-vtk9");
}

void expectThatVtkReads(const std::filesystem::path& path, const PolyData& data) {
    const std::string script = (folders::source / "SelfTests/Output/read_vtp.py").string();
    const auto result = support::run(python + " " + script + " " + path.string());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    std::istringstream words(result.output);
    double number = 0;
    const auto expectNext = [&](double expected, const char* what) {
        ASSERT_TRUE(words >> number) << what;
        ASSERT_EQ(number, expected) << what;
    };
    const auto expectField = [&](const PolyDataField& field) {
        std::string name;
        words >> name;
        EXPECT_EQ(name, field.name);
        expectNext(static_cast<double>(field.components), "components");
        for (std::size_t k = 0; k < field.size(); ++k)
            ASSERT_NO_FATAL_FAILURE(expectNext(field.at(k), "field"));
    };
    expectNext(data.time, "time");
    expectNext(static_cast<double>(data.points.size()), "points");
    for (const Vector<double>& p : data.points)
        for (const double x : {p.x, p.y, p.z}) ASSERT_NO_FATAL_FAILURE(expectNext(x, "coordinate"));
    expectNext(static_cast<double>(data.ends.size()), "cells");
    for (std::size_t cell = 0, k = 0; cell < data.ends.size(); ++cell) {
        const auto end = static_cast<std::size_t>(data.ends[cell]);
        expectNext(static_cast<double>(end - k), "corners of a cell");
        for (; k < end; ++k) ASSERT_NO_FATAL_FAILURE(expectNext(data.corners[k], "corner"));
    }
    for (const PolyDataField& field : data.pointFields) expectField(field);
    for (const PolyDataField& field : data.cellFields) expectField(field);
    std::string rest;
    EXPECT_FALSE(words >> rest) << rest;
}

TEST(PolyDataFile, isReadByVtk) {
    if (isVtkMissing())
        GTEST_SKIP() << support::without("python3-vtk9", "that VTK reads the files for ParaView");
    const TestFolder folder;
    const auto path = folder.path() / "a.vtp";
    for (const std::size_t triangles : {0, 1, 3000}) {
        writePolyData(path, example(triangles));
        expectThatVtkReads(path, example(triangles));
    }
}

/// Also where one of the pieces has nothing.
TEST(PolyDataFile, inPiecesIsReadByVtk) {
    if (isVtkMissing())
        GTEST_SKIP() << support::without("python3-vtk9", "that VTK reads the files for ParaView");
    const TestFolder folder;
    const auto index = folder.path() / "a.pvtp";
    std::vector<std::string> names;
    std::size_t points = 0, triangles = 0;
    for (const std::size_t count : {0, 3, 0, 200}) {
        PolyData piece = example(count);
        piece.time = 0;  // VTK reads it in NAME.pvd only
        points += piece.points.size(), triangles += piece.ends.size();
        names.push_back(fmt::format("a-rank{}.vtp", names.size()));
        writePolyData(folder.path() / names.back(), piece);
    }
    writePieces(index, example(0), names);
    const PolyData read = readPolyData(index);
    EXPECT_EQ(read.points.size(), points);
    EXPECT_EQ(read.ends.size(), triangles);
    expectThatVtkReads(index, read);
}

}  // namespace
}  // namespace pendular::polyDataTest
