#include <gtest/gtest.h>

#include "BuildFolders.h"
#include "Kernel/Simulation/RunSummary.h"
#include "Kernel/Simulation/StateHash.h"
#include "Kernel/Species/Friction/Mindlin.h"
#include "Kernel/Species/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular {
namespace {

using support::contains;
using support::contentOf;
using support::TestFolder;
using Rough = Species<HertzianViscoelastic, Mindlin>;

const std::string tool = (folders::tools / "summary").string();

/// A settling box of 48 grains; one grain may be kicked at a step.
struct Watched : scenes::SettlingBox<Rough> {
    explicit Watched(const std::string& name, double kick = 0) : SettlingBox(3), speed(kick) {
        setName(name);
        setTimeMax(2000 * 0x1p-17);
        setSaveCount(500);
        keepEnergyLedger();
        addOutput(RunSummary());
    }
    void actionsAfterTimeStep() override {
        if (speed > 0 && getNumberOfTimeSteps() == 700)
            particleHandler.getObject(7).setVelocity({0, speed, 0});
    }
    double speed;  // m/s
};

TEST(Summary, saysWhatRunsAndHowFar) {
    const TestFolder folder;
    Watched scene(folder.name());
    scene.solve();
    const std::string text = contentOf(folder.name() + "-summary.csv");
    for (const std::string& line :
         {std::string("state,at its end,"), fmt::format("time,{},s", scene.getTime()),
          std::string("steps,2000,"), std::string("grains,48,"), std::string("walls,6,"),
          fmt::format("time step,{},s", 0x1p-17), fmt::format("stability limit,{},s", scene.stabilityLimit()),
          std::string("species 0: density,2500,kg/m^3"),
          std::string("species 1: effectiveElasticModulus,3000000,Pa"),
          fmt::format("species,{},", Rough::name),
          fmt::format("lists of contacts made,{},", scene.contacts().rebuildCount())})
        EXPECT_TRUE(contains(text, "\n" + line + "\n"));
    const auto shown = support::run(tool + " " + folder.path().string());
    EXPECT_EQ(shown.exitCode, 0) << shown.output;
    EXPECT_TRUE(contains(shown.output, "healthy, and at its end"));
    // The parts of the step make up the time, all of it positive.
    double sum = 0;
    for (std::size_t part = 0; part < StepTimes::names.size(); ++part) {
        EXPECT_GE(scene.stepTimes().seconds(part), 0);
        sum += scene.stepTimes().seconds(part);
    }
    EXPECT_GT(sum, 0);
}

TEST(Summary, saysThatARunHasStoppedAndWhy) {
    const TestFolder folder;
    Watched scene(folder.name(), 200);
    EXPECT_THROW(scene.solve(), RunError);
    const auto shown = support::run(tool + " " + folder.path().string());
    EXPECT_EQ(shown.exitCode, 2);
    EXPECT_TRUE(contains(shown.output, "NOT WELL: it stopped: At time"));
    EXPECT_TRUE(contains(shown.output, "particle 7 moves at 200 m/s"));
}

TEST(Summary, saysThatEnergyIsMissing) {
    const TestFolder folder;
    Watched scene(folder.name(), 2);
    scene.solve();
    const auto shown = support::run(tool + " " + folder.path().string());
    EXPECT_EQ(shown.exitCode, 2);
    EXPECT_TRUE(contains(shown.output, "NOT WELL"));
    EXPECT_TRUE(contains(shown.output, "J of energy are unaccounted for"));
}

TEST(Summary, doesNotChangeTheTrajectory) {
    const TestFolder folder;
    Watched with(folder.name());
    scenes::SettlingBox<Rough> without(3);
    without.setTimeMax(with.getTimeMax());
    with.solve(), without.solve();
    EXPECT_EQ(stateHash(with.particleHandler.store()), stateHash(without.particleHandler.store()));
}

TEST(Summary, refusesAFolderWithoutRuns) {
    const TestFolder folder;
    support::expectOneSentence(support::run(tool + " " + folder.path().string()), "cannot be read");
    std::filesystem::create_directories(folder.path());
    support::expectOneSentence(support::run(tool + " " + folder.path().string()), "has no summary of a run");
}

}  // namespace
}  // namespace pendular
