#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "BuildFolders.h"

namespace pendular::floorsTest {
namespace {

const std::filesystem::path kernel = folders::source / "Kernel";

/// The floors of the kernel from the ground up: the first table of its README.
std::vector<std::string> floors() {
    std::ifstream readme(kernel / "README.md");
    const std::regex row(R"(^\| `(\w+)/` \|.*)");
    std::vector<std::string> found;
    for (std::string line; std::getline(readme, line);)
        if (std::smatch match; std::regex_match(line, match, row)) found.push_back(match[1]);
    return found;
}

TEST(Floors, areAllFoldersOfTheKernel) {
    std::vector<std::string> folders, named = floors();
    for (const auto& entry : std::filesystem::directory_iterator(kernel))
        if (entry.is_directory()) folders.push_back(entry.path().filename().string());
    std::sort(folders.begin(), folders.end());
    std::sort(named.begin(), named.end());
    EXPECT_EQ(named, folders);
}

TEST(Floors, includeOnlyFromTheirOwnOrOneBelow) {
    const std::vector<std::string> order = floors();
    const auto floorOf = [&](const std::string& folder) {
        return std::find(order.begin(), order.end(), folder);
    };
    const std::regex include(R"(^\s*#\s*include "Kernel/(\w+)/.*)");
    std::size_t seen = 0;
    std::string upwards;
    for (const std::string& folder : order)
        for (const auto& entry : std::filesystem::recursive_directory_iterator(kernel / folder)) {
            std::ifstream file(entry.path());
            std::smatch match;
            for (std::string line; entry.is_regular_file() && std::getline(file, line);) {
                if (!std::regex_match(line, match, include)) continue;
                ++seen;
                if (floorOf(match[1]) > floorOf(folder))
                    upwards += fmt::format("{}: {}\n", entry.path().string(), line);
            }
        }
    EXPECT_GT(seen, 100u);
    EXPECT_EQ(upwards, "");
}

// Else a change of the scene's header compiles all again that uses an output.
TEST(Floors, headersOfOutputsOnlyNameTheScene) {
    const std::regex scene(R"(^\s*#\s*include "Kernel/Scene/(Scene|Simulation)\.h".*)");
    std::size_t headers = 0;
    std::string including;
    for (const std::string folder : {"Analysis/Output", "Analysis/CoarseGraining"})
        for (const auto& entry : std::filesystem::directory_iterator(kernel / folder)) {
            if (entry.path().extension() != ".h") continue;
            ++headers;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);)
                if (std::regex_match(line, scene)) including += entry.path().string() + '\n';
        }
    EXPECT_GT(headers, 20u);
    EXPECT_EQ(including, "");
}

}  // namespace
}  // namespace pendular::floorsTest
