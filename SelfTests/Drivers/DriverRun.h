#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "BuildFolders.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"

/// What tests of drivers as programs share.
namespace pendular::driverRuns {

inline const std::string drivers = folders::drivers;

/// The rows of a table without its header, numbers only.
inline std::vector<std::vector<double>> rowsOf(const std::filesystem::path& file) {
    return support::numbersOf(support::contentOf(file));
}
inline std::string headerOf(const std::filesystem::path& file) {
    const std::string text = support::contentOf(file);
    return text.substr(0, text.find('\n'));
}

}  // namespace pendular::driverRuns
