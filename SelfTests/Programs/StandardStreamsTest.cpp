// What a program does whose standard streams are closed, or cannot be written.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::standardStreamsTest {
namespace {

using support::contentOf;
using support::run;
using support::TestFolder;

/// Ten wet grains: their height on standard output, a summary and the progress on standard error.
class WetTowerFiles : public testing::Test {
protected:
    /// @param shown where the streams go, in the words of bash
    auto runTo(const TestFolder& folder, const std::string& shown) {
        return run("bash -c '" + folders::drivers.string() + "/WetTower/WetTower --output " +
                   folder.path().string() + " --energy-interval-s 0.02 --paraview-interval-s 0.1 " + shown +
                   "'");
    }
    /// All but the summary, which tells the time that the run took.
    static std::map<std::string, std::string> filesIn(const TestFolder& folder) {
        std::map<std::string, std::string> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            if (!entry.path().string().ends_with("-summary.csv"))
                files[entry.path().filename().string()] = contentOf(entry.path());
        return files;
    }
    void expectSameFiles(const std::string& shown, int exitCode) {
        SCOPED_TRACE(shown);
        const TestFolder folder;
        EXPECT_EQ(runTo(folder, shown).exitCode, exitCode);
        EXPECT_TRUE(filesIn(folder) == undisturbed);
    }
    void SetUp() override {
        const TestFolder folder;
        ASSERT_EQ(runTo(folder, ">/dev/null").exitCode, 0);
        undisturbed = filesIn(folder);
        ASSERT_GT(undisturbed.size(), 5u);
    }

    std::map<std::string, std::string> undisturbed;
};

/// Else the first file that is opened would get the number of the stream, and its text.
TEST_F(WetTowerFiles, areTheSameWhereStreamsAreClosed) {
    for (const char* closed : {"<&-", ">&-", "2>&-", "<&- >&- 2>&-"}) expectSameFiles(closed, 0);
}

TEST_F(WetTowerFiles, areTheSameWhereTheLogCannotBeWritten) {
    expectSameFiles("2>/dev/full >/dev/null", 0);
    expectSameFiles("2> >(true) >/dev/null", 0);  // a pipe whose reader has gone
}

/// The heights are results.
TEST_F(WetTowerFiles, areCompleteWhereResultsCannotBePrinted) {
    expectSameFiles(">/dev/full", 1);
    const TestFolder folder;
    const auto result = runTo(folder, "--quiet >/dev/full");
    EXPECT_EQ(result.exitCode, 0) << result.output;  // nothing is printed
}

TEST(StandardOutput, thatCannotBeWrittenIsAnError) {
    const std::string species = folders::tools.string() + "/species --list";
    support::expectOneSentence(run("(" + species + " >/dev/full)"), "No space left on device");
    EXPECT_EQ(run("(" + species + " >&-)").exitCode, 0);
    // It ends as a program that SIGPIPE ends, and as quietly.
    const auto result = run("bash -o pipefail -c '{ sleep 0.5; " + species + "; } | true'");
    EXPECT_EQ(result.exitCode, 141);
    EXPECT_EQ(result.output, "");
}

}  // namespace
}  // namespace pendular::standardStreamsTest
