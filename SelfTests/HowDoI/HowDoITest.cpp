#include <map>
#include <sstream>

#include "BuildFolders.h"
#include "SelfTests/HowDoI/HowDoI.h"
#include "SelfTests/Support/RunProgram.h"

// That Kernel/HOW-DO-I.md shows what is tested.

namespace {

using Lines = std::vector<std::string>;

Lines linesOf(const std::filesystem::path& path) {
    std::istringstream text(support::contentOf(path));
    Lines lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

/// Without the indentation that all lines have.
std::string withoutIndentation(const Lines& lines) {
    std::size_t common = std::string::npos;
    for (const std::string& line : lines) common = std::min(common, line.find_first_not_of(' '));
    std::string text;
    for (const std::string& line : lines) text += line.substr(std::min(common, line.size())) + '\n';
    return text;
}

/// The blocks of code on the page, without their fences.
std::vector<Lines> blocksOnPage() {
    std::vector<Lines> blocks;
    bool isOpen = false;
    for (const std::string& line : linesOf(folders::source / "Kernel/HOW-DO-I.md")) {
        if (isOpen && line == "```") isOpen = false;
        else if (isOpen) blocks.back().push_back(line);
        else if (line == "```cpp") isOpen = true, blocks.emplace_back();
    }
    EXPECT_FALSE(isOpen);
    return blocks;
}

/// What stands between the marks in the files of this folder, by the line that says where.
std::map<std::string, std::string> testedSnippets() {
    std::map<std::string, std::string> snippets;
    for (const auto& entry : std::filesystem::directory_iterator(folders::source / "SelfTests/HowDoI")) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".cpp") || name == "HowDoITest.cpp") continue;
        Lines lines = linesOf(entry.path());
        const auto mark = [&](const char* text) {
            return std::find_if(lines.begin(), lines.end(),
                                [&](const std::string& line) { return line.ends_with(text); });
        };
        const auto begin = mark("// [snippet]"), end = mark("// [end]");
        if (begin >= end || end == lines.end()) ADD_FAILURE() << name << " has no snippet";
        else snippets["// SelfTests/HowDoI/" + name] = withoutIndentation({begin + 1, end});
    }
    return snippets;
}

TEST_F(HowDoI, pageShowsWhatIsTested) {
    auto snippets = testedSnippets();
    EXPECT_GE(snippets.size(), 31u);
    for (const Lines& block : blocksOnPage()) {
        ASSERT_FALSE(block.empty());
        if (block[0].starts_with("#include")) continue;  // what all need
        const auto tested = snippets.extract(block[0]);
        if (tested.empty()) ADD_FAILURE() << "no test, or shown twice: " << block[0];
        else EXPECT_EQ(withoutIndentation({block.begin() + 1, block.end()}), tested.mapped()) << block[0];
    }
    for (const auto& [file, text] : snippets) ADD_FAILURE() << "not on the page: " << file;
}

// All answers are there, and every link of the page to one of its headings leads to one.
TEST_F(HowDoI, pageLeadsToItsAnswers) {
    std::string text;
    std::map<std::string, int> links;  // to each heading
    for (const std::string& line : linesOf(folders::source / "Kernel/HOW-DO-I.md")) {
        text += line + '\n';
        if (!line.starts_with("### ")) continue;
        std::string anchor;
        for (const char c : line.substr(4))
            if (c == ' ') anchor += '-';
            else if (std::isalnum(static_cast<unsigned char>(c)))
                anchor += static_cast<char>(std::tolower(c));
        links[anchor] = 0;
    }
    EXPECT_FALSE(contains(text, "TODO"));
    for (std::size_t at = 0; (at = text.find("](#", at)) != std::string::npos;) {
        at += 3;
        const std::string anchor = text.substr(at, text.find(')', at) - at);
        if (!links.contains(anchor)) ADD_FAILURE() << "no heading: " << anchor;
        else ++links[anchor];
    }
    EXPECT_GE(links.size(), 40u);
    for (const auto& [anchor, count] : links) EXPECT_GT(count, 0) << "not in the list: " << anchor;
}

TEST_F(HowDoI, FirstDriver) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    std::string name = "FirstDriver", quiet = "--quiet";
    char* arguments[] = {name.data(), quiet.data()};
    runProgramOf([&] { return mainOfFirstDriver(2, arguments); });
    EXPECT_TRUE(std::filesystem::exists("FirstDriver-output/run-restart.h5"));
    struct FirstDriver scene;
    run(scene);
    EXPECT_NEAR(scene.particleHandler.getObject(0).getPosition().x(), 0.01 + 0.1 * scene.getTime(), 1e-14);
}

}  // namespace
