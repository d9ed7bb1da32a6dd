#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "Kernel/Features/Meshes/MeshFormats.h"

namespace pendular {

namespace {

struct Type {
    std::size_t size;  // bytes
    enum Kind { Signed, Unsigned, Floating } kind;
};

std::optional<Type> typeOf(std::string_view name) {
    static constexpr std::pair<std::string_view, Type> types[] = {
        {"char", {1, Type::Signed}},     {"int8", {1, Type::Signed}},      {"uchar", {1, Type::Unsigned}},
        {"uint8", {1, Type::Unsigned}},  {"short", {2, Type::Signed}},     {"int16", {2, Type::Signed}},
        {"ushort", {2, Type::Unsigned}}, {"uint16", {2, Type::Unsigned}},  {"int", {4, Type::Signed}},
        {"int32", {4, Type::Signed}},    {"uint", {4, Type::Unsigned}},    {"uint32", {4, Type::Unsigned}},
        {"float", {4, Type::Floating}},  {"float32", {4, Type::Floating}}, {"double", {8, Type::Floating}},
        {"float64", {8, Type::Floating}}};
    for (const auto& [known, type] : types)
        if (known == name) return type;
    return {};
}

struct Property {
    std::string_view name;
    Type type;
    std::optional<Type> count;  // of a list
};

struct Element {
    std::string_view name;
    std::uint64_t count;
    std::vector<Property> properties;
};

enum class Form { Ascii, LittleEndian, BigEndian };

struct Header {
    Form form = Form::Ascii;
    std::vector<Element> elements;
    std::size_t lines = 0, bytes = 0;
};

/// The lines of the header may end in any of the three ways; all end as the first one does.
class HeaderReader {
public:
    explicit HeaderReader(const InputFile& of) : file(of) {
        const std::size_t first = std::min(file.text.find_first_of("\r\n"), file.text.size());
        lineEnd = file.text.substr(first, 2) == "\r\n" ? "\r\n" : file.text.substr(first, 1);
    }

    Header read() {
        bool hasForm = false;
        for (std::string_view text = takeLine();; text = takeLine()) {
            Words words(text);
            const std::string_view word = words.next();
            if (word == "end_header") break;
            if (word == "format") hasForm = true, takeForm(words.next());
            else if (word == "element") takeElement(words);
            else if (word == "property") takeProperty(words);
            else if (header.lines > 1 && !word.empty() && word != "comment" && word != "obj_info")
                refuse(fmt::format("'{}' begins no line of the header", shown(word)));
        }
        if (!hasForm) refuse("the header has no line 'format'");
        return std::move(header);
    }

private:
    [[noreturn]] void refuse(std::string_view reason) const { file.refuse("line", header.lines, reason); }

    std::string_view takeLine() {
        ++header.lines;
        const std::string_view rest = std::string_view(file.text).substr(header.bytes);
        const std::size_t end = lineEnd.empty() ? rest.npos : rest.find(lineEnd);
        if (end == rest.npos) refuse("the file ends within its header, without 'end_header'");
        header.bytes += end + lineEnd.size();
        return rest.substr(0, end);
    }
    void takeForm(std::string_view name) {
        if (name == "ascii") header.form = Form::Ascii;
        else if (name == "binary_little_endian") header.form = Form::LittleEndian;
        else if (name == "binary_big_endian") header.form = Form::BigEndian;
        else
            refuse(
                fmt::format("the format is '{}'; it must be ascii, binary_little_endian or binary_big_endian",
                            shown(name)));
    }
    void takeElement(Words& words) {
        Element element{words.next(), 0, {}};
        const std::string_view count = words.next();
        const auto [end, problem] = std::from_chars(count.data(), count.data() + count.size(), element.count);
        if (element.name.empty() || count.empty() || problem != std::errc{} ||
            end != count.data() + count.size())
            refuse("an element needs a name and how many there are");
        header.elements.push_back(std::move(element));
    }
    void takeProperty(Words& words) {
        if (header.elements.empty()) refuse("a property is before all elements");
        std::string_view type = words.next();
        std::optional<Type> count;
        if (type == "list") {
            count = typeOf(words.next());
            if (!count || count->kind == Type::Floating)
                refuse("a list is counted by a type of whole numbers");
            type = words.next();
        }
        const std::optional<Type> known = typeOf(type);
        if (!known) refuse(fmt::format("there is no type '{}'", shown(type)));
        const std::string_view name = words.next();
        if (name.empty()) refuse("a property has no name");
        header.elements.back().properties.push_back({name, *known, count});
    }

    const InputFile& file;
    std::string lineEnd;
    Header header;
};

/// The numbers of an ASCII file, one after the other.
class AsciiNumbers {
public:
    AsciiNumbers(const InputFile& of, const Header& header)
        : file(of), words(std::string_view(of.text).substr(header.bytes)), before(header.lines) {}

    void skip(const Type&) { next(); }
    std::int64_t whole(const Type&) {
        const std::string_view word = next();
        std::int64_t number = 0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (problem != std::errc{} || end != word.data() + word.size())
            refuse(fmt::format("'{}' is not a whole number", shown(word)));
        return number;
    }
    double length(const Type&, double scale) {
        double value = 0;
        if (const std::string reason = parseLength(next(), scale, value); !reason.empty()) refuse(reason);
        return value;
    }
    [[nodiscard]] std::size_t place() const { return before + words.line(); }
    [[noreturn]] void refuse(std::string_view reason) const { file.refuse("line", place(), reason); }

private:
    std::string_view next() {
        const std::string_view word = words.next();
        if (word.empty()) refuse("the file ends where a number is expected");
        return word;
    }

    const InputFile& file;
    Words words;
    std::size_t before;  // lines
};

class BinaryNumbers {
public:
    BinaryNumbers(const InputFile& of, const Header& header)
        : file(of), at(header.bytes), isBig(header.form == Form::BigEndian) {}

    void skip(const Type& type) { bits(type.size); }
    std::int64_t whole(const Type& type) {
        const std::uint64_t value = bits(type.size);
        const std::uint64_t sign = std::uint64_t{1} << (8 * type.size - 1);
        if (type.kind == Type::Signed && (value & sign))
            return static_cast<std::int64_t>(value) - static_cast<std::int64_t>(sign) * 2;
        return static_cast<std::int64_t>(value);
    }
    double length(const Type& type, double scale) {
        const std::size_t from = at;
        const double number =
            type.kind != Type::Floating ? static_cast<double>(whole(type))
            : type.size == 4 ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits(4))))
                             : std::bit_cast<double>(bits(8));
        if (!(std::abs(number * scale) <= largestLength))
            file.refuse(
                "offset", from,
                fmt::format("the coordinate {} is not finite or above {:g} m", number, largestLength));
        return number * scale;
    }
    [[nodiscard]] std::size_t place() const { return at; }
    [[noreturn]] void refuse(std::string_view reason) const { file.refuse("offset", at, reason); }

private:
    std::uint64_t bits(std::size_t size) {
        if (file.text.size() - at < size) refuse("the file ends too early");
        std::uint64_t value = 0;
        for (std::size_t k = 0; k < size; ++k) {
            const auto byte = static_cast<unsigned char>(file.text[at + k]);
            value |= std::uint64_t{byte} << (8 * (isBig ? size - 1 - k : k));
        }
        at += size;
        return value;
    }

    const InputFile& file;
    std::size_t at;  // byte
    bool isBig;
};

template <class Numbers>
class BodyReader {
public:
    BodyReader(Numbers source, double scaleOf) : numbers(source), scale(scaleOf) {}

    PolygonMesh read(const std::vector<Element>& elements) {
        for (const Element& element : elements) {
            if (element.properties.empty()) continue;
            for (std::uint64_t k = 0; k < element.count; ++k) {
                if (element.name == "vertex") takeVertex(element);
                else if (element.name == "face") takeFace(element);
                else
                    for (const Property& property : element.properties) skip(property);
            }
        }
        return std::move(mesh);
    }

private:
    void skip(const Property& property) {
        const std::int64_t count = property.count ? countOf(property) : 1;
        for (std::int64_t k = 0; k < count; ++k) numbers.skip(property.type);
    }
    std::int64_t countOf(const Property& property) {
        const std::int64_t count = numbers.whole(*property.count);
        if (count < 0) numbers.refuse(fmt::format("a list has {} numbers", count));
        return count;
    }
    void takeVertex(const Element& element) {
        Vector<double>& v = mesh.vertices.emplace_back(Vector<double>{0, 0, 0});
        for (const Property& property : element.properties) {
            double* const x = property.name == "x"   ? &v.x
                              : property.name == "y" ? &v.y
                              : property.name == "z" ? &v.z
                                                     : nullptr;
            if (x && !property.count) *x = numbers.length(property.type, scale);
            else skip(property);
        }
    }
    void takeFace(const Element& element) {
        std::size_t place = 0;
        for (const Property& property : element.properties) {
            if (!property.count || (property.name != "vertex_indices" && property.name != "vertex_index")) {
                skip(property);
                continue;
            }
            const std::int64_t count = countOf(property);
            place = numbers.place();
            for (std::int64_t k = 0; k < count; ++k) mesh.corners.push_back(numbers.whole(property.type));
        }
        mesh.endFace(place);
    }

    Numbers numbers;
    double scale;  // m
    PolygonMesh mesh;
};

/// Whether an element of this name has a property of one of these names, which is a list or not.
bool has(const Header& header, std::string_view element, std::initializer_list<std::string_view> names,
         bool isList) {
    for (const Element& e : header.elements)
        for (const Property& p : e.properties)
            if (e.name == element && p.count.has_value() == isList &&
                std::find(names.begin(), names.end(), p.name) != names.end())
                return true;
    return false;
}

void refuseUnlessMesh(const InputFile& file, const Header& header) {
    for (const std::string_view axis : {"x", "y", "z"})
        if (!has(header, "vertex", {axis}, false))
            file.refuse(fmt::format("has no property {} of an element 'vertex' in its header", axis));
    if (!has(header, "face", {"vertex_indices", "vertex_index"}, true))
        file.refuse(
            has(header, "tristrips", {"vertex_indices", "vertex_index"}, true)
                ? "has strips of triangles, which are not read; save it with faces"
                : "has no element 'face' with a list vertex_indices in its header; if it is a cloud of "
                  "points, make a mesh of it first");
}

}  // namespace

PolygonMesh readPly(InputFile& file, double scale) {
    Header header = HeaderReader(file).read();
    refuseUnlessMesh(file, header);
    if (header.form != Form::Ascii) {
        PolygonMesh mesh = BodyReader(BinaryNumbers(file, header), scale).read(header.elements);
        mesh.placeIs = "offset";
        return mesh;
    }
    takeAsText(file);
    header = HeaderReader(file).read();
    return BodyReader(AsciiNumbers(file, header), scale).read(header.elements);
}

}  // namespace pendular
