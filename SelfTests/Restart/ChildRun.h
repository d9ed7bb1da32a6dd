#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::support {

/// A run of wet grains that keeps a table and a restart file in a folder, and goes on where one left off.
class KeptRun : public scenes::SettlingBox<Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>> {
public:
    KeptRun(const std::filesystem::path& folder, std::size_t steps)
        : SettlingBox(2), table(folder / "table.csv", "time_s,height_m") {
        setName((folder / "run").string());
        setTimeMax(static_cast<double>(steps) * getTimeStep());
        setSaveCount(7);
        keepRestartFile();
        if (std::filesystem::exists(restartFile())) restartFrom(restartFile());
    }
    void writeOutput() override { table.row(getTime(), particleHandler.getObject(3).getPosition().z()); }
    void completeOutput() override { table.close(); }
    void visitState(StateArchive& archive) override { table.visitState(archive); }

private:
    RunTable table;
};

/// A process of its own that runs a body as a program does. What it prints is in the file "printed" of the
/// folder.
class Child {
public:
    template <class Body>
    Child(const std::filesystem::path& folder, Body&& body) {
        std::filesystem::create_directories(folder);
        id = fork();
        if (id != 0) return;
        static_cast<void>(std::freopen((folder / "printed").c_str(), "w", stderr));
        const int code = runProgram([&] {
            body();
            return 0;
        });
        std::fflush(nullptr);
        _exit(code);
    }
    void send(int signal) const { kill(id, signal); }
    /// Waits for its end; the exit code, or minus the signal that has ended it.
    int wait() const {
        int status = 0;
        waitpid(id, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

private:
    pid_t id;
};

/// Waits until the condition holds, a minute at most.
template <class Condition>
::testing::AssertionResult waitUntil(Condition&& condition) {
    for (int k = 0; k < 60000; ++k) {
        if (condition()) return ::testing::AssertionSuccess();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return ::testing::AssertionFailure() << "a minute has passed";
}

/// What a run that nothing disturbed leaves in a folder.
inline void runUndisturbed(const std::filesystem::path& folder, std::size_t steps) {
    KeptRun(folder, steps).solve();
}

inline void expectSameRun(const std::filesystem::path& a, const std::filesystem::path& b) {
    EXPECT_EQ(contentOf(a / "table.csv"), contentOf(b / "table.csv"));
    expectSameState(a / "run-restart.h5", b / "run-restart.h5");
}

}  // namespace pendular::support
