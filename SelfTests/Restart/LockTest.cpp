// Two processes that write into each other's files: the second one is refused, and the first one is as if it
// had been alone.
#include <sys/stat.h>

#include "Kernel/Foundation/Files/FileLock.h"
#include "Kernel/Foundation/Files/SetAside.h"
#include "Kernel/Foundation/Files/WrittenBeside.h"
#include "SelfTests/Restart/ChildRun.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::lockTest {
namespace {

using namespace support;

TEST(FileLock, isOfOneOnly) {
    const TestFolder folder;
    const auto file = folder.path() / "new" / ".lock";
    const auto take = [&] { FileLock(file, "The folder is", "take another one"); };
    {
        const FileLock first(file, "The folder is", "take another one");
        const std::string text = refusal(take);
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(
            contains(text, fmt::format("The folder is in use by another run (process {}): wait for its "
                                       "end, or take another one.",
                                       getpid())));
    }
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_EQ(refusal(take), "");
    // What a killed process leaves.
    std::ofstream(file) << "123456";
    EXPECT_EQ(refusal(take), "");
    // A copy of the process that ends does not end it.
    const FileLock first(file, "The folder is", "take another one");
    const Child copy(folder.path(), [] {});
    EXPECT_EQ(copy.wait(), 0);
    EXPECT_TRUE(std::filesystem::exists(file));
    EXPECT_NE(refusal(take), "");
}

// As a process that reads a file for a run that is killed.
TEST(FileLock, waitsForACopyOfAnOwnerThatIsGone) {
    const TestFolder folder;
    const auto file = folder.path() / ".lock", ready = folder.path() / "ready";
    const Child owner(folder.path(), [&] {
        const FileLock lock(file, "The folder is", "take another one");
        if (fork() == 0) {
            std::ofstream(ready).flush();
            usleep(300000);
            _exit(0);
        }
        pause();
    });
    ASSERT_TRUE(waitUntil([&] { return std::filesystem::exists(ready); }));
    owner.send(SIGKILL);
    EXPECT_EQ(owner.wait(), -SIGKILL);
    EXPECT_EQ(refusal([&] { FileLock(file, "The folder is", "take another one"); }), "");
}

TEST(FileLock, ofWhatIsNoFileIsRefused) {
    const TestFolder folder;
    const auto pipe = folder.path() / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (const auto& path : {pipe, folder.path()}) {
        const std::string text = refusal([&] { FileLock(path, "The folder is", "take another one"); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, path.string() + " is not a regular file"));
    }
    // A link to another file, which is left as it is.
    const auto link = folder.path() / "link", precious = folder.path() / "precious";
    std::ofstream(precious) << "content";
    std::filesystem::create_symlink(precious, link);
    EXPECT_TRUE(contains(refusal([&] { FileLock(link, "The folder is", "take another one"); }),
                         "link is a symbolic link; remove it."));
    EXPECT_EQ(contentOf(precious), "content");
    EXPECT_TRUE(contains(refusal([] { FileLock("/proc/none/lock", "It is", "go"); }), "cannot be written"));
    EXPECT_EQ(refusal([] { FileLock("/proc/none/lock", "It is", "go", false); }), "");
}

/// A run that has begun waits after its tenth step, until it is told to go on.
class TwoRuns : public testing::Test {
protected:
    static constexpr std::size_t wholeRun = 60;  // steps

    class Waiting : public KeptRun {
    public:
        explicit Waiting(const std::filesystem::path& of) : KeptRun(of, wholeRun), folder(of) {}
        void actionsAfterTimeStep() override {
            if (getNumberOfTimeSteps() != 10) return;
            std::ofstream(folder / "waiting").flush();
            EXPECT_TRUE(waitUntil([&] { return std::filesystem::exists(folder / "go-on"); }));
        }

    private:
        std::filesystem::path folder;
    };

    [[nodiscard]] Child startFirst() const {
        std::filesystem::remove(one / "waiting");
        const Child child(one, [&] { Waiting(one).solve(); });
        EXPECT_TRUE(waitUntil([&] { return std::filesystem::exists(one / "waiting"); }));
        return child;
    }
    /// The sentence with which another process is refused here.
    [[nodiscard]] std::string refusalOfSecond() const {
        const auto printed = folder.path() / "second";
        const Child second(printed, [&] { KeptRun(one, wholeRun).solve(); });
        EXPECT_EQ(second.wait(), 1);
        return contentOf(printed / "printed");
    }

    const TestFolder folder;
    const std::filesystem::path one = folder.path() / "one", whole = folder.path() / "whole";
};

TEST_F(TwoRuns, ofOneNameAreRefused) {
    const Child first = startFirst();
    // It would go on from the restart file of the first one.
    const std::string text = refusalOfSecond();
    EXPECT_TRUE(contains(text, "run-* are in use by another run (process "));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    std::ofstream(one / "go-on").flush();
    EXPECT_EQ(first.wait(), 0);
    EXPECT_FALSE(std::filesystem::exists(one / "run.pendular-lock"));
    runUndisturbed(whole, wholeRun);
    expectSameRun(whole, one);
}

/// One that is killed leaves no lock; the run that goes on has it again.
TEST_F(TwoRuns, areRefusedAlsoWhereTheFirstGoesOnFromAKilledOne) {
    const Child killed = startFirst();
    killed.send(SIGKILL);
    EXPECT_EQ(killed.wait(), -SIGKILL);
    EXPECT_TRUE(std::filesystem::exists(one / "run.pendular-lock"));
    const Child first = startFirst();
    EXPECT_TRUE(contains(refusalOfSecond(), "run-* are in use by another run (process "));
    std::ofstream(one / "go-on").flush();
    EXPECT_EQ(first.wait(), 0);
    runUndisturbed(whole, wholeRun);
    expectSameRun(whole, one);
}

// ---- Files that are set aside

TEST(SetAside, getsItsNamesAgainUnlessItIsRemoved) {
    const TestFolder folder;
    const auto a = folder.path() / "a", b = folder.path() / "b", none = folder.path() / "none";
    std::ofstream(a) << "of before";
    std::ofstream(b) << "of before";
    {
        const SetAside aside({a, b, none});
        EXPECT_FALSE(std::filesystem::exists(a));
        EXPECT_EQ(contentOf(folder.path() / "a.before"), "of before");
        std::ofstream(b) << "new";
    }
    EXPECT_EQ(contentOf(a), "of before");
    EXPECT_EQ(contentOf(b), "new");
    const auto earlier = folder.path() / "none.before";  // of a process that was killed
    std::ofstream(earlier) << "its only copy";
    {
        SetAside aside({a, b, none});
        aside.remove();
    }
    EXPECT_EQ(contentOf(earlier), "its only copy");
    std::filesystem::remove(earlier);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    std::filesystem::create_directory(a);
    EXPECT_TRUE(contains(refusal([&] { SetAside({a}); }), "is not a regular file"));
}

/// A pipe in the place of a file would hold the program up for ever.
TEST(FileThatIsAPipe, isRefused) {
    const TestFolder folder;
    const auto file = folder.path() / "table.csv", part = folder.path() / "table.csv.part";
    ASSERT_EQ(mkfifo(part.c_str(), 0600), 0);
    for (const std::string& text :
         {refusal([&] { WrittenBeside whole(file); }), refusal([&] { WrittenBeside goesOn(file, 3); }),
          refusal([&] { static_cast<void>(partOrWhole(file)); })}) {
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "table.csv.part is not a regular file"));
    }
    if (!Hdf5File::isAvailable())
        GTEST_SKIP() << "This build has no HDF5 library: HDF5 files are not tested.";
    EXPECT_TRUE(contains(refusal([&] { Hdf5File(part, Hdf5File::Access::Read); }), "is not a regular file"));
    EXPECT_TRUE(
        contains(refusal([&] { Hdf5File(folder.path(), Hdf5File::Access::Read); }), "is not a regular file"));
    EXPECT_TRUE(contains(refusal([&] { writeRestartFile(file, [](StateArchive&) {}); }),
                         "table.csv.part is not a regular file"));
    EXPECT_TRUE(std::filesystem::is_fifo(part));
}

}  // namespace
}  // namespace pendular::lockTest
