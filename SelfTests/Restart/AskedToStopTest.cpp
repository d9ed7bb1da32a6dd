// Runs that are asked to stop, or whose disk is full: their files are complete, and a restart goes on as if
// nothing had been.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <sstream>
#include <string>

#include "SelfTests/Restart/ChildRun.h"

namespace pendular::askedToStopTest {
namespace {

using namespace support;

constexpr std::size_t wholeRun = 400;  // steps

/// A run that waits after a step, until it is to go on.
class WaitingRun : public KeptRun {
public:
    WaitingRun(const std::filesystem::path& folder, std::size_t stepOfWaiting)
        : KeptRun(folder, wholeRun),
          waitAt(stepOfWaiting),
          here(folder / "waiting"),
          goOn(folder / "go-on") {}
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() != waitAt) return;
        std::ofstream(here).flush();
        EXPECT_TRUE(waitUntil([&] { return std::filesystem::exists(goOn); }));
    }

private:
    std::size_t waitAt;
    std::filesystem::path here, goOn;
};

class AskedToStop : public testing::Test {
protected:
    const TestFolder folder;
    const std::filesystem::path whole = folder.path() / "whole", part = folder.path() / "part";

    void waitForChild() const {
        ASSERT_TRUE(waitUntil([&] { return std::filesystem::exists(part / "waiting"); }));
    }
    void letGoOn() const { std::ofstream(part / "go-on").flush(); }
    std::string printed() const { return contentOf(part / "printed"); }

    /// The table and the restart file are complete and at this step, and the run goes on from them.
    void expectCompleteAt(std::size_t step) {
        EXPECT_FALSE(std::filesystem::exists(part / "table.csv.part"));
        EXPECT_FALSE(std::filesystem::exists(part / "run-restart.h5.part"));
        const std::string table = contentOf(part / "table.csv");
        const auto lastRow = table.rfind('\n', table.size() - 2) + 1;
        EXPECT_EQ(std::stod(table.substr(lastRow)), static_cast<double>(step) * 0x1p-17);
        KeptRun again(part, wholeRun);
        again.initialise();
        EXPECT_EQ(again.getNumberOfTimeSteps(), step);
    }
    void expectGoesOnAsIfNothingHadBeen() {
        EXPECT_EQ(Child(part, [&] { KeptRun(part, wholeRun).solve(); }).wait(), 0) << printed();
        runUndisturbed(whole, wholeRun);
        expectSameRun(whole, part);
    }
};

/// At a step at which output is due (a multiple of 7), and at one at which it is not.
TEST_F(AskedToStop, completesItsFilesAtOneTime) {
    for (const auto& [signal, code, at] :
         {std::tuple{SIGINT, 130, std::size_t{140}}, std::tuple{SIGTERM, 143, std::size_t{150}}}) {
        std::filesystem::remove_all(part);
        const Child child(part, [&, at = at] { WaitingRun(part, at).solve(); });
        waitForChild();
        child.send(signal);
        letGoOn();
        EXPECT_EQ(child.wait(), code);
        EXPECT_NE(printed().find(
                      fmt::format("after {} steps; restart from {}", at, (part / "run-restart.h5").string())),
                  std::string::npos)
            << printed();
        // The check opens the table again: on a copy.
        std::filesystem::copy(part, folder.path() / "copy");
        expectCompleteAt(at);
        std::filesystem::remove_all(part);
        std::filesystem::rename(folder.path() / "copy", part);
        expectGoesOnAsIfNothingHadBeen();
    }
}

/// timeout(1) sends SIGTERM to its child, and at once to the group of processes that the child is in.
TEST_F(AskedToStop, twiceWithinASecondIsAskedOnce) {
    const Child child(part, [&] { WaitingRun(part, 20).solve(); });
    waitForChild();
    child.send(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // two signals at once may be one
    child.send(SIGTERM);
    letGoOn();
    EXPECT_EQ(child.wait(), 143) << printed();
    expectGoesOnAsIfNothingHadBeen();
}

/// The second of them may come when the run has ended, while the program completes what it has to.
TEST_F(AskedToStop, twiceWithinASecondIsAskedOnceAlsoAfterTheRun) {
    const Child child(part, [&] {
        try {
            WaitingRun(part, 20).solve();
        } catch (const RunStopped&) {
            std::raise(SIGTERM);
            throw;
        }
    });
    waitForChild();
    child.send(SIGTERM);
    letGoOn();
    EXPECT_EQ(child.wait(), 143) << printed();
    EXPECT_NE(printed().find("SIGTERM has stopped the run"), std::string::npos) << printed();
}

TEST_F(AskedToStop, aSecondTimeEndsAtOnce) {
    for (const auto& [first, second] : {std::pair{SIGINT, SIGINT}, std::pair{SIGTERM, SIGINT}}) {
        std::filesystem::remove_all(part);
        const Child child(part, [&] { WaitingRun(part, 20).solve(); });
        waitForChild();
        child.send(first);
        std::this_thread::sleep_for(std::chrono::milliseconds(1050));  // within a second they are one
        child.send(second);
        EXPECT_EQ(child.wait(), -second);
    }
}

/// SIGINT is ignored in a job in the background, by its parent: it stays so also after SIGTERM.
TEST_F(AskedToStop, aSecondTimeByAnIgnoredSignalGoesOn) {
    const Child child(part, [&] {
        std::signal(SIGINT, SIG_IGN);
        WaitingRun(part, 20).solve();
    });
    waitForChild();
    child.send(SIGTERM);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    child.send(SIGINT);
    letGoOn();
    EXPECT_EQ(child.wait(), 143);
}

/// The clock is looked at after the first step also where a run goes on from a late one.
TEST(RunControl, hearsTheClockOfARunThatGoesOn) {
    constexpr std::size_t first = 10'000'000;
    RunControl control({.kept = true, .interval = 0.01});
    EXPECT_EQ(control.request(first), RunControl::Request::None);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(control.request(first + 1), RunControl::Request::WriteRestart);
}

TEST_F(AskedToStop, byTheWallClockDoesAsOnSigterm) {
    const Child child(part, [&] {
        setWallTimeLimit(1e-6);
        KeptRun(part, wholeRun).solve();
    });
    EXPECT_EQ(child.wait(), 143);
    EXPECT_NE(printed().find("the limit of 1e-06 s of wall time has stopped the run at time 0 s"),
              std::string::npos)
        << printed();
    expectGoesOnAsIfNothingHadBeen();
}

TEST_F(AskedToStop, forARestartFileOnlyWritesItAndGoesOn) {
    const Child child(part, [&] { WaitingRun(part, 100).solve(); });
    waitForChild();
    child.send(SIGUSR1);
    letGoOn();
    EXPECT_EQ(child.wait(), 0) << printed();
    runUndisturbed(whole, wholeRun);
    expectSameRun(whole, part);
}

TEST_F(AskedToStop, writesARestartFileOnSigusr1AtOnce) {
    const Child child(part, [&] {
        struct WaitsTwice : WaitingRun {
            using WaitingRun::WaitingRun;
            void actionsBeforeTimeStep() override {
                if (getNumberOfTimeSteps() == 101) std::this_thread::sleep_for(std::chrono::minutes(1));
            }
        } run(part, 100);
        run.solve();
    });
    waitForChild();
    const std::string atBegin = contentOf(part / "run-restart.h5");
    child.send(SIGUSR1);
    letGoOn();
    // After step 100, or, where the child was slow to hear it, 101.
    EXPECT_TRUE(waitUntil([&] { return contentOf(part / "run-restart.h5") != atBegin; }));
    child.send(SIGKILL);
    EXPECT_EQ(child.wait(), -SIGKILL);
    expectGoesOnAsIfNothingHadBeen();
}

/// Between the start of the program and that of the run the signal ends neither: the run writes the file at
/// once.
TEST_F(AskedToStop, forARestartFileBeforeTheRunBeginsGetsIt) {
    const Child child(part, [&] {
        std::raise(SIGUSR1);
        WaitingRun(part, 1).solve();
    });
    waitForChild();
    EXPECT_TRUE(std::filesystem::exists(part / "run-restart.h5"));
    letGoOn();
    EXPECT_EQ(child.wait(), 0) << printed();
    runUndisturbed(whole, wholeRun);
    expectSameRun(whole, part);
}

/// Sent while the system loads the program: where it is blocked then, it waits until it can be heard.
TEST_F(AskedToStop, forARestartFileBeforeTheProgramBeginsIsHeard) {
    const Child child(part, [&] {
        sigset_t blocked;
        sigemptyset(&blocked);
        sigaddset(&blocked, SIGUSR1);
        std::signal(SIGUSR1, SIG_DFL);
        sigprocmask(SIG_BLOCK, &blocked, nullptr);
        std::raise(SIGUSR1);
        hearRestartSignal();  // as every program of ours does at its start
        KeptRun run(part, 3);
        run.keepRestartFile(false);
        run.setQuiet();
        run.solve();
    });
    EXPECT_EQ(child.wait(), 0);
    EXPECT_EQ(printed(), "SIGUSR1: this run keeps no restart file.\n");
}

/// A limit of the size of files stands for a full disk: both make a write fail, for the one with EFBIG, for
/// the other with ENOSPC.
void limitFiles(std::uintmax_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
}

/// Lines of a text, but for those that warn of the scene's overlaps.
std::size_t linesBesideWarnings(const std::string& text) {
    std::istringstream lines(text);
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line);) count += line.starts_with("Warning: ") ? 0 : 1;
    return count;
}

TEST_F(AskedToStop, byAFullDiskKeepsTheLastCompleteFile) {
    // The file of step 100 may be some per cent smaller than that of step 70.
    for (const double share : {0.0, 0.02, 0.5, 0.9}) {
        std::filesystem::remove_all(part);
        runUndisturbed(part, 70);
        const std::string before = contentOf(part / "run-restart.h5");
        const Child child(part, [&] {
            limitFiles(static_cast<std::uintmax_t>(share * static_cast<double>(before.size())) + 2000);
            KeptRun run(part, 120);
            run.setRestartCount(100);
            run.solve();
        });
        EXPECT_EQ(child.wait(), 1) << share;
        EXPECT_NE(printed().find("File too large; the restart file of before is kept.\n"), std::string::npos)
            << printed();
        const std::string lines = printed();
        EXPECT_EQ(linesBesideWarnings(lines), 1u) << lines;
        EXPECT_TRUE(contentOf(part / "run-restart.h5") == before) << share;
        EXPECT_FALSE(std::filesystem::exists(part / "run-restart.h5.part"));
    }
    expectGoesOnAsIfNothingHadBeen();
}

/// A run that begins where another one was has not lost the other's restart file when it cannot write its
/// own.
TEST_F(AskedToStop, byAFullDiskAtItsBeginningKeepsTheFileOfTheRunBefore) {
    runUndisturbed(part, 70);
    runUndisturbed(whole, 0);
    const std::string before = contentOf(part / "run-restart.h5");
    const auto first = static_cast<double>(std::filesystem::file_size(whole / "run-restart.h5"));
    for (const double share : {0.02, 0.5, 0.99}) {
        const Child child(part, [&] {
            limitFiles(static_cast<std::uintmax_t>(share * first));
            KeptRun run(part, 120);
            run.restartFrom({});  // begins
            run.setQuiet();
            run.solve();
        });
        EXPECT_EQ(child.wait(), 1) << share;
        EXPECT_NE(printed().find("File too large.\n"), std::string::npos) << printed();
        EXPECT_TRUE(contentOf(part / "run-restart.h5") == before) << share;
        for (const char* left : {"run-restart.h5.part", "run-restart.h5.before", "run.pendular-lock"})
            EXPECT_FALSE(std::filesystem::exists(part / left)) << left;
    }
}

/// A full disk indeed: a file system in memory, with room for the files there are and a part of the next.
/// Only this process sees it; it is gone when the process ends.
bool mountSmallDisk(const std::filesystem::path& folder, std::uintmax_t bytes) {
    return unshare(CLONE_NEWNS) == 0 && mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           mount("tmpfs", folder.c_str(), "tmpfs", 0, fmt::format("size={}", bytes).c_str()) == 0;
}

TEST_F(AskedToStop, byASmallFileSystemKeepsTheLastCompleteFiles) {
    constexpr int notAllowed = 77;
    const auto before = folder.path() / "before", left = folder.path() / "left";
    runUndisturbed(before, 70);
    const std::string good = contentOf(before / "run-restart.h5");
    // What the file system has besides the files there are, as a share of the restart file; four pages are
    // for the table and for itself.
    for (const double room : {0.0, 0.02, 0.5, 0.8}) {
        std::filesystem::remove_all(part);
        std::filesystem::remove_all(left);
        const auto bytes = static_cast<std::uintmax_t>((1 + room) * static_cast<double>(good.size())) + 16384;
        const Child child(part, [&] {
            if (!mountSmallDisk(part, bytes)) _exit(notAllowed);
            std::filesystem::copy(before, part);
            try {
                KeptRun run(part, 120);
                run.setRestartCount(100);
                run.solve();
            } catch (...) {
                std::filesystem::copy(part, left);
                throw;
            }
        });
        const int code = child.wait();
        if (code == notAllowed)
            GTEST_SKIP() << "This user may not mount a file system: a full disk is tested by a limit only.";
        EXPECT_EQ(code, 1) << room;
        const std::string lines = printed();
        EXPECT_NE(lines.find("No space left on device; the restart file of before is kept.\n"),
                  std::string::npos)
            << lines;
        EXPECT_EQ(linesBesideWarnings(lines), 1u) << lines;
        EXPECT_TRUE(contentOf(left / "run-restart.h5") == good) << room;
        EXPECT_FALSE(std::filesystem::exists(left / "run-restart.h5.part"));
    }
    std::filesystem::remove_all(part);
    std::filesystem::rename(left, part);
    expectGoesOnAsIfNothingHadBeen();
}

TEST_F(AskedToStop, byATableThatCannotGrowSaysSo) {
    const Child child(part, [&] {
        limitFiles(300);
        KeptRun run(part, wholeRun);
        run.keepRestartFile(false);
        run.solve();
    });
    EXPECT_EQ(child.wait(), 1);
    EXPECT_NE(printed().find("table.csv cannot be completed: File too large"), std::string::npos)
        << printed();
}

}  // namespace
}  // namespace pendular::askedToStopTest
