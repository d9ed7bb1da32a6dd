// A program that is not Pendular's own keeps its signals and its end, and gets the log where it wants it.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "Kernel/Core/Run/Program.h"
#include "Kernel/Core/Run/Progress.h"
#include "Kernel/Core/Run/RunControl.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

#ifdef PENDULAR_HAS_HDF5
    #include <hdf5.h>
#endif

namespace pendular::hostTest {
namespace {

using support::contains;
using support::TestFolder;

using Box = scenes::SettlingBox<HertzianViscoelasticMindlinSpecies>;
using Handler = void (*)(int);

Handler handlerOf(int signal) {
    struct sigaction now {};
    sigaction(signal, nullptr, &now);
    return now.sa_handler;
}

void ofTheHost(int) {}
[[noreturn]] void endOfTheHost() { std::abort(); }

/// Calls what a host calls, before any scene of this program.
struct Host {
    Host() {
        setHosted();
        std::signal(SIGINT, ofTheHost);
        std::set_terminate(endOfTheHost);
    }
} const host;

class HostedRun : public Box {
public:
    explicit HostedRun(const TestFolder& folder) : Box(1) {
        setName(folder.name());
        setTimeMax(50 * getTimeStep());
        if (Hdf5File::isAvailable()) keepRestartFile();
    }
    void actionsAfterTimeStep() override {
        logger(LogLevel::Warn, "step {}", getNumberOfTimeSteps());
        if (watch) watch();
    }
    std::function<void()> watch;
};

TEST(Host, keepsItsSignalsAndItsEnd) {
    const TestFolder folder;
    // What the start of a program does before it says that it is a host.
    hearRestartSignal();
    EXPECT_NE(handlerOf(SIGUSR1), SIG_DFL);
    forgetRestartSignal();
    const auto check = [] {
        EXPECT_EQ(handlerOf(SIGINT), ofTheHost);
        for (const int signal : {SIGTERM, SIGUSR1, SIGPIPE}) EXPECT_EQ(handlerOf(signal), SIG_DFL) << signal;
        EXPECT_EQ(std::get_terminate(), endOfTheHost);
    };
    HostedRun scene(folder);
    scene.setQuiet();
    scene.watch = check;
    scene.solve();
    check();
    EXPECT_TRUE(isHosted());
    EXPECT_EQ(support::refusal([] { setHosted(); }), "") << "twice is no harm";
}

/// A scene is stopped by its own call only.
TEST(Host, stopsOneSceneAndGoesOnWithAnother) {
    const TestFolder folder, other;
    HostedRun first(folder), second(other);
    for (HostedRun* run : {&first, &second}) run->setQuiet();
    first.watch = [&] { first.requestStop(); };
    EXPECT_THROW(first.solve(), RunStopped);
    EXPECT_EQ(first.getNumberOfTimeSteps(), 1u);
    second.solve();
    EXPECT_EQ(second.getNumberOfTimeSteps(), 50u);
}

/// It may leave what takes long outside of runs: nothing has come then.
TEST(Host, leavesADenseInsertion) {
    struct Enough {};
    Simulation<HertzianViscoelasticMindlinSpecies> scene;
    SphericalParticle grain;
    grain.setSpecies(
        scene.speciesHandler.copyAndAddObject(scenes::boxMaterial<HertzianViscoelasticMindlinSpecies>(0)));
    const auto insert = [&] {
        scene.insert(evenSizes(1e-3, 2e-3), BoxRegion({0, 0, 0}, {0.02, 0.02, 0.02}),
                     Amount::solidFraction(0.5), grain);
    };
    int asked = 0;
    setInterruption([&] {
        if (++asked == 3) throw Enough();
    });
    EXPECT_THROW(insert(), Enough);
    EXPECT_EQ(scene.particleHandler.getSize(), 0u);
    setInterruption({});
    insert();
    EXPECT_GT(scene.particleHandler.getSize(), 100u);
    EXPECT_EQ(asked, 3);
}

#ifdef PENDULAR_HAS_HDF5
/// It may use the library itself: what that prints is the host's choice.
TEST(Host, keepsItsHdf5Library) {
    const TestFolder folder;
    const auto printer = [] {
        H5E_auto2_t function = nullptr;
        void* data = nullptr;
        H5Eget_auto2(H5E_DEFAULT, &function, &data);
        return function;
    };
    ASSERT_NE(printer(), nullptr);
    HostedRun scene(folder);
    scene.setQuiet();
    scene.solve();
    EXPECT_TRUE(std::filesystem::exists(scene.restartFile()));
    EXPECT_NE(printer(), nullptr);
}
#endif

// ---- The log

struct Line {
    LogLevel level;
    std::string text;
};

class Sink : public testing::Test {
protected:
    Sink() {
        setLogSink([this](LogLevel level, std::string_view text) {
            (level == LogLevel::Progress ? progress : lines).push_back({level, std::string(text)});
        });
    }
    ~Sink() override { setLogSink({}); }
    std::vector<Line> lines, progress;
};

TEST_F(Sink, getsTheLinesOfARunWithTheirLevels) {
    const TestFolder folder;
    HostedRun scene(folder);
    testing::internal::CaptureStderr();
    scene.runSteps(2);
    scene.logger(LogLevel::Verbose, "not shown");
    scene.logger(LogLevel::Info, "{} grains", 16);
    writeToLog("two\nlines\n");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_EQ(lines.size(), 4u);
    EXPECT_EQ(lines[0].text, "step 1");
    EXPECT_EQ(lines[1].text, "step 2");
    EXPECT_EQ(lines[1].level, LogLevel::Warn);
    EXPECT_EQ(lines[2].text, "16 grains");
    EXPECT_EQ(lines[2].level, LogLevel::Info);
    EXPECT_EQ(lines[3].text, "two\nlines");

    setLogSink({});
    testing::internal::CaptureStderr();
    scene.runSteps(1);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "Warning: step 3\n");
    EXPECT_EQ(lines.size(), 4u);
}

/// Whole lines, a few times a second, whatever standard error is.
TEST_F(Sink, getsTheProgress) {
    const TestFolder folder;
    HostedRun scene(folder);
    scene.logger.setLevel(LogLevel::None);
    scene.watch = [] { std::this_thread::sleep_for(std::chrono::milliseconds(15)); };
    const auto before = std::chrono::steady_clock::now();
    scene.solve();  // 0.75 s or more
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
    EXPECT_EQ(lines.size(), 0u);
    ASSERT_GE(progress.size(), 2u);
    EXPECT_LE(static_cast<double>(progress.size()), 2 + took.count() / 0.25);
    for (const Line& line : progress) {
        EXPECT_TRUE(contains(line.text, " contacts  "));
        EXPECT_EQ(line.text.find_first_of("\r\n"), std::string::npos) << line.text;
    }
    EXPECT_TRUE(contains(progress.back().text, "run  100.0 %"));
}

/// A log never ends a run.
TEST_F(Sink, mayFail) {
    setLogSink([](LogLevel, std::string_view) { throw std::runtime_error("no"); });
    const TestFolder folder;
    HostedRun scene(folder);
    scene.solve();
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 50u);
}

/// Scenes in several threads share it.
TEST_F(Sink, isOfAllThreads) {
    std::mutex access;
    std::size_t count = 0;
    setLogSink([&](LogLevel, std::string_view text) {
        const std::scoped_lock lock(access);
        count += text.starts_with("step ") ? 1 : 0;
    });
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k)
        threads.emplace_back([] {
            const TestFolder folder;
            HostedRun scene(folder);
            scene.keepRestartFile(false);
            scene.solve();
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(count, 200u);
}

}  // namespace
}  // namespace pendular::hostTest
