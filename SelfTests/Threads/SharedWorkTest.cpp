#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "Kernel/Foundation/Base/Parallel.h"

// How work is shared by threads.

namespace pendular::sharedWorkTest {
namespace {

void expectEachOnce(std::size_t count, int threads, std::size_t least) {
    std::vector<std::atomic<int>> done(count);
    inParts(
        count, threads,
        [&](int part, std::size_t begin, std::size_t end) {
            EXPECT_GE(part, 0);
            EXPECT_LT(part, threads);
            for (std::size_t k = begin; k < end; ++k) ++done[k];
        },
        least);
    for (const auto& times : done) ASSERT_EQ(times, 1);
}

TEST(Threads, shareAllOfTheWorkOnce) {
    for (const std::size_t count : {0, 1, 2, 7, 1000, 100003})
        for (const int threads : {1, 2, 3, 8, 17})
            for (const std::size_t least : {1, 10, 5000}) expectEachOnce(count, threads, least);
}

TEST(Threads, takeEachShareOnce) {
    for (const std::size_t count : {0, 1, 7, 1000, 100003})
        for (const int threads : {1, 2, 3, 17})
            for (const std::size_t share : {1, 64, 200000}) {
                std::vector<std::atomic<int>> done(count);
                std::vector<std::atomic<int>> busy(static_cast<std::size_t>(threads));
                inShares(
                    count, threads,
                    [&](int part, std::size_t begin, std::size_t end) {
                        auto& isBusy = busy[static_cast<std::size_t>(part)];
                        EXPECT_EQ(isBusy++, 0);  // a part is never done twice at once
                        for (std::size_t k = begin; k < end; ++k) ++done[k];
                        --isBusy;
                    },
                    1, share);
                for (const auto& times : done) ASSERT_EQ(times, 1);
            }
}

TEST(Threads, takeSharesFromBothEnds) {
    OpenShares shares;
    shares.cut(5, 32, 10);
    EXPECT_EQ(shares.takeLast(), OpenShares::Share(25, 32));
    EXPECT_EQ(shares.takeFirst(), OpenShares::Share(5, 15));
    EXPECT_EQ(shares.takeFirst(), OpenShares::Share(15, 25));
    EXPECT_FALSE(shares.takeFirst());
    EXPECT_FALSE(shares.takeLast());
}

// Who has no share of its own left takes the last ones of another: it is the same ones each time.
TEST(Threads, takeFromTheBackWhatOthersHaveLeft) {
    constexpr std::size_t count = 1000, share = 10, half = count / 2;
    for (int repeat = 0; repeat < 20; ++repeat) {
        std::array<std::vector<std::size_t>, 2> taken;
        std::atomic<std::size_t> done = 0;
        inShares(
            count, 2,
            [&](int part, std::size_t begin, std::size_t end) {
                taken.at(static_cast<std::size_t>(part)).push_back(begin);
                done += end - begin;
                while (part == 1 && done < count - share) std::this_thread::yield();
            },
            1, share);
        for (std::size_t part = 0; part < 2; ++part) {
            std::size_t next = part * half, last = count - part * half;
            for (const std::size_t begin : taken.at(part)) {
                const bool isOwn = begin / half == part;
                EXPECT_EQ(begin, isOwn ? next : last - share);
                isOwn ? next += share : last -= share;
            }
        }
    }
}

// One that is held up in its first share, until all others are done, does not hold up those.
TEST(Threads, takeTheSharesOfOneThatIsHeldUp) {
    constexpr std::size_t count = 1000, share = 10;
    std::atomic<std::size_t> done = 0;
    std::atomic<bool> isOneHeld = false;
    inShares(
        count, 3,
        [&](int part, std::size_t begin, std::size_t end) {
            if (part > 0 && !isOneHeld.exchange(true))
                while (done < count - share) std::this_thread::yield();
            done += end - begin;
        },
        1, share);
    EXPECT_EQ(done, count);
}

TEST(Threads, areReallySeveral) {
    std::atomic<int> met = 0;
    inParts(3, 3, [&](int, std::size_t, std::size_t) {
        ++met;
        while (met < 3) std::this_thread::yield();  // each waits for the others
    });
    EXPECT_EQ(met, 3);
}

// Parts begin at 0, 33 and 66: whichever thread has the share, and whenever.
TEST(Threads, throwOnWhatTheFirstShareThrewThatFails) {
    for (int repeat = 0; repeat < 100; ++repeat) {
        std::atomic<std::size_t> done = 0;
        try {
            inShares(
                100, 3,
                [&](int, std::size_t begin, std::size_t end) {
                    done += end - begin;
                    if (begin >= 43) throw std::runtime_error(std::to_string(begin));
                },
                1, 10);
            FAIL() << "nothing was thrown";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "43");
        }
        EXPECT_EQ(done, 100u);
    }
}

TEST(Threads, throwTheFirstFailureWhenAllHaveEnded) {
    for (int repeat = 0; repeat < 100; ++repeat) {
        std::atomic<int> ended = 0;
        try {
            inParts(5, 5, [&](int part, std::size_t, std::size_t) {
                ++ended;
                if (part == 2 || part == 4) throw std::runtime_error(std::to_string(part));
            });
            FAIL() << "nothing was thrown";
        } catch (const std::runtime_error& error) {
            EXPECT_STREQ(error.what(), "2");
        }
        EXPECT_EQ(ended, 5);
    }
}

TEST(Threads, workWithinWorkAndBesideOtherWorkIsDone) {
    std::atomic<std::size_t> sum = 0;
    const auto add = [&](int, std::size_t begin, std::size_t end) { sum += end - begin; };
    inParts(4, 4, [&](int, std::size_t, std::size_t) { inParts(100, 3, add); });
    EXPECT_EQ(sum, 400u);
    sum = 0;
    std::vector<std::thread> others;
    for (int k = 0; k < 4; ++k)
        others.emplace_back([&] {
            for (int repeat = 0; repeat < 200; ++repeat) inParts(10, 2, add);
        });
    for (std::thread& other : others) other.join();
    EXPECT_EQ(sum, 8000u);
}

TEST(Threads, aCopyOfTheProcessHasItsOwn) {
    expectEachOnce(100, 3, 1);
    const pid_t child = fork();
    if (child == 0) {
        std::atomic<std::size_t> sum = 0;
        inParts(100, 3, [&](int, std::size_t begin, std::size_t end) { sum += end - begin; });
        _exit(sum == 100 ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    expectEachOnce(100, 3, 1);
}

// Many more threads than processors, and many short calls: each has to end, however threads are scheduled.
TEST(Threads, thatOutnumberTheProcessorsDoNotCollapse) {
    std::atomic<std::size_t> sum = 0;
    for (int repeat = 0; repeat < 2000; ++repeat)
        inParts(20, 20, [&](int, std::size_t begin, std::size_t end) { sum += end - begin; });
    EXPECT_EQ(sum, 40000u);
}

// The last test: those that rest would not do their parts in others.
// One that stops for much longer than its work is worth does not hold up the others again at once.
TEST(Threads, doNotWaitAgainForOneThatHasStopped) {
    unsetenv("PENDULAR_SHARE_SMALL_WORK");
    if (sharesSmallWork()) GTEST_SKIP() << "PENDULAR_SHARE_SMALL_WORK was set when this process began";
    if (processorCount() < 2) GTEST_SKIP() << "threads that share a processor do not rest";
    constexpr std::size_t count = 1000, share = 10;
    std::atomic<int> calls = 0;
    // Tests before this one have asked more threads, which do not rest; after some hundred calls that is
    // forgotten.
    for (int repeat = 0; repeat < 600; ++repeat) inParts(2, 2, [](int, std::size_t, std::size_t) {});
    // A rest that this thread has slept through leaves the next one twice as long.
    for (int repeat = 0; repeat < 20 && calls != 1; ++repeat) {
        std::atomic<bool> hasBegun = false;
        inParts(2, 2, [&](int part, std::size_t, std::size_t) {
            if (part == 1) {
                hasBegun = true;
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
            } else {
                for (int look = 0; look < 200 && !hasBegun; ++look)
                    std::this_thread::sleep_for(std::chrono::microseconds(50));
            }
        });
        calls = 0;
        std::atomic<std::size_t> done = 0;
        inShares(
            count, 2, [&](int, std::size_t begin, std::size_t end) { ++calls, done += end - begin; }, 1,
            share);
        EXPECT_EQ(done, count);
    }
    EXPECT_EQ(calls, 1);  // all shares at once, by this thread
}

}  // namespace
}  // namespace pendular::sharedWorkTest
