#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace pendular::view {

/// The drivers that a build has, and what they say of their options (--describe-options).
class DriverOptions {
public:
    using Json = nlohmann::ordered_json;

    /// @param drivers folder with NAME/NAME, as a build has it
    /// @param listed names of programs in the folder itself, as a package has it; empty: it is that of a
    /// build
    explicit DriverOptions(std::filesystem::path drivers, std::vector<std::string> listed = {})
        : folder(std::move(drivers)), inFolder(std::move(listed)) {}

    /// The descriptions of all drivers, sorted by name.
    [[nodiscard]] Json all();
    /// The program of a driver. Throws InputError where there is none of this name.
    [[nodiscard]] std::filesystem::path program(const std::string& driver) const;
    /// Options as a form gives them, as words of a command line, once each has been checked by the driver's
    /// own description. Throws InputError, which says the option and what is allowed.
    /// @param options texts by the names of options; a flag is "true" or "false"
    [[nodiscard]] std::vector<std::string> commandLine(const std::string& driver, const Json& options);

private:
    [[nodiscard]] const Json& describe(const std::string& driver);
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] std::filesystem::path pathOf(const std::string& driver) const;

    struct Known {
        std::filesystem::file_time_type written;
        std::chrono::steady_clock::time_point asked;
        Json description;  // null: it has not said its options; it may yet
    };
    std::filesystem::path folder;
    std::vector<std::string> inFolder;
    std::mutex mutex;
    std::map<std::string, Known> known;
};

/// The words that one option adds. Throws InputError.
std::vector<std::string> wordsOf(const DriverOptions::Json& option, const std::string& value);

}  // namespace pendular::view
