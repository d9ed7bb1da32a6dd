#include "Tools/View/DriverOptions.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Tools/View/Process.h"
#include "Tools/View/ReadJson.h"

namespace pendular::view {

namespace fs = std::filesystem;
using Json = DriverOptions::Json;

namespace {

constexpr std::size_t longestValue = 500;
constexpr std::chrono::seconds pause(5);  // before a driver that has not said its options is asked again

bool isName(const std::string& word) {
    return !word.empty() && word.size() < 100 && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-';
    }) && word[0] != '-';
}

double endOf(const Json& range, const char* end, double none) {
    return range[end].is_number() ? range[end].get<double>() : none;
}

Range rangeOf(const Json& range) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {endOf(range, "lowest", -infinite), endOf(range, "highest", infinite), range["lowestIncluded"],
            range["highestIncluded"]};
}

void checkNumber(const Json& option, const std::string& name, const std::string& word) {
    double value = 0;
    const std::string type = option["type"];
    if (!parseNumber(word, value))
        throw InputError(fmt::format("{} = '{}' is no number.", name, shown(word)));
    if (!std::isfinite(value))
        throw InputError(fmt::format("{} = '{}' is not a finite number.", name, shown(word)));
    const bool isWhole = word.find_first_not_of("+-0123456789") == word.npos;
    if (type != "number" && (!isWhole || (type == "count" && value < 0)))
        throw InputError(fmt::format("{} = '{}' is no whole number{}.", name, shown(word),
                                     type == "count" ? ", 0 or more" : ""));
    if (option.contains("range"))
        checkValue("The form", name, value, option["unit"].get<std::string>(), rangeOf(option["range"]));
}

void checkWord(const Json& option, const std::string& name, const std::string& word) {
    const Json& choices = option["choices"];
    if (!choices.empty() && std::find(choices.begin(), choices.end(), Json(word)) == choices.end())
        throw InputError(fmt::format("{} = '{}'; it may be one of {}.", name, shown(word), choices.dump()));
    if (option["type"] != "text") checkNumber(option, name, word);
}

}  // namespace

std::vector<std::string> wordsOf(const Json& option, const std::string& value) {
    const std::string name = option["name"];
    if (option["path"] == true || name == "--resume" || name == "--wall-time" || name == "--quiet")
        throw InputError(fmt::format("{} cannot be given from the page.", name));
    if (value.size() > longestValue ||
        std::any_of(value.begin(), value.end(), [](unsigned char c) { return c < ' '; }))
        throw InputError(
            fmt::format("{} is longer than {} signs, or has signs that are no text.", name, longestValue));
    if (option["type"] == "flag") {
        if (value != "true" && value != "false")
            throw InputError(fmt::format("{} may be true or false.", name));
        return value == "true" ? std::vector<std::string>{name} : std::vector<std::string>{};
    }
    std::vector<std::string> values{value};
    if (option["several"] == true) {
        std::string parted = value;
        std::replace(parted.begin(), parted.end(), ',', ' ');
        std::istringstream words(parted);
        values.assign(std::istream_iterator<std::string>(words), {});
    }
    std::vector<std::string> words;
    for (const std::string& word : values) {
        checkWord(option, name, word);
        words.push_back(fmt::format("{}={}", name, word));  // no word of a value is taken for an option
    }
    return words;
}

fs::path DriverOptions::pathOf(const std::string& driver) const {
    return inFolder.empty() ? folder / driver / driver : folder / driver;
}

std::vector<std::string> DriverOptions::names() const {
    std::vector<std::string> found = inFolder;
    std::error_code problem;
    if (inFolder.empty())
        for (const auto& entry : fs::directory_iterator(folder, problem))
            found.push_back(entry.path().filename().string());
    std::erase_if(found, [&](const std::string& name) {
        return !isName(name) || access(pathOf(name).c_str(), X_OK) != 0;
    });
    std::sort(found.begin(), found.end());
    return found;
}

fs::path DriverOptions::program(const std::string& driver) const {
    const fs::path path = pathOf(driver);
    std::error_code problem;
    const bool isDriver = inFolder.empty() || std::ranges::count(inFolder, driver) > 0;
    if (!isName(driver) || !isDriver || !fs::is_regular_file(path, problem) ||
        access(path.c_str(), X_OK) != 0)
        throw InputError(fmt::format("view: there is no driver '{}'.", shown(driver)));
    return path;
}

const Json& DriverOptions::describe(const std::string& driver) {
    const fs::path path = program(driver);
    std::error_code problem;
    const auto written = fs::last_write_time(path, problem);
    const auto found = known.find(driver), end = known.end();
    const auto now = std::chrono::steady_clock::now();
    if (found != end && found->second.written == written &&
        (!found->second.description.is_null() || now - found->second.asked < pause))
        return found->second.description;
    const Json told = parseJson(outputOf(path, {"--describe-options"}));
    const bool isWhole = told.is_object() && told.contains("options") && told["options"].is_array();
    return (known[driver] = {written, std::chrono::steady_clock::now(), isWhole ? told : Json(nullptr)})
        .description;
}

Json DriverOptions::all() {
    const std::scoped_lock one(mutex);
    Json list = Json::array();
    for (const std::string& name : names())
        if (const Json& description = describe(name); !description.is_null()) list.push_back(description);
    return list;
}

std::vector<std::string> DriverOptions::commandLine(const std::string& driver, const Json& options) {
    const std::scoped_lock one(mutex);
    const Json& description = describe(driver);
    if (description.is_null())
        throw InputError(fmt::format("view: the driver {} does not say its options.", driver));
    std::vector<std::string> words;
    const Json& listed = description["options"];
    for (const auto& given : options.items()) {
        const std::string& name = given.key();
        const auto option =
            std::find_if(listed.begin(), listed.end(), [&](const Json& o) { return o["name"] == name; });
        if (option == listed.end())
            throw InputError(fmt::format("{} has no option {}.", driver, shown(name)));
        if (!given.value().is_string()) throw InputError(fmt::format("{} must be a text.", name));
        for (std::string& word : wordsOf(*option, given.value())) words.push_back(std::move(word));
    }
    return words;
}

}  // namespace pendular::view
