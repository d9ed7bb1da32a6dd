#include "Kernel/Walls/TriangleReader.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "Kernel/InputError.h"
#include "Kernel/Species/Field.h"

namespace pendular {

namespace {

constexpr std::uintmax_t largestFile = std::uintmax_t{1} << 32;  // bytes
constexpr double largestCoordinate = 1e9;                        // m

struct File {
    std::string name;
    std::string text;
    double scale;

    template <class Place>
    [[noreturn]] void refuse(std::string_view place, Place where, std::string_view reason) const {
        throw InputError(fmt::format("The triangle file {}, {} {}: {}.", name, place, where, reason));
    }
    [[noreturn]] void refuse(std::string_view reason) const {
        throw InputError(fmt::format("The triangle file {} {}.", name, reason));
    }
};

File load(const std::filesystem::path& path, double scale) {
    File file{path.string(), {}, scale};
    std::error_code problem;
    if (!std::filesystem::exists(path, problem)) file.refuse("does not exist");
    if (!std::filesystem::is_regular_file(path, problem)) file.refuse("is not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(path, problem);
    if (problem) file.refuse("cannot be read");
    if (size > largestFile) file.refuse("is larger than 4 GiB");
    std::ifstream stream(path, std::ios::binary);
    file.text.resize(size);
    if (!stream.read(file.text.data(), static_cast<std::streamsize>(size))) file.refuse("cannot be read");
    return file;
}

/// Takes the words of a text one by one and counts its lines.
class Words {
public:
    explicit Words(std::string_view source) : text(source) {}

    /// The next word; empty at the end.
    std::string_view next() {
        skipSpace();
        const std::size_t begin = at;
        while (at < text.size() && !isSpace(text[at])) ++at;
        return text.substr(begin, at - begin);
    }
    void skipLine() {
        while (at < text.size() && text[at] != '\n') ++at;
    }
    [[nodiscard]] std::size_t line() const { return lineNumber; }

    static bool isSpace(char c) {
        return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
    }

private:
    void skipSpace() {
        for (; at < text.size() && isSpace(text[at]); ++at)
            if (text[at] == '\n') ++lineNumber;
    }

    std::string_view text;
    std::size_t at = 0;
    std::size_t lineNumber = 1;
};

/// A word in a message: short, and printable whatever the file holds.
std::string shown(std::string_view word) {
    std::string result;
    for (const char c : word.substr(0, 24)) result += c > ' ' && c < 127 ? c : '?';
    return result;
}

bool parse(std::string_view word, double& value) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    return problem == std::errc{} && end == word.data() + word.size();
}

/// A coordinate in m; empty, or why it is refused.
std::string toCoordinate(std::string_view word, double scale, double& value) {
    if (word.empty()) return "the file ends where a number is expected";
    if (!parse(word, value)) return fmt::format("'{}' is not a number", shown(word));
    value *= scale;
    if (!(std::abs(value) <= largestCoordinate))
        return fmt::format("the coordinate {} is not finite or above {:g} m", shown(word), largestCoordinate);
    return {};
}

bool isWord(std::string_view word, std::string_view expected) {
    if (word.size() != expected.size()) return false;
    for (std::size_t k = 0; k < word.size(); ++k)
        if ((word[k] >= 'A' && word[k] <= 'Z' ? word[k] + 32 : word[k]) != expected[k]) return false;
    return true;
}

std::vector<Triangle> readAscii(const File& file) {
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
            if (const std::string reason = toCoordinate(words.next(), file.scale, *x); !reason.empty())
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
        for (int k = 0; k < 3;
             ++k) {  // not used: it follows from the vertices, and many programs write zeros or nan
            double ignored;
            if (!parse(words.next(), ignored))
                file.refuse("line", words.line(), "the facet's normal is not three numbers");
        }
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

/// A binary file may begin with "solid" as well; its length tells.
bool looksBinary(const std::string& text) {
    if (text.size() >= binaryHeader &&
        text.size() ==
            binaryHeader + binaryFacet * std::size_t{littleEndian<std::uint32_t>(text.data() + 80)})
        return true;
    std::size_t begin = 0;
    while (begin < text.size() && Words::isSpace(text[begin])) ++begin;
    return !isWord(std::string_view(text).substr(begin, 5), "solid");
}

std::vector<Triangle> readBinary(const File& file) {
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
                *x = file.scale * static_cast<double>(number);
                if (!(std::abs(*x) <= largestCoordinate))
                    file.refuse("offset", offset,
                                fmt::format("the coordinate {} of facet {} is not finite or above {:g} m",
                                            number, k, largestCoordinate));
                offset += 4;
            }
    }
    return triangles;
}

std::vector<Triangle> readRows(const File& file) {
    std::vector<Triangle> triangles;
    std::string_view rest = file.text;
    bool mayBeHeader = true;
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        Words words(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        std::string_view word = words.next();
        if (word.empty() || word.front() == '#') continue;
        double number;
        const bool isHeader = mayBeHeader && !parse(word, number);
        mayBeHeader = false;
        if (isHeader) continue;
        Triangle triangle;
        int count = 0;
        for (Vector<double>& vertex : triangle)
            for (double* x : {&vertex.x, &vertex.y, &vertex.z}) {
                if (word.empty())
                    file.refuse("line", line, fmt::format("{} numbers; a triangle has 9", count));
                if (const std::string reason = toCoordinate(word, file.scale, *x); !reason.empty())
                    file.refuse("line", line, reason);
                word = words.next();
                ++count;
            }
        if (!word.empty()) file.refuse("line", line, "more than the 9 numbers of a triangle");
        triangles.push_back(triangle);
    }
    return triangles;
}

}  // namespace

std::vector<Triangle> readTriangles(const std::filesystem::path& path, double scale) {
    checkValue("TriangleWall", "scale", scale, "m", positive);
    const File file = load(path, scale);
    const bool isStl = isWord(path.extension().string(), ".stl");
    std::vector<Triangle> triangles = !isStl                   ? readRows(file)
                                      : looksBinary(file.text) ? readBinary(file)
                                                               : readAscii(file);
    if (triangles.empty()) file.refuse("holds no triangles");
    return triangles;
}

}  // namespace pendular
