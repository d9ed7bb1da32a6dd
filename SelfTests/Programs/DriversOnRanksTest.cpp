// Every driver, as mpirun starts it on 2 and 3 ranks: the files and the printed results of one process.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "SelfTests/Drivers/DriverRun.h"
#include "SelfTests/Programs/OnRanks.h"
#include "SelfTests/Support/SameFiles.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::driversOnRanksTest {
namespace {

using namespace support;
namespace fs = std::filesystem;

/// Drivers that several ranks cannot share, and the sentence with which they say so at set-up.
const std::map<std::string, std::string> notShared{
    {"FluidisedColumn", "a cell of the fluid needs the grains of all ranks"}};

constexpr std::string_view summaries = "summary.csv";

/// Else small scenes that begin without grains would stay on one rank: they are not worth the sharing.
const std::string cutsWander = "PENDULAR_CUTS_WANDER=1 ";

/// The rows of all summaries that do not tell of the clock and of lists, which are due when ranks say so.
std::string summariesOf(const fs::path& folder) {
    std::string rows;
    for (const auto& [name, content] : filesOf(folder)) {
        if (!name.ends_with(summaries)) continue;
        std::istringstream lines(content);
        for (std::string line; std::getline(lines, line);) {
            const auto tellsOf = [&](std::string_view what) { return line.starts_with(what); };
            if (!tellsOf("wall time") && !tellsOf("waiting for other ranks") && !tellsOf("lists of contacts"))
                rows += name + ": " + line + "\n";
        }
    }
    return rows;
}

class DriversOnRanks : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override {
        if (areRanksMissing()) GTEST_SKIP() << without("libopenmpi-dev", "drivers on several processes");
    }
    /// In a folder of its own, so that the names that it prints are the same.
    /// @param start what starts a program on a number of ranks; empty: one process
    [[nodiscard]] ProgramResult runIn(const std::string& name, const std::string& start) const {
        fs::create_directory(folder.path() / name);
        return run(fmt::format("(cd {} && {} {}/{}/{} {} --output out 2>log)",
                               (folder.path() / name).string(), start, driverRuns::drivers, GetParam(),
                               GetParam(), driverRuns::shortOptionsOf(GetParam())));
    }
    [[nodiscard]] std::string logOf(const std::string& name) const {
        return contentOf(folder.path() / name / "log");
    }
    const TestFolder folder;
};

TEST_P(DriversOnRanks, haveTheResultsOfOneProcess) {
    const ProgramResult alone = runIn("1", "");
    ASSERT_EQ(alone.exitCode, 0) << logOf("1");
    const auto refused = notShared.find(GetParam());
    for (const int ranks : {2, 3}) {
        SCOPED_TRACE(fmt::format("{} ranks", ranks));
        const std::string own = std::to_string(ranks);
        const ProgramResult shared = runIn(own, cutsWander + onRanks(ranks, 300));
        if (refused != notShared.end()) {
            EXPECT_NE(shared.exitCode, 0);
            EXPECT_NE(logOf(own).find(refused->second), std::string::npos) << logOf(own);
            continue;
        }
        ASSERT_EQ(shared.exitCode, 0) << logOf(own);
        EXPECT_EQ(shared.output, alone.output);
        const fs::path expected = folder.path() / "1/out", found = folder.path() / own / "out";
        expectSameFiles(expected, found, summaries);
        EXPECT_EQ(summariesOf(found), summariesOf(expected));
    }
}

INSTANTIATE_TEST_SUITE_P(Every, DriversOnRanks, testing::ValuesIn(driverRuns::everyDriver()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace pendular::driversOnRanksTest
