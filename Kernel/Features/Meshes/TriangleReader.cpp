#include "Kernel/Features/Meshes/TriangleReader.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include "Kernel/Features/Meshes/MeshFormats.h"
#include "Kernel/Foundation/Files/FileContent.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

bool isWord(std::string_view word, std::string_view expected) {
    if (word.size() != expected.size()) return false;
    for (std::size_t k = 0; k < word.size(); ++k)
        if ((word[k] >= 'A' && word[k] <= 'Z' ? word[k] + 32 : word[k]) != expected[k]) return false;
    return true;
}

std::vector<Triangle> readAscii(const InputFile& file, double scale) {
    Words words(file.text);
    std::vector<Triangle> triangles;
    const auto expect = [&](std::string_view expected) {
        const std::string_view word = words.next();
        if (isWord(word, expected)) return;
        file.refuse("line", words.line(),
                    word.empty() ? fmt::format("the file ends where '{}' is expected", expected)
                                 : fmt::format("'{}' where '{}' is expected", shown(word), expected));
    };
    const auto readVector = [&] {
        Vector<double> v;
        for (double* x : {&v.x, &v.y, &v.z})
            if (const std::string reason = parseLength(words.next(), scale, *x); !reason.empty())
                file.refuse("line", words.line(), reason);
        return v;
    };
    bool inSolid = false;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        if (isWord(word, inSolid ? "endsolid" : "solid")) {
            inSolid = !inSolid;
            words.skipLine();  // the name
            continue;
        }
        if (!inSolid || !isWord(word, "facet"))
            file.refuse("line", words.line(),
                        fmt::format("'{}' where '{}' is expected", shown(word),
                                    inSolid ? "facet' or 'endsolid" : "solid"));
        expect("normal");
        // The normal is not used: it follows from the vertices, and programs write zeros, nan or -1.#IND.
        const std::size_t line = words.line();
        for (int k = 0; k < 3; ++k)
            if (const std::string_view normal = words.next(); normal.empty() || isWord(normal, "outer"))
                file.refuse("line", line, "the facet's normal is not three numbers");
        expect("outer");
        expect("loop");
        Triangle triangle;
        for (Vector<double>& vertex : triangle) {
            expect("vertex");
            vertex = readVector();
        }
        expect("endloop");
        expect("endfacet");
        triangles.push_back(triangle);
    }
    if (inSolid) file.refuse("line", words.line(), "the file ends without 'endsolid'");
    return triangles;
}

template <class Number>
Number littleEndian(const char* bytes) {
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k)
        bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[k])) << (8 * k);
    return std::bit_cast<Number>(bits);
}

constexpr std::size_t binaryHeader = 84, binaryFacet = 50;  // bytes

std::vector<Triangle> readBinary(const InputFile& file, double scale) {
    if (file.text.size() < binaryHeader)
        file.refuse(fmt::format(
            "has {} bytes; a binary STL file has at least {}, and an ASCII one begins with 'solid'",
            file.text.size(), binaryHeader));
    const std::size_t count = littleEndian<std::uint32_t>(file.text.data() + 80);
    if (file.text.size() != binaryHeader + binaryFacet * count)
        file.refuse("offset", 80,
                    fmt::format("{} facets need {} bytes; the file has {}", count,
                                binaryHeader + binaryFacet * count, file.text.size()));
    std::vector<Triangle> triangles(count);
    for (std::size_t k = 0; k < count; ++k) {
        std::size_t offset = binaryHeader + binaryFacet * k + 12;  // after the normal
        for (Vector<double>& vertex : triangles[k])
            for (double* x : {&vertex.x, &vertex.y, &vertex.z}) {
                const float number = littleEndian<float>(file.text.data() + offset);
                *x = scale * static_cast<double>(number);
                if (!(std::abs(*x) <= largestLength))
                    file.refuse("offset", offset,
                                fmt::format("the coordinate {} of facet {} is not finite or above {:g} m",
                                            number, k, largestLength));
                offset += 4;
            }
    }
    return triangles;
}

std::vector<Triangle> readRows(const InputFile& file, double scale) {
    std::vector<Triangle> triangles;
    forEachRow(file, scale, [&](std::size_t line, const std::vector<double>& row) {
        if (row.size() < 9)
            file.refuse("line", line, fmt::format("{} numbers; a triangle has 9", row.size()));
        if (row.size() > 9) file.refuse("line", line, "more than the 9 numbers of a triangle");
        const auto vertex = [&](std::size_t k) { return Vector<double>{row[k], row[k + 1], row[k + 2]}; };
        triangles.push_back({vertex(0), vertex(3), vertex(6)});
    });
    return triangles;
}

/// A file without a mark of its kind has rows of numbers, or a binary STL file of a wrong length.
std::vector<Triangle> readUnmarked(InputFile& file, bool isNamedStl, double scale) {
    double number;
    const std::string_view first = Words(std::string_view(file.text).substr(0, 64)).next();
    const bool isText = file.text.find('\0') == file.text.npos;
    if (isNamedStl && isText && !parseNumber(first, number))
        file.refuse(
            fmt::format("has {} bytes of text; an ASCII STL file begins with 'solid'", file.text.size()));
    if (isNamedStl && !isText) return readBinary(file, scale);
    takeAsText(file);
    return readRows(file, scale);
}

/// @param ending of the file's name, which decides where the content does not
std::vector<Triangle> readByContent(InputFile& file, const std::string& ending, double scale) {
    switch (recognise(file.text).content) {
        case FileContent::BinaryStl:
            return readBinary(file, scale);
        case FileContent::AsciiStl:
            while (file.text.ends_with('\0') || file.text.ends_with('\x1a'))
                file.text.pop_back();                                                    // filled up
            if (file.text.find('\0') != file.text.npos) return readBinary(file, scale);  // of a wrong length
            takeAsText(file);
            return readAscii(file, scale);
        case FileContent::Obj:
            takeAsText(file);
            return trianglesOf(readObj(file, scale), file);
        case FileContent::Ply:
            return trianglesOf(readPly(file, scale), file);
        case FileContent::Unknown:
            if (isWord(ending, ".obj")) {
                takeAsText(file);
                return trianglesOf(readObj(file, scale), file);
            }
            return readUnmarked(file, isWord(ending, ".stl"), scale);
        default:
            refuseOtherContent(file);
            return {};
    }
}

}  // namespace

double checkedMeshScale(double scale) {
    checkValue("TriangleWall", "scale", scale, "m", positive);
    return scale;
}

std::vector<Triangle> readTriangles(const std::filesystem::path& path, double scale) {
    checkedMeshScale(scale);
    InputFile file = loadInputFile("triangle file", path);
    std::vector<Triangle> triangles = readByContent(file, path.extension().string(), scale);
    if (triangles.empty()) file.refuse("holds no triangles");
    return triangles;
}

}  // namespace pendular
