// What restart files have to do with runs that cannot go on, and with those that make an initial state.
#include <gtest/gtest.h>

#include <fstream>

#include "Drivers/Shared/DrumScene.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::endsOfRunsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::TestFolder;

using Smooth = Species<LinearViscoelastic>;

/// Two soft grains that meet too fast for their stiffness: the run ends when they overlap by half a radius.
class TooFast : public scenes::FewGrains<Smooth> {
public:
    explicit TooFast(const TestFolder& folder) : FewGrains(soft(), {left, right}, 1e-5) {
        setName(folder.name());
        setTimeMax(0.1);
        setQuiet();
    }
    /// The sentence with which it ends.
    std::string end() {
        try {
            solve();
        } catch (const RunError& stop) {
            return stop.what();
        }
        return {};
    }

private:
    static Smooth soft() {
        Smooth species;
        species.setDensity(2000);
        species.setStiffness(1);
        return species;
    }
    static constexpr double speed = 0.2;  // m/s: 0.4 m/s sqrt(m* / k) is 0.82 radii deep
    inline static const scenes::GrainMotion left{.position = {-1.1e-3, 0, 0}, .velocity = {speed, 0, 0}},
        right{.position = {1.1e-3, 0, 0}, .velocity = {-speed, 0, 0}};
};

/// The step that failed has changed what the contacts remember: the restart file stays that of an earlier
/// whole step, and the sentence names it. The run that goes on from there comes to the same end.
TEST(EndOfARun, thatCannotGoOnNamesTheRestartFileOfBefore) {
    const TestFolder folder;
    TooFast scene(folder), again(folder), alone(folder);
    scene.keepRestartFile();
    scene.setRestartCount(50);
    const std::string text = scene.end();
    const std::size_t last = scene.getNumberOfTimeSteps() / 50 * 50;
    ASSERT_GT(last, 0u);
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(
        text, fmt::format("; the state after {} steps is in {}", last, scene.restartFile().string())));
    again.restartFrom(scene.restartFile());
    EXPECT_EQ(again.end(), text);
    EXPECT_EQ(again.getNumberOfTimeSteps(), scene.getNumberOfTimeSteps());
    // The file is known by another of its paths, too.
    TooFast byAnotherPath(folder);
    byAnotherPath.restartFrom(folder.path() / "." / scene.restartFile().filename());
    EXPECT_EQ(byAnotherPath.end(), text);
    // One that keeps none names none, although there is one.
    EXPECT_EQ(alone.end(), text.substr(0, text.find("; the state after")) + ".");
}

/// Killed at any time, a run that starts again where another one was leaves no file of that one.
TEST(BeginOfARun, replacesTheRestartFileOfAnEarlierOne) {
    const TestFolder folder;
    TooFast earlier(folder), anew(folder), look(folder);
    for (TooFast* scene : {&earlier, &anew}) scene->keepRestartFile();
    earlier.setTimeMax(20e-5);
    earlier.solve();
    struct Watch {
        void write(const Scene& scene) {
            EXPECT_FALSE(std::filesystem::exists(scene.restartFile())) << "at the first output";
        }
    };
    anew.setTimeMax(0);
    anew.addOutput(Watch());
    anew.solve();
    look.restartFrom(anew.restartFile());
    look.initialise();
    EXPECT_EQ(look.getNumberOfTimeSteps(), 0u);
}

/// From the first step on there is a file from which it goes on.
TEST(BeginOfARun, keepsARestartFile) {
    const TestFolder folder;
    struct Looking : TooFast {
        using TooFast::TooFast;
        void actionsBeforeTimeStep() override { there = there || std::filesystem::exists(restartFile()); }
        bool there = false;
    } scene(folder);
    scene.keepRestartFile();
    scene.setTimeMax(2e-5);
    scene.solve();
    EXPECT_TRUE(scene.there);
}

/// The driver may say so only when it sets up its scene.
TEST(BeginOfARun, followsAScheduleThatTheSetUpGives) {
    const TestFolder folder;
    struct Scheduled : TooFast {
        using TooFast::TooFast;
        void setupInitialConditions() override {
            TooFast::setupInitialConditions();
            keepRestartFile();
            setRestartCount(10);
        }
        void actionsAfterTimeStep() override {
            if (getNumberOfTimeSteps() == 5) std::filesystem::remove(restartFile());
            if (getNumberOfTimeSteps() == 15) there = std::filesystem::exists(restartFile());
        }
        bool there = false;
    } scene(folder);
    scene.setTimeMax(20e-5);
    scene.solve();
    ASSERT_GE(scene.getNumberOfTimeSteps(), 15u);
    EXPECT_TRUE(scene.there);
}

/// What a run that was killed as it settled its grains leaves is its own, not the run before it.
TEST(Preparation, leavesNoRestartFileOfAnEarlierRun) {
    const TestFolder folder;
    const RunOptions options{.output = folder.path().string(), .quiet = true};
    std::filesystem::create_directories(folder.path());
    std::ofstream(folder.path() / "run-restart.h5") << "of an earlier run";
    TooFast scene(folder);
    options.applyToPreparation(scene);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "run-restart.h5")) << "before all is checked";
    scene.setTimeMax(0);
    scene.solve();
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "run-restart.h5"));
    EXPECT_EQ(scene.restartFile(), folder.path() / "preparation-restart.h5");
}

/// Settling that was stopped goes on where it was, and ends with the same grains in every bit.
TEST(Preparation, goesOnFromItsOwnRestartFile) {
    const TestFolder folder;
    constexpr std::size_t number = 200;
    constexpr double softening = 300;
    const DrumShape drum = drumFor(number);
    const RunOptions options{.output = folder.path().string(), .resume = true, .quiet = true};
    const auto settled = settledDrumGrains(number, drum, softening, {.output = {}, .quiet = true});
    DrumScene stopped(looseDrumGrains(number, drum), drum, softening);
    options.applyToPreparation(stopped);
    stopped.setTimeMax(0.02);  // s, of 0.25
    stopped.solve();
    EXPECT_EQ(options.restartSource("preparation"), folder.path() / "preparation-restart.h5");
    EXPECT_EQ(options.restartSource(), "");
    const auto resumed = settledDrumGrains(number, drum, softening, options);
    ASSERT_EQ(resumed.size(), settled.size());
    for (std::size_t k = 0; k < number; ++k) EXPECT_EQ(resumed[k].position, settled[k].position) << k;
    // It was resumed indeed: another drum does not fit the file.
    const std::string text =
        support::refusal([&] { settledDrumGrains(number + 10, drumFor(number + 10), softening, options); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "preparation-restart.h5 does not fit this scene"));
}

}  // namespace
}  // namespace pendular::endsOfRunsTest
