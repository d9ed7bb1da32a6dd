#include "Kernel/Core/Run/Program.h"

#include <gtest/gtest.h>

#include <csignal>
#include <functional>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::programTest {
namespace {

TEST(UncaughtException, endsAProgramWithItsSentence) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    // A function that lets no exception out stands for main(), whose exceptions GoogleTest would catch.
    const auto mainLike = []() noexcept {
        reportUncaughtExceptions();
        SphericalParticle().setRadius(-1);
    };
    EXPECT_EXIT(mainLike(), testing::ExitedWithCode(1),
                "^Error: SphericalParticle: radius = -1 m is out of range; it must be at least 1e-12 m and "
                "at most 1000000000 m\\.\n$");
    const auto oddity = []() noexcept {
        reportUncaughtExceptions();
        const std::function<void()> body = [] { throw 7; };
        body();
    };
    EXPECT_EXIT(oddity(), testing::ExitedWithCode(1), "^Error: [^\n]*\\.\n$");
    const auto withScene = []() noexcept {  // a driver needs no call of its own
        Simulation<Species<LinearViscoelastic>> scene;
        scene.setTimeStep(-1);
    };
    EXPECT_EXIT(withScene(), testing::ExitedWithCode(1), "^Error: Simulation: time step = -1 s [^\n]*\\.\n$");
}

/// A batch system may send it at any time after the program's start.
TEST(Program, isNotEndedBySigusr1BeforeItHasARun) {
    struct sigaction now {};
    sigaction(SIGUSR1, nullptr, &now);
    EXPECT_NE(now.sa_handler, SIG_DFL);
    std::raise(SIGUSR1);
}

/// The first scene has set signals and the end of the program already.
TEST(Program, becomesNoHostAfterItsFirstScene) {
    { const Simulation<Species<LinearViscoelastic>> scene; }
    const std::string text = support::refusal([] { setHosted(); });
    EXPECT_TRUE(support::isOneSentence(text));
    EXPECT_TRUE(support::contains(text, "call it before the first one"));
}

TEST(Logger, showsLinesUpToItsLevel) {
    Simulation<Species<LinearViscoelastic>> scene;
    const auto logged = [&] {
        testing::internal::CaptureStderr();
        scene.logger(LogLevel::Warn, "{} of {}", 1, 3);
        scene.logger(LogLevel::Info, "two");
        scene.logger(LogLevel::Debug, "{:.2f}", 3.0);
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(logged(), "Warning: 1 of 3\ntwo\n");
    scene.logger.setLevel(LogLevel::Warn);
    EXPECT_EQ(logged(), "Warning: 1 of 3\n");
    scene.logger.setLevel(LogLevel::Debug);
    EXPECT_EQ(logged(), "Warning: 1 of 3\ntwo\n3.00\n");
    scene.setQuiet();
    EXPECT_EQ(logged(), "");
    scene.setQuiet(false);
    scene.logger.setLevel(LogLevel::None);
    EXPECT_EQ(logged(), "");
}

TEST(UncaughtException, becomesAnExitCodeInRunProgram) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(runProgram([] { return 3; }), 3);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    testing::internal::CaptureStderr();
    EXPECT_EQ(runProgram([]() -> int { throw InputError("particle 3: radius = 0 m is out of range."); }), 1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "Error: particle 3: radius = 0 m is out of range.\n");
}

}  // namespace
}  // namespace pendular::programTest
