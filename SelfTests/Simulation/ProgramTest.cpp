#include "Kernel/Simulation/Program.h"

#include <gtest/gtest.h>

#include <functional>

#include "Kernel/InputError.h"
#include "Kernel/Simulation/Simulation.h"
#include "Kernel/Species/Normal/LinearViscoelastic.h"

namespace pendular {
namespace {

TEST(UncaughtException, endsAProgramWithItsSentence) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    // A function that lets no exception out stands for main(), whose exceptions GoogleTest would catch.
    const auto mainLike = []() noexcept {
        reportUncaughtExceptions();
        SphericalParticle().setRadius(-1);
    };
    EXPECT_EXIT(mainLike(), testing::ExitedWithCode(1),
                "^Error: SphericalParticle: radius = -1 m is out of range; it must be greater than 0 m and "
                "finite\\.\n$");
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

TEST(UncaughtException, becomesAnExitCodeInRunProgram) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(runProgram([] { return 3; }), 3);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    testing::internal::CaptureStderr();
    EXPECT_EQ(runProgram([]() -> int { throw InputError("particle 3: radius = 0 m is out of range."); }), 1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "Error: particle 3: radius = 0 m is out of range.\n");
}

}  // namespace
}  // namespace pendular
