#include "Kernel/Foundation/Files/FileContent.h"

#include <algorithm>
#include <cstdint>

namespace pendular {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view unpack = "unpack it first", saveAsUtf8 = "save it as UTF-8 (plain text)",
                           saveAsMesh = "save the shape as STL, OBJ or PLY",
                           saveAsText = "save what is in it as plain text";

struct Signature {
    std::string_view bytes;
    RecognisedContent meaning;
};

/// Where formats begin with the same bytes, the longer ones come first.
constexpr Signature signatures[] = {
    {"\x1F\x8B"sv, {FileContent::NoText, "a gzip archive", unpack}},
    {"PK\x03\x04"sv,
     {FileContent::NoText, "a ZIP archive, as 3MF files and spreadsheets are", "export it as text or STL"}},
    {"PK\x05\x06"sv, {FileContent::NoText, "an empty ZIP archive", {}}},
    {"7z\xBC\xAF\x27\x1C"sv, {FileContent::NoText, "a 7z archive", unpack}},
    {"BZh"sv, {FileContent::NoText, "a bzip2 archive", unpack}},
    {"\xFD\x37zXZ\0"sv, {FileContent::NoText, "an xz archive", unpack}},
    {"\x28\xB5\x2F\xFD"sv, {FileContent::NoText, "a zstd archive", unpack}},
    {"Rar!\x1A\x07"sv, {FileContent::NoText, "a RAR archive", unpack}},
    {"\x89PNG\r\n\x1A\n"sv, {FileContent::NoText, "a PNG picture", {}}},
    {"\xFF\xD8\xFF"sv, {FileContent::NoText, "a JPEG picture", {}}},
    {"GIF8"sv, {FileContent::NoText, "a GIF picture", {}}},
    {"II*\0"sv, {FileContent::NoText, "a TIFF picture", {}}},
    {"MM\0*"sv, {FileContent::NoText, "a TIFF picture", {}}},
    {"%PDF-"sv, {FileContent::NoText, "a PDF document", {}}},
    {"\x89HDF\r\n\x1A\n"sv, {FileContent::NoText, "an HDF5 file", {}}},
    {"CDF\x01"sv, {FileContent::NoText, "a NetCDF file", {}}},
    {"CDF\x02"sv, {FileContent::NoText, "a NetCDF file", {}}},
    {"\x93NUMPY"sv, {FileContent::NoText, "an array of NumPy", saveAsText}},
    {"\x7F"
     "ELF"sv,
     {FileContent::NoText, "a program", {}}},
    {"SQLite format 3\0"sv, {FileContent::NoText, "an SQLite database", {}}},
    {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv,
     {FileContent::NoText, "a document of an older Office program", saveAsText}},
    {"glTF"sv, {FileContent::NoText, "a glTF file", saveAsMesh}},
    {"BLENDER"sv, {FileContent::NoText, "a Blender file", saveAsMesh}},
    {"Kaydara FBX Binary"sv, {FileContent::NoText, "an FBX file", saveAsMesh}},
    {"\xFF\xFE\0\0"sv, {FileContent::NoText, "UTF-32 text", saveAsUtf8}},
    {"\0\0\xFE\xFF"sv, {FileContent::NoText, "UTF-32 text", saveAsUtf8}},
    {"\xFF\xFE"sv, {FileContent::NoText, "UTF-16 text", saveAsUtf8}},
    {"\xFE\xFF"sv, {FileContent::NoText, "UTF-16 text", saveAsUtf8}},
    {"ISO-10303-21;"sv, {FileContent::OtherText, "a STEP file", saveAsMesh}},
    {"# vtk DataFile"sv, {FileContent::OtherText, "a legacy VTK file", {}}},
    {"$MeshFormat"sv, {FileContent::OtherText, "a Gmsh mesh", saveAsMesh}},
    {"{\\rtf"sv, {FileContent::OtherText, "an RTF document", saveAsText}},
    {"version https://git-lfs"sv,
     {FileContent::OtherText, "a pointer of Git LFS, and not the file itself", "fetch it by 'git lfs pull'"}},
};

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; }

/// Whether a text begins with a word in lower case, whatever the case of the text.
bool begins(std::string_view text, std::string_view word) {
    return text.size() >= word.size() &&
           std::equal(word.begin(), word.end(), text.begin(), [](char w, char t) { return w == lower(t); });
}

constexpr std::string_view blanksOfLine = " \t\v\f", lineEnds = "\r\n";

bool isOneOf(char c, std::string_view set) { return set.find(c) != set.npos; }

/// A word is followed by a blank, the end of its line, or the end of the file.
bool beginsWithWord(std::string_view text, std::string_view word) {
    return begins(text, word) && (text.size() == word.size() || isOneOf(text[word.size()], " \t\v\f\r\n"));
}

std::string_view withoutBlanks(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(blanksOfLine), text.size()));
    return text;
}

bool looksLikeNumber(std::string_view word) {
    word.remove_prefix(std::min(word.find_first_not_of("+-."), word.size()));
    return !word.empty() && word.front() >= '0' && word.front() <= '9';
}

/// Calls a function with the first lines of a text, without blanks at the beginning, that are not empty,
/// until it returns true.
template <class Function>
void forFirstLines(std::string_view text, Function&& function) {
    constexpr std::size_t farthest = 1 << 16;  // bytes
    text = text.substr(0, farthest);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of(lineEnds), text.size());
        const std::string_view line = withoutBlanks(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!line.empty() && function(line)) return;
    }
}

/// An OBJ file has a vertex, and nothing before it but comments and statements of its own.
bool isObj(std::string_view text) {
    bool found = false;
    forFirstLines(text, [&](std::string_view line) {
        if (line.front() == '#') return false;
        if (beginsWithWord(line, "v")) {
            found = looksLikeNumber(withoutBlanks(line.substr(1)));
            return true;
        }
        for (const std::string_view word : {"vn", "vt", "vp", "g", "o", "s", "usemtl", "mtllib"})
            if (beginsWithWord(line, word)) return false;
        return true;
    });
    return found;
}

/// The header of a LAMMPS data file has a line "N atoms" after its first line, which is a comment.
bool isLammpsData(std::string_view text) {
    bool found = false;
    int lines = 0;
    forFirstLines(text, [&](std::string_view line) {
        if (!looksLikeNumber(line)) return ++lines > 20;
        const std::size_t end = line.find_first_not_of("0123456789");
        if (end == line.npos) return true;
        found = beginsWithWord(withoutBlanks(line.substr(end)), "atoms");
        return found || ++lines > 20;
    });
    return found;
}

RecognisedContent recogniseText(std::string_view text) {
    const std::string_view start = text.substr(std::min(text.find_first_not_of(" \t\v\f\r\n"), text.size()));
    if (begins(start, "<!doctype html") || begins(start, "<html"))
        return {FileContent::OtherText, "an HTML page", "download the file itself"};
    if (begins(start, "<?xml") || begins(start, "<vtkfile"))
        return {FileContent::OtherText, "an XML file", {}};
    if (beginsWithWord(text, "ply")) return {FileContent::Ply, "a PLY mesh", {}};
    if (beginsWithWord(start, "off")) return {FileContent::OtherText, "an OFF mesh", saveAsMesh};
    if (beginsWithWord(start, "solid")) return {FileContent::AsciiStl, "an STL mesh", {}};
    if (start.starts_with("ITEM:")) return {FileContent::LammpsDump, "a dump of LAMMPS or LIGGGHTS", {}};
    if (isObj(text)) return {FileContent::Obj, "an OBJ mesh", {}};
    if (isLammpsData(text)) return {FileContent::LammpsData, "a LAMMPS data file", {}};
    return {};
}

constexpr std::size_t binaryStlHeader = 84, binaryStlFacet = 50;  // bytes

/// The number of facets must agree with the length: the header may be anything, also "solid".
bool isBinaryStl(std::string_view bytes) {
    if (bytes.size() < binaryStlHeader) return false;
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < 4; ++k)
        count |= std::uint64_t{static_cast<unsigned char>(bytes[80 + k])} << (8 * k);
    return bytes.size() == binaryStlHeader + binaryStlFacet * count;
}

/// Characters of ASCII as UTF-16 without a mark: every second byte is zero.
bool isUnmarkedUtf16(std::string_view bytes) {
    constexpr std::size_t seen = 8;
    if (bytes.size() < seen) return false;
    const auto everySecondIsZero = [&](std::size_t from) {
        for (std::size_t k = 0; k < seen; ++k)
            if ((bytes[k] == 0) != (k % 2 == from)) return false;
        return true;
    };
    return everySecondIsZero(0) || everySecondIsZero(1);
}

}  // namespace

RecognisedContent recognise(std::string_view bytes) {
    if (isBinaryStl(bytes)) return {FileContent::BinaryStl, "a binary STL mesh", {}};
    for (const Signature& signature : signatures)
        if (bytes.starts_with(signature.bytes)) return signature.meaning;
    if (isUnmarkedUtf16(bytes)) return {FileContent::NoText, "UTF-16 text", saveAsUtf8};
    if (bytes.starts_with(utf8Mark)) bytes.remove_prefix(utf8Mark.size());
    return recogniseText(bytes);
}

}  // namespace pendular
