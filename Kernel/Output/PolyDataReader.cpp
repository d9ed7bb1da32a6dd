#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include "Kernel/Base/InputError.h"
#include "Kernel/Files/FileContent.h"
#include "Kernel/Files/TextFile.h"
#include "Kernel/Output/Compression.h"
#include "Kernel/Output/JoinPieces.h"
#include "Kernel/Output/PolyData.h"
#include "Kernel/Output/XmlText.h"

namespace pendular {

namespace {

/// A tag of XML, without its brackets.
struct Tag {
    std::string_view name;
    std::map<std::string_view, std::string_view> attributes;
    std::string_view behind;  // the text up to the next tag
};

/// The value of an attribute; empty where there is none.
std::string_view valueOf(const Tag& tag, std::string_view attribute) {
    const auto found = tag.attributes.find(attribute);
    return found == tag.attributes.end() ? std::string_view{} : found->second;
}

Tag parseTag(std::string_view text) {
    Tag tag;
    const std::size_t end = text.find_first_of(" \n/", 1);
    tag.name = text.substr(0, end);
    for (std::size_t at = text.find('=', tag.name.size()); at != text.npos; at = text.find('=', at)) {
        const std::size_t name = text.find_last_of(" \n", at) + 1;
        const std::size_t close = at + 2 < text.size() ? text.find('"', at + 2) : text.npos;
        if (close == text.npos || text[at + 1] != '"')
            throw std::runtime_error("has an attribute without quotes");
        tag.attributes[text.substr(name, at - name)] = text.substr(at + 2, close - at - 2);
        at = close;
    }
    return tag;
}

std::vector<Tag> parseTags(std::string_view xml) {
    std::vector<Tag> tags;
    for (std::size_t open = xml.find('<'); open != xml.npos;) {
        const std::size_t close = xml.find('>', open);
        if (close == xml.npos) throw std::runtime_error("has a tag without end");
        tags.push_back(parseTag(xml.substr(open + 1, close - open - 1)));
        open = xml.find('<', close);
        tags.back().behind = xml.substr(close + 1, open == xml.npos ? xml.npos : open - close - 1);
    }
    return tags;
}

constexpr std::size_t largestCount = 1e12;

std::size_t countIn(const Tag& tag, std::string_view attribute) {
    const std::string_view word = valueOf(tag, attribute);
    std::size_t count = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (problem != std::errc{} || end != word.data() + word.size() || word.empty() || count > largestCount)
        throw std::runtime_error(fmt::format("has {} = '{}', which is no count", attribute, shown(word)));
    return count;
}

/// The arrays of a file, taken tag by tag.
class Reader {
public:
    explicit Reader(std::string_view text) {
        constexpr std::string_view mark = "<AppendedData encoding=\"raw\">";
        const std::size_t behind = text.find(mark);
        const std::size_t data = behind == text.npos ? behind : text.find('_', behind + mark.size());
        if (data == text.npos) throw std::runtime_error("is no .vtp file with raw appended data");
        appended = text.substr(data + 1);
        for (const Tag& tag : parseTags(text.substr(0, behind))) take(tag);
        requireWhole();
    }

    PolyData result;

private:
    void take(const Tag& tag) {
        if (tag.name == "VTKFile") checkForm(tag);
        else if (tag.name == "Piece") takeCounts(tag);
        else if (tag.name == "DataArray") takeArray(tag);
        else if (tag.name != "/DataArray") section = tag.name;
    }
    /// Refuses a file that has not as many points, cells and values as it says, in whatever order it says it.
    void requireWhole() const {
        const auto fit = [](const std::vector<PolyDataField>& fields, std::size_t count) {
            return std::all_of(fields.begin(), fields.end(), [&](const PolyDataField& field) {
                return field.size() == count * field.components;
            });
        };
        const std::size_t there = result.points.size();
        if (there != points || result.ends.size() != cells || !fit(result.pointFields, there) ||
            !fit(result.cellFields, cells) ||
            std::any_of(result.corners.begin(), result.corners.end(),
                        [&](std::int32_t corner) { return static_cast<std::size_t>(corner) >= there; }))
            throw std::runtime_error("has arrays of the wrong size");
    }
    void checkForm(const Tag& tag) const {
        const bool little = std::endian::native == std::endian::little;
        for (const auto& [attribute, value] : {std::pair{"type", "PolyData"},
                                               {"byte_order", little ? "LittleEndian" : "BigEndian"},
                                               {"header_type", "UInt64"},
                                               {"compressor", "vtkZLibDataCompressor"}})
            if (valueOf(tag, attribute) != value)
                throw std::runtime_error(fmt::format("has {} = '{}'; only '{}' is read", attribute,
                                                     shown(valueOf(tag, attribute)), value));
    }
    void takeCounts(const Tag& tag) {
        points = countIn(tag, "NumberOfPoints");
        constexpr const char* names[] = {"NumberOfVerts", "NumberOfLines", "NumberOfPolys"};
        for (int kind = 0; kind < 3; ++kind)
            if (const std::size_t count = countIn(tag, names[kind])) {
                cells = count;
                result.kind = static_cast<PolyData::Cells>(kind);
            }
    }
    void takeArray(const Tag& tag) {
        const std::string_view name = valueOf(tag, "Name");
        if (section == "FieldData") {
            if (name != "TimeValue") takeWhole(name, tag.behind);
            else if (!parseNumber(tag.behind, result.time))
                throw std::runtime_error("has a TimeValue that is no number");
        } else if (section == "PointData") {
            result.pointFields.push_back(field(tag, points));
        } else if (section == "CellData") {
            result.cellFields.push_back(field(tag, cells));
        } else if (section == "Points") {
            const PolyDataField read = field(tag, points);
            if (read.components != 3) throw std::runtime_error("has points without three coordinates");
            for (std::size_t k = 0; k < points; ++k)
                result.points.push_back({read.at(3 * k), read.at(3 * k + 1), read.at(3 * k + 2)});
        } else if (section == "Verts" || section == "Lines" || section == "Polys") {
            if (cells > 0 && name == "connectivity") connectivity = tag;
            if (cells > 0 && name == "offsets") takeCells(tag);
        }
    }
    void takeWhole(std::string_view name, std::string_view text) {
        std::vector<double> numbers;
        while (!text.empty()) {
            const std::size_t end = std::min(text.find(' '), text.size());
            double number = 0;
            if (!parseNumber(text.substr(0, end), number))
                throw std::runtime_error(
                    fmt::format("has a field '{}' that is no row of numbers", shown(name)));
            numbers.push_back(number);
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        result.wholeFields.push_back({std::string(name), 1, std::move(numbers)});
    }
    void takeCells(const Tag& offsets) {
        result.ends = numbers<std::int32_t>(offsets, cells);
        std::int32_t last = 0;
        for (const std::int32_t end : result.ends)
            if (end < std::exchange(last, end)) throw std::runtime_error("has cells with falling offsets");
        result.corners = numbers<std::int32_t>(connectivity, static_cast<std::size_t>(last));
        for (const std::int32_t corner : result.corners)
            if (corner < 0 || static_cast<std::size_t>(corner) >= points)
                throw std::runtime_error("has a cell with a corner that is no point");
    }

    [[nodiscard]] PolyDataField field(const Tag& tag, std::size_t count) {
        PolyDataField read{std::string(valueOf(tag, "Name")), countIn(tag, "NumberOfComponents"), {}};
        if (read.components < 1 || read.components > 9)
            throw std::runtime_error(fmt::format("has {} components in '{}'", read.components, read.name));
        const std::string_view type = valueOf(tag, "type");
        const std::size_t size = count * read.components;
        if (type == "Float32") read.numbers = numbers<float>(tag, size);
        else if (type == "Float64") read.numbers = numbers<double>(tag, size);
        else if (type == "Int32") read.numbers = numbers<std::int32_t>(tag, size);
        else throw std::runtime_error(fmt::format("has the type '{}' in '{}'", shown(type), read.name));
        return read;
    }
    template <class Number>
    [[nodiscard]] std::vector<Number> numbers(const Tag& tag, std::size_t count) {
        const std::size_t offset = countIn(tag, "offset");
        // Deflate packs 1032 bytes into one at most, and no two arrays share their bytes.
        unpacked += count * sizeof(Number);
        if (offset > appended.size() || unpacked / 1032 > appended.size())
            throw std::runtime_error("ends too early");
        const std::string bytes = decompressBlocks(appended.substr(offset), count * sizeof(Number));
        std::vector<Number> read(count);
        if (count > 0) std::memcpy(read.data(), bytes.data(), bytes.size());
        return read;
    }

    std::string_view appended;
    std::string_view section;
    std::size_t points = 0, cells = 0;
    std::size_t unpacked = 0;  // bytes, of all arrays so far
    Tag connectivity;
};

/// The files beside a .pvtp file that it names.
std::vector<std::string> pieceNames(std::string_view text) {
    std::vector<std::string> names;
    for (const Tag& tag : parseTags(text)) {
        if (tag.name != "Piece") continue;
        names.push_back(unescaped(std::string(valueOf(tag, "Source"))));
        if (!names.back().ends_with(".vtp") || names.back().find('/') != std::string::npos)
            throw std::runtime_error(
                fmt::format("has a piece '{}', which is no .vtp file beside it", shown(names.back())));
    }
    if (names.empty()) throw std::runtime_error("has no pieces");
    return names;
}

}  // namespace

PolyData readPolyData(const std::filesystem::path& path) {
    const InputFile file = loadInputFile("VTK file", path);
    if (recognise(file.text).content == FileContent::NoText) refuseOtherContent(file);
    try {
        if (path.extension() != ".pvtp") return std::move(Reader(file.text).result);
        std::vector<PolyData> pieces;
        for (const std::string& name : pieceNames(file.text))
            pieces.push_back(readPolyData(path.parent_path() / name));
        return joined(std::move(pieces));
    } catch (const InputError&) {
        throw;  // of a piece
    } catch (const std::runtime_error& problem) {
        file.refuse(problem.what());
    }
}

}  // namespace pendular
