#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "BuildFolders.h"

namespace pendular::printedTextsTest {
namespace {

namespace fs = std::filesystem;

const std::regex pathOfRepository(R"(\b(Kernel|Tools|Drivers|SelfTests)/\w)");

/// Whether a line of a program in C++ or Python names a path of the repository in anything but comments and
/// includes, its own or those of a source that it writes.
bool namesPath(std::string line, bool isPython) {
    static const std::regex comments[] = {std::regex(R"((^|[^:"'])//.*)"), std::regex(R"((^|\s)#.*)")};
    if (line.find('/') == std::string::npos || line.find("#include") != std::string::npos) return false;
    if (!std::regex_search(line, pathOfRepository)) return false;
    line = std::regex_replace(line, comments[isPython], "$1");
    return std::regex_search(line, pathOfRepository);
}

/// Whether a file is a source of the library, of a program or of the Python package; scripts and studies work
/// in the repository.
bool isOfPrograms(const fs::path& path) {
    const std::string name = path.lexically_relative(folders::source).string();
    if (path.extension() == ".py") return name.starts_with("Tools/Python/Package/");
    return (path.extension() == ".cpp" || path.extension() == ".h") && !name.starts_with("Tools/Studies/");
}

TEST(PrintedTexts, pathsAreSeenInTextsAlone) {
    EXPECT_TRUE(namesPath(R"(throw InputError("see Kernel/Analysis/Output/README.md");)", false));
    EXPECT_TRUE(namesPath(R"("http://localhost and Tools/view.sh")", false));
    EXPECT_TRUE(namesPath("    \"\"\"All tables (Kernel/Analysis/Output/README.md).\"\"\"", true));
    EXPECT_FALSE(namesPath(R"(#include "Kernel/Foundation/Base/Host.h")", false));
    EXPECT_FALSE(namesPath("int a;  // see Kernel/Foundation/Base/Host.h", false));
    EXPECT_FALSE(namesPath("a = 1  # see Kernel/Foundation/Base/Host.h", true));
}

// Files move; what a program has printed or written stays. A page is named by what it is about, a header
// without its folder. What help() of the Python module takes from comments, make-comments.py checks.
TEST(PrintedTexts, nameNoPathOfTheRepository) {
    std::size_t files = 0;
    std::string found;
    for (const char* folder : {"Kernel", "Drivers", "Tools"})
        for (const auto& entry : fs::recursive_directory_iterator(folders::source / folder)) {
            if (!isOfPrograms(entry.path())) continue;
            ++files;
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);)
                if (namesPath(line, entry.path().extension() == ".py"))
                    found += fmt::format("{}: {}\n", entry.path().string(), line);
        }
    EXPECT_GT(files, 800u);
    EXPECT_EQ(found, "");
}

}  // namespace
}  // namespace pendular::printedTextsTest
