#include "Drivers/Shared/DescribeOptions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#ifdef PENDULAR_HAS_JSON
    #include <nlohmann/json.hpp>
#endif

#include "Drivers/Shared/CommandLine.h"
#include "Drivers/Shared/CommandLineLibrary.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

#ifdef PENDULAR_HAS_JSON
namespace {

using Json = nlohmann::ordered_json;

/// An end of a range; JSON has no infinity.
Json endOf(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json rangeOf(const Range& range) {
    return {{"lowest", endOf(range.lowest)},
            {"highest", endOf(range.highest)},
            {"lowestIncluded", range.lowestIncluded},
            {"highestIncluded", range.highestIncluded}};
}

/// Without the checks that CLI11 writes behind it: "FLOAT:INT in [1 - 3]".
std::string kindOf(const CLI::Option& option) {
    const std::string name = option.get_type_name();
    return name.substr(0, name.find_first_of(": "));
}

std::string typeOf(const CLI::Option& option) {
    if (option.get_expected_max() == 0) return "flag";
    const std::string kind = kindOf(option);
    if (kind == "FLOAT") return "number";
    if (kind == "INT") return "whole";
    return kind == "UINT" ? "count" : "text";
}

/// "TEXT:{wet,dry}": wet and dry.
Json choicesOf(const CLI::Option& option) {
    const std::string name = option.get_type_name();
    const std::size_t begin = name.find(":{"), end = name.find('}', begin == name.npos ? 0 : begin);
    Json choices = Json::array();
    if (begin == name.npos || end == name.npos) return choices;
    for (const std::string& word : CLI::detail::split(name.substr(begin + 2, end - begin - 2), ','))
        choices.push_back(word);
    return choices;
}

Json namesOf(const std::set<CLI::Option*>& options) {
    Json names = Json::array();
    for (const CLI::Option* other : options) names.push_back("--" + other->get_lnames().front());
    return names;
}

/// Of an option that is no NumberOption. A name ends with its unit (CONTRIBUTING): "--viscosity-Pa-s".
std::string unitInName(const std::string& name) {
    if (name.ends_with("-Pa-s")) return "Pa s";
    constexpr std::string_view units[] = {"s",   "m",     "m3", "m/s",     "m/s2", "rad/s", "rpm",
                                          "deg", "kg/m3", "kg", "percent", "Pa",   "N/m"};
    const std::string end = name.substr(name.rfind('-') + 1);
    return std::find(std::begin(units), std::end(units), end) == std::end(units) ? "" : end;
}

std::string defaultOf(const CLI::Option& option) {
    std::string text = option.get_default_str();
    if (text.size() > 1 && text.front() == '[' && text.back() == ']') text = text.substr(1, text.size() - 2);
    return text;
}

std::string unitOf(const DriverProgram& driver, const CLI::Option& option, const std::string& name) {
    for (const NumberOption& number : driver.numbers)
        if (number.option() == name) return number.unit;
    const std::string type = typeOf(option);
    return type == "flag" || type == "text" ? "" : unitInName(name);
}

/// As its driver says: type_name(fileName).
bool isPath(const CLI::Option& option) { return kindOf(option) == fileName || kindOf(option) == folderName; }

/// Of options that several drivers have, by their names, which tell quantity and unit: the widest range that
/// one of them allows (checkRun(), the laws' fields). A NumberOption has its own.
std::map<std::string, Range> usualRanges() {
    std::map<std::string, Range> ranges{
        {"--threads", {1, 4096}},          {"--number", {1, 1e8}},
        {"--poisson-ratio", {-1, 0.5}},    {"--plate-poisson-ratio", {-1, 0.5}},
        {"--restitution", {0, 1}},         {"--interval-s", positive},
        {"--contact-angle-deg", {0, 180}}, {"--cone-deg", {0, 80}}};
    for (const char* interval : {"restart", "paraview", "hdf5", "energy", "wall-force"})
        ranges[fmt::format("--{}-interval-s", interval)] = notNegative;
    for (const char* name :
         {"end-time-s", "time-max-s", "time-step-s", "begin-s", "friction", "volume-m3",
          "surface-tension-N/m", "viscosity-Pa-s", "layer-m", "roughness-m", "advise-within-percent"})
        ranges[fmt::format("--{}", name)] = notNegative;
    for (const char* name : {"softening", "speed-m/s", "speeds-m/s", "radius-m", "radius1-m", "radius2-m",
                             "orifice-m", "hopper-diameter-m", "grain-diameter-m", "density-kg/m3",
                             "liquid-density-kg/m3", "elastic-modulus-Pa", "plate-elastic-modulus-Pa"})
        ranges[fmt::format("--{}", name)] = positive;
    return ranges;
}

/// As CLI11 checks it: "FLOAT:FLOAT in [0.001 - 89.999]".
std::optional<Range> checkedRange(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t begin = type.find(" in [");
    Range range{};
    if (begin == type.npos ||
        std::sscanf(type.c_str() + begin, " in [%lf - %lf]", &range.lowest, &range.highest) != 2)
        return {};
    return range;
}

std::optional<Range> rangeFor(const DriverProgram& driver, const CLI::Option& option,
                              const std::string& name) {
    for (const NumberOption& number : driver.numbers)
        if (number.option() == name) return number.allowed;
    if (const auto checked = checkedRange(option)) return checked;
    static const std::map<std::string, Range> usual = usualRanges();
    const auto known = usual.find(name);
    return known == usual.end() ? std::nullopt : std::optional(known->second);
}

}  // namespace

std::string describeOptions(const DriverProgram& driver, const CLI::App& app) {
    Json options = Json::array();
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_lnames().empty() || option->get_group().empty()) continue;
        const std::string name = "--" + option->get_lnames().front();
        if (name == "--help" || name == "--describe-options") continue;
        Json row{{"name", name},
                 {"type", typeOf(*option)},
                 {"unit", unitOf(driver, *option, name)},
                 {"text", option->get_description()},
                 {"default", defaultOf(*option)},
                 {"several", option->get_expected_max() > 1},
                 {"choices", choicesOf(*option)},
                 {"excludes", namesOf(option->get_excludes())},
                 {"needs", namesOf(option->get_needs())},
                 {"path", isPath(*option)}};
        if (const auto range = rangeFor(driver, *option, name)) row["range"] = rangeOf(*range);
        options.push_back(std::move(row));
    }
    const Json all{{"driver", driver.name}, {"description", driver.description}, {"options", options}};
    return all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}
#else
std::string describeOptions(const DriverProgram& driver, const CLI::App& /*app*/) {
    throw InputError(driver.name +
                     ": --describe-options needs nlohmann-json (package nlohmann-json3-dev); this build has "
                     "been made without it.");
}
#endif

}  // namespace pendular
