// Work of a child process that reads what others have written: its answers, and how its end is told.
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <string>
#include <vector>

#include "Kernel/Foundation/Files/ReadingProcess.h"

namespace pendular::readingProcessTest {
namespace {

using Channel = ReadingProcess::Channel;

constexpr ReadingProcess::Limits limits{std::size_t{64} << 20, 10};

/// What is told of a child that ends before it has answered.
std::string endOf(const std::function<void()>& work, const ReadingProcess::Limits& most = limits) {
    ReadingProcess process(most, [&](const Channel&) { work(); });
    std::string answer;
    EXPECT_FALSE(process.channel().receiveText(answer, 1));
    return process.howItEnded();
}

TEST(ReadingProcess, answersInItsOrder) {
    ReadingProcess process(limits, [](const Channel& parent) {
        for (std::string word; parent.receiveText(word, 1 << 20);)
            static_cast<void>(parent.sendText(word + word));
    });
    const std::string longWord(1 << 20, 'a');  // longer than the buffer of a connection
    for (const std::string& word : {std::string(), std::string("drum"), longWord}) {
        std::string answer;
        ASSERT_TRUE(process.channel().sendText(word));
        ASSERT_TRUE(process.channel().receiveText(answer, 2 << 20));
        EXPECT_EQ(answer, word + word);
    }
}

TEST(ReadingProcess, aSignalIsASentence) {
    EXPECT_EQ(endOf([] { std::raise(SIGSEGV); }), "was ended by signal 11 (Segmentation fault)");
    EXPECT_EQ(endOf([] { std::raise(SIGABRT); }), "was ended by signal 6 (Aborted)");
    EXPECT_EQ(endOf([] { throw 1; }), "ended with the exit code 4");
}

/// A handler of this program, as that of an interpreter, says nothing of the child.
TEST(ReadingProcess, hasNoHandlerOfThisProgram) {
    const auto before = std::signal(SIGSEGV, [](int) { _exit(7); });
    EXPECT_EQ(endOf([] { std::raise(SIGSEGV); }), "was ended by signal 11 (Segmentation fault)");
    std::signal(SIGSEGV, before);
}

TEST(ReadingProcess, workWithoutEndIsCutOff) {
    volatile bool isEndless = true;
    EXPECT_EQ(endOf(
                  [&] {
                      while (isEndless) {}
                  },
                  {limits.memory, 1}),
              "took more than 1 s of CPU time");
}

TEST(ReadingProcess, memoryIsLimitedAndIsNotOfThisProgram) {
    const auto take = [](std::size_t bytes) {
        const std::vector<char> block(bytes, 'a');
        const volatile char* const seen = block.data();  // or a compiler leaves the memory out
        return seen[bytes - 1];
    };
    if (!ReadingProcess::limitsMemory()) GTEST_SKIP() << "Under the sanitizers memory is not limited.";
    EXPECT_EQ(endOf([&] { take(2 * limits.memory); }), "needed more than 64 MB of memory");
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const long before = used.ru_maxrss;
    ReadingProcess process({std::size_t{600} << 20, 10}, [&](const Channel& parent) {
        const char last = take(std::size_t{400} << 20);
        static_cast<void>(parent.send(&last, 1));
    });
    char last = 0;
    ASSERT_TRUE(process.channel().receive(&last, 1));
    getrusage(RUSAGE_SELF, &used);
    EXPECT_LT(used.ru_maxrss - before, 20 << 10);  // kB; of 400 MB, none
}

/// What the C library says of its heap before it aborts is not for the user.
TEST(ReadingProcess, printsNothing) {
    if (!ReadingProcess::limitsMemory()) GTEST_SKIP() << "The sanitizers print what they find.";
    testing::internal::CaptureStderr();
    const std::string end = endOf([] {
        static_cast<void>(write(STDERR_FILENO, "free(): invalid pointer\n", 24) > 0);
        std::raise(SIGABRT);
    });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(end, "was ended by signal 6 (Aborted)");
}

/// A connection that the child has a copy of would stay open when this program closes it.
TEST(ReadingProcess, closesTheConnectionsOfThisProgram) {
    int ends[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    const ReadingProcess process(limits, [](const Channel& parent) {
        char ready = 1;
        if (parent.send(&ready, 1)) static_cast<void>(parent.receive(&ready, 1));
    });
    char byte = 0;
    ASSERT_TRUE(process.channel().receive(&byte, 1));
    close(ends[1]);
    EXPECT_EQ(recv(ends[0], &byte, 1, MSG_DONTWAIT), 0);  // the end; -1: it is open still
    close(ends[0]);
}

/// Its copy of a pipe is closed long before its work is done.
TEST(ReadingProcess, endsWithThisProgram) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t program = fork();
    if (program == 0) {
        ReadingProcess process(limits, [&](const Channel&) {
            static_cast<void>(write(ends[1], "1", 1) == 1);
            sleep(60);
        });
        close(ends[1]);
        pause();
    }
    close(ends[1]);
    char byte = 0;
    ASSERT_EQ(read(ends[0], &byte, 1), 1);
    kill(program, SIGKILL);
    waitpid(program, nullptr, 0);
    pollfd last{ends[0], POLLIN, 0};
    EXPECT_EQ(poll(&last, 1, 30000), 1);
    EXPECT_EQ(read(ends[0], &byte, 1), 0);  // the end of the pipe
    close(ends[0]);
}

}  // namespace
}  // namespace pendular::readingProcessTest
