// A driver of an earlier version finds the headers where they are now.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::moveIncludesTest {
namespace {

const std::filesystem::path tool = folders::source / "Tools/MoveIncludes";

TEST(MoveIncludes, changesIncludesAlone) {
    const support::TestFolder folder;
    const std::filesystem::path driver = folder.path() / "Driver.cpp";
    std::ofstream(driver, std::ios::binary) << "#include \"Kernel/Walls/InfiniteWall.h\"\r\n"
                                               " # include <Kernel/Species/Laws.h>\r\n"
                                               "#include \"Kernel/MercuryScene.h\"\r\n"
                                               "#include \"Kernel/Walls/MyWall.h\"\r\n"
                                               "// \xe9: Kernel/Walls/InfiniteWall.h\r\n";
    const auto result = support::run((tool / "move-includes.py").string() + " " + driver.string());
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(support::contentOf(driver),
              "#include \"Kernel/Core/Walls/InfiniteWall.h\"\r\n"
              " # include <Kernel/Features/Laws.h>\r\n"
              "#include \"Kernel/MercuryScene.h\"\r\n"
              "#include \"Kernel/Walls/MyWall.h\"\r\n"
              "// \xe9: Kernel/Walls/InfiniteWall.h\r\n");
}

// A header that moves again changes its row.
TEST(MoveIncludes, knowsWhereTheHeadersAre) {
    std::ifstream table(tool / "moved-headers.tsv");
    std::size_t rows = 0;
    for (std::string line; std::getline(table, line);) {
        if (line.starts_with("#")) continue;
        ++rows;
        const std::string before = line.substr(0, line.find('\t')), now = line.substr(line.find('\t') + 1);
        EXPECT_FALSE(std::filesystem::exists(folders::source / before)) << before;
        EXPECT_TRUE(std::filesystem::exists(folders::source / now) ||
                    std::filesystem::exists(folders::binary / "Generated" / now))
            << now;
    }
    EXPECT_GT(rows, 400u);
}

}  // namespace
}  // namespace pendular::moveIncludesTest
