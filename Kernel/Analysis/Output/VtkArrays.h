#pragma once

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Analysis/Output/Compression.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Foundation/Files/Deflate.h"
#include "Kernel/Foundation/Files/TextFile.h"

/// What the readers of VTK's XML files share: they read what VtkDocument writes, and no other form. All throw
/// std::runtime_error with what is wrong with a file ("ends too early").
namespace pendular::vtk {

/// A tag of XML, without its brackets.
struct Tag {
    std::string_view name;
    std::map<std::string_view, std::string_view> attributes;
    std::string_view behind;  // the text up to the next tag
};

/// The value of an attribute; empty where there is none.
inline std::string_view valueOf(const Tag& tag, std::string_view attribute) {
    const auto found = tag.attributes.find(attribute);
    return found == tag.attributes.end() ? std::string_view{} : found->second;
}

inline Tag parseTag(std::string_view text) {
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

inline std::vector<Tag> parseTags(std::string_view xml) {
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

inline constexpr std::size_t largestCount = 1e12;

inline std::size_t countIn(const Tag& tag, std::string_view attribute) {
    const std::string_view word = valueOf(tag, attribute);
    std::size_t count = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (problem != std::errc{} || end != word.data() + word.size() || word.empty() || count > largestCount)
        throw std::runtime_error(fmt::format("has {} = '{}', which is no count", attribute, shown(word)));
    return count;
}

/// The XML of a file, and the arrays behind it.
class Arrays {
public:
    /// @param text of the file, which must outlive this
    explicit Arrays(std::string_view text) {
        constexpr std::string_view mark = "<AppendedData encoding=\"raw\">";
        const std::size_t behind = text.find(mark);
        const std::size_t data = behind == text.npos ? behind : text.find('_', behind + mark.size());
        if (data == text.npos) throw std::runtime_error("is no VTK file with raw appended data");
        appended = text.substr(data + 1);
        tags = parseTags(text.substr(0, behind));
    }

    std::vector<Tag> tags;

    /// Throws unless a tag VTKFile is of this type, and of the form that is read.
    static void checkForm(const Tag& tag, std::string_view fileType) {
        const bool little = std::endian::native == std::endian::little;
        for (const auto& [attribute, value] :
             {std::pair<std::string_view, std::string_view>{"type", fileType},
              {"byte_order", little ? "LittleEndian" : "BigEndian"},
              {"header_type", "UInt64"},
              {"compressor", "vtkZLibDataCompressor"}})
            if (valueOf(tag, attribute) != value)
                throw std::runtime_error(fmt::format("has {} = '{}'; only '{}' is read", attribute,
                                                     shown(valueOf(tag, attribute)), value));
    }
    /// @param count of points or cells
    [[nodiscard]] PolyDataField field(const Tag& tag, std::size_t count) {
        PolyDataField read = nameOf(tag);
        const std::string_view type = valueOf(tag, "type");
        const std::size_t size = count * read.components;
        if (type == "Float32") read.numbers = numbers<float>(tag, size);
        else if (type == "Float64") read.numbers = numbers<double>(tag, size);
        else if (type == "Int32") read.numbers = numbers<std::int32_t>(tag, size);
        else throw std::runtime_error(fmt::format("has the type '{}' in '{}'", shown(type), read.name));
        return read;
    }
    /// Its name and components alone.
    static PolyDataField nameOf(const Tag& tag) {
        PolyDataField named{std::string(valueOf(tag, "Name")), countIn(tag, "NumberOfComponents"), {}};
        if (named.components < 1 || named.components > 9)
            throw std::runtime_error(fmt::format("has {} components in '{}'", named.components, named.name));
        return named;
    }
    template <class Number>
    [[nodiscard]] std::vector<Number> numbers(const Tag& tag, std::size_t count) {
        const std::size_t offset = countIn(tag, "offset");
        unpacked += count * sizeof(Number);  // no two arrays share their bytes
        if (offset > appended.size()) throw std::runtime_error("ends too early");
        requireRoom(unpacked);
        const std::string bytes = decompressBlocks(appended.substr(offset), count * sizeof(Number));
        std::vector<Number> read(count);
        if (count > 0) std::memcpy(read.data(), bytes.data(), bytes.size());
        return read;
    }

    /// Throws unless the file can have so many bytes of numbers.
    void requireRoom(std::size_t bytes) const {
        if (bytes / largestDeflateRatio > appended.size()) throw std::runtime_error("ends too early");
    }

private:
    std::string_view appended;
    std::size_t unpacked = 0;  // bytes, of all arrays so far
};

/// The numbers of a text with blanks between them. @param name of the field, for a message
inline std::vector<double> wordsOf(std::string_view name, std::string_view text) {
    std::vector<double> numbers;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        double number = 0;
        if (!parseNumber(text.substr(0, end), number))
            throw std::runtime_error(fmt::format("has a field '{}' that is no row of numbers", shown(name)));
        numbers.push_back(number);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return numbers;
}

/// The time (s) of a file's tag TimeValue.
inline double timeOf(const Tag& tag) {
    double time = 0;
    if (!parseNumber(tag.behind, time)) throw std::runtime_error("has a TimeValue that is no number");
    return time;
}

}  // namespace pendular::vtk
