#include "Kernel/Files/TextFile.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <utility>

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

std::string shown(std::string_view word) {
    std::string result;
    for (const char c : word.substr(0, 24)) result += c > ' ' && c < 127 ? c : '?';
    return result;
}

bool parseNumber(std::string_view word, double& value) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    return problem == std::errc{} && end == word.data() + word.size();
}

std::string parseLength(std::string_view word, double scale, double& value) {
    if (word.empty()) return "the file ends where a number is expected";
    if (!parseNumber(word, value)) return fmt::format("'{}' is not a number", shown(word));
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

/// Whether a line has the names of columns: a first word that begins with a letter, and none that is a number
/// or is meant as one.
bool isHeader(std::string_view line) {
    Words words(line);
    std::string_view word = words.next();
    const char first = word.empty() ? ' ' : word.front();
    if (!((first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z'))) return false;
    for (double number; !word.empty(); word = words.next())
        if (parseNumber(word, number) || isMeantAsNumber(word)) return false;
    return true;
}

std::string hintFor(std::string_view word) {
    if (word.starts_with("\xEF\xBB\xBF")) return " (it begins with a byte order mark: save the file without)";
    if (word.find(',') != word.npos) return " (decimals have a point, and blanks part numbers)";
    return {};
}

}  // namespace

void forEachRow(const InputFile& file, double scale,
                const std::function<void(std::size_t line, const std::vector<double>& row)>& use) {
    std::string_view rest = file.text;
    std::vector<double> row;
    bool mayBeHeader = true;
    for (std::size_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view text = rest.substr(0, end);
        Words words(text);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        std::string_view word = words.next();
        if (word.empty() || word.front() == '#') continue;
        if (std::exchange(mayBeHeader, false) && isHeader(text)) continue;
        row.clear();
        for (double number; !word.empty(); word = words.next()) {
            if (const std::string reason = parseLength(word, scale, number); !reason.empty())
                file.refuseWord(line, static_cast<std::size_t>(word.data() - text.data()) + 1,
                                reason + hintFor(word));
            row.push_back(number);
        }
        use(line, row);
    }
}

}  // namespace pendular
