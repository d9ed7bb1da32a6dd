// Programs that are given damaged restart files: each ends by itself, with one sentence or with what it has
// read, and takes no memory that a file only claims.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "BuildFolders.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Files/ReadingProcess.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/SharedData.h"
#include "SelfTests/Support/TestFolder.h"

extern char** environ;

namespace pendular::damagedFilesTest {
namespace {

struct Result {
    int status;  // as waitpid() gives it
    long peak;   // kB, also of the processes that the program has waited for
};

class DamagedFiles : public testing::Test {
protected:
    void SetUp() override {
        if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: no restart files.";
    }
    /// Standard error goes to the file "printed".
    [[nodiscard]] Result run(std::vector<std::string> words) const {
        posix_spawn_file_actions_t streams;
        posix_spawn_file_actions_init(&streams);
        posix_spawn_file_actions_addopen(&streams, 1, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&streams, 2, printed.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        pid_t process = 0;
        EXPECT_EQ(posix_spawn(&process, arguments[0], &streams, nullptr, arguments.data(), environ), 0);
        posix_spawn_file_actions_destroy(&streams);
        int status = 0;
        rusage used{};
        wait4(process, &status, 0, &used);
        return {status, used.ru_maxrss};
    }
    /// Both programs that read any restart file; returns how many have refused this one.
    int expectSentences() const {
        const std::filesystem::path tools = folders::tools;
        int refusals = 0;
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{tools / "restart-to-text", file},
              std::vector<std::string>{tools / "snapshot", file, "--scene-only", "--output",
                                       folder.path() / "picture.png"}}) {
            const Result result = run(words);
            const std::string told = support::contentOf(printed);
            EXPECT_TRUE(WIFEXITED(result.status))
                << words[0] << " ended by signal " << WTERMSIG(result.status);
            const int code = WEXITSTATUS(result.status);
            EXPECT_TRUE(code == 0 || code == 1) << code;
            EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), code) << told;
            if (ReadingProcess::limitsMemory()) {
                EXPECT_LT(result.peak, 200'000) << words[0];
            }
            refusals += code;
        }
        return refusals;
    }
    /// A restart file as far as these programs know one.
    void writeGood() const {
        double timeStep = 1e-6, timeBefore = 0;
        std::uint64_t steps = 7, stepsBefore = 0;
        std::vector<TranslationRecord> grains(20);
        for (std::size_t k = 0; k < grains.size(); ++k) {
            grains[k].position = {2e-3 * static_cast<double>(k), 0, 0};
            grains[k].radius = 1e-3;
        }
        writeRestartFile(file, [&](StateArchive& archive) {
            archive.value("timeStep", timeStep);
            archive.value("steps", steps);
            archive.value("stepsBefore", stepsBefore);
            archive.value("timeBefore", timeBefore);
            archive.group("particles", [&] { archive.column<double>("translation", grains); });
        });
    }

    const support::TestFolder folder = support::TestFolder::inMemory();
    const std::filesystem::path file = folder.path() / "run-restart.h5", printed = folder.path() / "printed";
};

/// Addresses and sizes of the library's headers: a word of 64 bits behind one of their signatures is another.
TEST_F(DamagedFiles, endProgramsInOneSentence) {
    writeGood();
    const std::string good = support::contentOf(file);
    std::vector<std::size_t> headers;
    for (const char* const signature : {"TREE", "SNOD", "HEAP"})
        for (std::size_t at = good.find(signature); at != good.npos; at = good.find(signature, at + 1))
            headers.push_back(at);
    ASSERT_GE(headers.size(), 6u);
    EXPECT_EQ(expectSentences(), 0);
    UniformRandom random(1);
    const auto below = [&](std::size_t end) {
        return static_cast<std::size_t>(random.uniform(0, static_cast<double>(end)));
    };
    int refusals = 0;
    for (int k = 0; k < 60; ++k) {
        std::string bytes = good;
        const std::size_t at = headers[below(headers.size())] + 8 * below(12);
        const std::uint64_t words[] = {0,          1,     0xffff,          1ull << 32,
                                       1ull << 62, ~0ull, good.size() - 8, below(good.size())};
        if (at + 8 > bytes.size()) continue;
        std::memcpy(bytes.data() + at, &words[below(std::size(words))], 8);
        std::ofstream(file, std::ios::binary) << bytes;
        sealRestartFile(file);
        refusals += expectSentences();
    }
    EXPECT_GT(refusals, 20);
}

TEST_F(DamagedFiles, atWhichTheLibraryCrashesAreRefused) {
    const std::string name = "damaged/restart-hdf5-crash.h5.gz";
    if (!support::hasSharedData(name)) GTEST_SKIP() << support::withoutSharedData(name);
    ASSERT_EQ(
        support::run("gunzip -c " + support::sharedData(name).string() + " > " + file.string()).exitCode, 0);
    sealRestartFile(file);  // of the format of today
    EXPECT_GE(expectSentences(), 1);
}

}  // namespace
}  // namespace pendular::damagedFilesTest
