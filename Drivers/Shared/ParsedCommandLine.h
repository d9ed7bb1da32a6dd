#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Laws/Species/LawNames.h"

namespace pendular {

/// Returns what is wrong with a text that CLI11 lets through: an empty number, which it reads as 0; an empty
/// text, which many programs would take for an option that is left out; a negative number for a count, which
/// it reads as 1.8e19; one with a 0 in front, which it reads as octal; more than 18 digits. Nothing is
/// returned if all is well.
inline std::string objectionTo(const std::string& kind, const std::string& text) {
    const bool isWhole = kind == "UINT" || kind == "INT";
    if (text.empty())
        return isWhole || kind == "FLOAT" ? "the value is empty; it must be a number" : "the value is empty";
    if (!isWhole) return {};
    const bool isCount = kind == "UINT";
    const std::string digits = text.substr(text[0] == '+' || (text[0] == '-' && !isCount) ? 1 : 0);
    const bool areDigits =
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (areDigits && !digits.empty() && digits.size() <= 18 && (digits[0] != '0' || digits.size() == 1))
        return {};
    return fmt::format("'{}' is not a whole number{} of at most 18 digits", text,
                       isCount ? ", 0 or more," : "");
}

/// Takes an option also under a name that it had before, which --help does not show.
template <class Value>
CLI::Option* addFormerName(CLI::App& app, const char* former, Value& value) {
    return app.add_option(former, value)->group("");
}

/// What is said of an option that there is not, with those that are spelt nearly so.
inline std::string unknownOption(const CLI::App& app, const std::string& option) {
    std::vector<std::string> names;
    for (const CLI::Option* known : app.get_options())
        for (const std::string& name : known->get_lnames()) names.push_back(name);
    const std::string given = option.substr(2, option.find('=') - 2);
    std::string near;
    for (const std::string_view name : nearNames(given, {names.begin(), names.end()}))
        near += fmt::format("{}--{}", near.empty() ? ", but there is " : " and ", name);
    return fmt::format("there is no option --{}{}; see --help\n", given, near);
}

/// Parses the command line of any program of ours. Returns the exit code where the program ends with that: 0
/// if it has printed its help; 1, as for all other wrong input, if it has said on standard error what is
/// wrong.
inline std::optional<int> parseCommandLine(CLI::App& app, int argc, char** argv) {
    app.failure_message([](const CLI::App* failed, const CLI::Error& error) {
        if (dynamic_cast<const CLI::ExtrasError*>(&error))
            for (const std::string& word : failed->remaining(true))
                if (word.starts_with("--") && word.size() > 2) return unknownOption(*failed, word);
        return fmt::format("{}; see --help\n", error.what());
    });
    for (CLI::Option* option : app.get_options()) {
        const std::string name = option->get_type_name(),
                          kind = name.substr(0, name.find(':'));  // UINT:POSITIVE
        const auto isOneOf = [&](auto... kinds) { return ((kind == kinds) || ...); };
        if (!isOneOf("UINT", "INT", "FLOAT", "TEXT", "FILE", "FOLDER")) continue;
        option->check([kind](const std::string& text) { return objectionTo(kind, text); });
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& end) {
        if (isSilentRank()) return end.get_exit_code() == 0 ? 0 : 1;
        return app.exit(end) == 0 ? 0 : 1;
    }
    return {};
}

}  // namespace pendular
