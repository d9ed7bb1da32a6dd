// Runs that are killed at any moment, also while they write, leave a whole state.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "SelfTests/Restart/ChildRun.h"

namespace pendular::killedRunTest {
namespace {

using namespace support;

/// The run is killed and started again until it has been killed 250 times, in several rounds: whenever it
/// comes to its end it is compared and starts again. Restart files are written after every step, so that
/// about half of the kills meet a file that is not complete. On a busy machine many runs are killed before
/// they have done anything: there are more kills then, until enough of them have met what they are for.
TEST(HeavyKilledRun, leavesAWholeStateThatGoesOnToTheSameOne) {
    constexpr std::size_t steps = 60;
    const TestFolder folder;
    const auto whole = folder.path() / "whole", killed = folder.path() / "killed";
    runUndisturbed(whole, steps);
    const auto start = [&] {
        return Child(killed, [&] {
            KeptRun run(killed, steps);
            run.setRestartCount(1);
            run.solve();
        });
    };
    UniformRandom random(1);
    int kills = 0, whileWriting = 0, goneOn = 0, ended = 0;
    const auto isEnough = [&] { return kills >= 250 && whileWriting > 20 && goneOn > 100; };
    while (!isEnough() && kills < 3000) {
        const bool goesOn = std::filesystem::exists(killed / "run-restart.h5");
        const Child child = start();
        std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(random.uniform(0, 50000))));
        child.send(SIGKILL);
        const int code = child.wait();
        if (code == 0) {
            ++ended;
            expectSameRun(whole, killed);
            std::filesystem::remove_all(killed);
            continue;
        }
        ASSERT_EQ(code, -SIGKILL) << contentOf(killed / "printed");
        ++kills;
        goneOn += goesOn ? 1 : 0;
        whileWriting += std::filesystem::exists(killed / "run-restart.h5.part") ? 1 : 0;
        if (std::filesystem::exists(killed / "run-restart.h5")) checkRestartFile(killed / "run-restart.h5");
    }
    ASSERT_EQ(start().wait(), 0) << contentOf(killed / "printed");
    expectSameRun(whole, killed);
    EXPECT_GT(whileWriting, 20);
    EXPECT_GT(goneOn, 100);
    fmt::print(
        "{} kills, {} of them while a restart file was written, {} of runs that had gone on, {} runs came "
        "to their end\n",
        kills, whileWriting, goneOn, ended);
}

}  // namespace
}  // namespace pendular::killedRunTest
