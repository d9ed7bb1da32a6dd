#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "BuildFolders.h"

namespace pendular::support {

/// The path of a file of the reference data that is not in the repository.
inline std::filesystem::path sharedData(const std::string& file) { return folders::shared / "data" / file; }

/// Whether the file is there. Where it is not, the test is to be skipped; but it fails where the others are
/// there, or where PENDULAR_REQUIRE_SHARED is set (.ci/run): then nobody means to leave it out.
inline bool hasSharedData(const std::string& file) {
    if (std::filesystem::exists(sharedData(file))) return true;
    if (std::getenv("PENDULAR_REQUIRE_SHARED") || std::filesystem::exists(folders::shared / "data"))
        ADD_FAILURE() << "The reference data " << sharedData(file) << " is not there, and it is needed here.";
    return false;
}

/// What a test says that is skipped without it.
inline std::string withoutSharedData(const std::string& file) {
    return "The reference data " + sharedData(file).string() +
           " is not there: this is NOT tested (give its folder to CMake: -D PENDULAR_SHARED_DIR=FOLDER).";
}

}  // namespace pendular::support
