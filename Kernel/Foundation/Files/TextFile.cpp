#include "Kernel/Foundation/Files/TextFile.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <utility>

#include "Kernel/Foundation/Files/FileContent.h"

namespace pendular {

namespace {

constexpr std::uintmax_t largestFile = std::uintmax_t{1} << 32;  // bytes

}  // namespace

InputFile loadInputFile(std::string_view kind, const std::filesystem::path& path) {
    InputFile file{std::string(kind), path.string(), {}};
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

InputFile loadTextFile(std::string_view kind, const std::filesystem::path& path) {
    InputFile file = loadInputFile(kind, path);
    takeAsText(file);
    return file;
}

void takeAsText(InputFile& file) {
    std::string& text = file.text;
    if (recognise(text).content == FileContent::NoText) refuseOtherContent(file);
    if (const std::size_t zero = text.find('\0'); zero != text.npos)
        file.refuse("offset", zero, "a byte is zero, so that the file is no text");
    if (text.starts_with(utf8Mark)) text.erase(0, utf8Mark.size());
    if (text.find('\r') == text.npos) return;
    std::size_t length = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const bool isPair = text[k] == '\r' && k + 1 < text.size() && text[k + 1] == '\n';
        if (!isPair) text[length++] = text[k] == '\r' ? '\n' : text[k];
    }
    text.resize(length);
}

void refuseOtherContent(const InputFile& file) {
    const RecognisedContent found = recognise(file.text);
    if (found.content == FileContent::Unknown) return;
    file.refuse(
        fmt::format("is {} by its content{}{}", found.name, found.advice.empty() ? "" : "; ", found.advice));
}

std::string shown(std::string_view word) {
    std::string result;
    for (const char c : word.substr(0, 24)) result += c > ' ' && c < 127 ? c : '?';
    return result;
}

bool parseNumber(std::string_view word, double& value) {
    if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    return problem == std::errc{} && end == word.data() + word.size();
}

std::string whyNoNumber(std::string_view word) {
    const bool hasDigits = word.find_first_of("0123456789") != word.npos;
    std::string_view hint;
    if (hasDigits && word.find_first_of(",;") != word.npos)
        hint = " (decimals have a point, not a comma; blanks part numbers)";
    else if (hasDigits && word.find_first_of("dD") != word.npos)
        hint = " (powers of ten are written as in 1e-3)";
    return fmt::format("'{}' is not a number{}", shown(word), hint);
}

std::string parseLength(std::string_view word, double scale, double& value) {
    if (word.empty()) return "the file ends where a number is expected";
    if (!parseNumber(word, value)) return whyNoNumber(word);
    value *= scale;
    if (!(std::abs(value) <= largestLength))
        return fmt::format("the length {} is not finite or above {:g} m", shown(word), largestLength);
    return {};
}

namespace {

/// Whether a word looks like a number in which letters stand for digits: "l.0O1".
bool isMeantAsNumber(std::string_view word) {
    return word.find('.') != word.npos && word.find_first_of("0123456789") != word.npos &&
           word.find_first_not_of("0123456789.+-eEoOlI") == word.npos;
}

/// Words that blanks, or commas too, part.
std::vector<std::string_view> wordsOf(std::string_view line, std::string_view separators) {
    std::vector<std::string_view> words;
    for (std::size_t begin = 0; (begin = line.find_first_not_of(separators, begin)) != line.npos;) {
        const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
        words.push_back(line.substr(begin, end - begin));
        begin = end;
    }
    return words;
}
constexpr std::string_view blanks = " \t\r\v\f", blanksAndCommas = " \t\r\v\f,";

/// Whether a line has the names of columns: a first word that begins with a letter, and none that is a number
/// or is meant as one.
bool isHeader(std::string_view line) {
    const std::vector<std::string_view> words = wordsOf(line, blanksAndCommas);
    const char first = words.empty() ? ' ' : words.front().front();
    if (!((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z'))) return false;
    double number;
    return std::ranges::none_of(
        words, [&](std::string_view word) { return parseNumber(word, number) || isMeantAsNumber(word); });
}

/// The cells of a row. If commas part them, a cell is what is between two commas, without blanks around it;
/// the last one may be empty. Else, or if a cell would have blanks in it, they are what blanks part: a word
/// with a comma in it is no number then.
std::vector<std::string_view> cellsOfRow(std::string_view line) {
    std::vector<std::string_view> byBlanks = wordsOf(line, blanks);
    if (line.find(',') == line.npos) return byBlanks;
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        const std::vector<std::string_view> inside = wordsOf(line.substr(begin, end - begin), blanks);
        if (inside.size() > 1) return byBlanks;
        if (inside.size() == 1) cells.push_back(inside.front());
        else if (end < line.size()) cells.push_back(line.substr(end, 1));  // nothing between two commas
        begin = end + 1;
    }
    return cells;
}

}  // namespace

void forEachRow(const InputFile& file, double scale,
                const std::function<void(std::size_t line, const std::vector<double>& row)>& use) {
    // "solid" alone may be the name of a column.
    if (recognise(file.text).content != FileContent::AsciiStl) refuseOtherContent(file);
    std::string_view rest = file.text;
    std::vector<double> row;
    bool mayBeHeader = true;
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view text = rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        const std::vector<std::string_view> cells = cellsOfRow(text);
        if (cells.empty() || cells.front().front() == '#') continue;
        if (std::exchange(mayBeHeader, false) && isHeader(text)) continue;
        row.clear();
        double number;
        for (const std::string_view cell : cells) {
            if (const std::string reason = parseLength(cell, scale, number); !reason.empty()) {
                refuseOtherContent(file);
                file.refuseWord(line, static_cast<std::size_t>(cell.data() - text.data()) + 1, reason);
            }
            row.push_back(number);
        }
        use(line, row);
    }
}

}  // namespace pendular
