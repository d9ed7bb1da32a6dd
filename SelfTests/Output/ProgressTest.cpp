#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <string>

#include "Kernel/Core/Run/Progress.h"

namespace pendular::progressTest {
namespace {

/// Standard error goes to a terminal of so many columns, as long as it lives.
class Terminal {
public:
    explicit Terminal(unsigned short columns)
        : master(posix_openpt(O_RDWR | O_NOCTTY)), before(dup(STDERR_FILENO)) {
        if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) return;
        slave = open(ptsname(master), O_RDWR | O_NOCTTY);
        winsize size{};
        size.ws_col = columns;
        if (slave < 0 || ioctl(slave, TIOCSWINSZ, &size) != 0) return;
        works = dup2(slave, STDERR_FILENO) >= 0;
    }
    ~Terminal() {
        dup2(before, STDERR_FILENO);
        for (const int file : {master, slave, before}) close(file);
    }
    Terminal(const Terminal&) = delete;
    Terminal& operator=(const Terminal&) = delete;

    std::string text() {
        std::array<char, 4096> buffer{};
        const auto count = read(master, buffer.data(), buffer.size());
        return {buffer.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
    }

    bool works = false;

private:
    int master, slave = -1, before;
};

/// What a run shows on the terminal at a time (s) of 2 s, without the return to the start of the line.
std::string shownAt(double time, unsigned short columns) {
    Terminal terminal(columns);
    if (!terminal.works) return {};
    Progress progress("drum", 2);
    progress.show(time, 1000, [] { return RunNumbers{123456789, 987654321, 1.234e-5}; });
    std::string text = terminal.text();
    EXPECT_EQ(text.substr(0, 1), "\r");
    return text.substr(1);
}

TEST(Progress, fitsTheTerminal) {
    if (!Terminal(80).works) GTEST_SKIP() << "no terminal can be made here";
    for (const unsigned short columns : {20, 80, 200}) {
        const std::string line = shownAt(1, columns);
        EXPECT_EQ(line.size(), columns - 1u) << "it is renewed whole, and does not wrap";
        EXPECT_EQ(line.substr(0, 13), "drum   50.0 %");
        const std::string last = line.substr(0, line.find_last_not_of(' ') + 1);
        EXPECT_TRUE(last.ends_with("%") || last.ends_with(" s") || last.ends_with("left") ||
                    last.ends_with("steps/s") || last.ends_with("contacts") || last.ends_with(" J"))
            << "it ends with a whole number and its unit: " << line;
    }
    EXPECT_EQ(shownAt(1, 12), " 50.0 %    ") << "no room for the name";
    EXPECT_NE(shownAt(1, 80).find(" s left"), std::string::npos);
    EXPECT_NE(shownAt(1, 200).find("1.23e-05 J"), std::string::npos);
}

/// The last step may end beyond the end time.
TEST(Progress, hasNoNegativeTimeLeft) {
    if (!Terminal(80).works) GTEST_SKIP() << "no terminal can be made here";
    EXPECT_EQ(shownAt(2.0000001, 80).find("-0 s"), std::string::npos);
    EXPECT_NE(shownAt(2.0000001, 80).find("  0 s left"), std::string::npos);
}

}  // namespace
}  // namespace pendular::progressTest
