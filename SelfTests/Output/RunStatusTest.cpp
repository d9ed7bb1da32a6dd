// Every run with files of its name says how it ended, also without a RunSummary.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "BuildFolders.h"
#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/OutputForm.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::runStatusTest {
namespace {

using support::contains;
using support::contentOf;
using support::TestFolder;
using Rough = Species<HertzianViscoelastic, Mindlin>;

constexpr double dt = 0x1p-17;  // s

/// As a driver outside of the repository has it: a name, and an output.
struct Outside : scenes::SettlingBox<Rough> {
    explicit Outside(const TestFolder& folder) : SettlingBox(1), file(folder.name() + "-summary.csv") {
        setName(folder.name());
        setTimeMax(20 * dt);  // before grains meet
        setQuiet();
        keepEnergyLedger();
        addOutput(EnergyFile(5 * dt));
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() == 10 && atHalf) atHalf(*this);
    }
    [[nodiscard]] std::string told() const { return contentOf(file); }
    std::function<void(Outside&)> atHalf;
    std::string file;
};

/// An output without files.
struct Counted : RemembersNothing {
    void write(const Scene& /*scene*/) { ++count; }
    int count = 0;
};

support::ProgramResult show(const TestFolder& folder) {
    return support::run((folders::tools / "summary").string() + " " + folder.path().string());
}

TEST(RunStatus, ofARunThatEnds) {
    const TestFolder folder;
    Outside scene(folder);
    scene.atHalf = [](Outside& of) { EXPECT_TRUE(contains(of.told(), "\nstate,on its way,\n")); };
    scene.solve();
    for (const std::string& row :
         {std::string("state,at its end,"), fmt::format("time,{},s", 20 * dt),
          fmt::format("end time,{},s", 20 * dt), std::string("steps,20,"), std::string("grains,16,")})
        EXPECT_TRUE(contains(scene.told(), "\n" + row + "\n"));
    const auto shown = show(folder);
    EXPECT_EQ(shown.exitCode, 0) << shown.output;
    EXPECT_TRUE(contains(shown.output, "healthy, and at its end"));
}

TEST(RunStatus, ofARunThatFails) {
    const TestFolder folder;
    Outside scene(folder);
    scene.atHalf = [](Outside& of) { of.particleHandler.getObject(3).setVelocity({0, 500, 0}); };
    EXPECT_THROW(scene.solve(), RunError);
    EXPECT_TRUE(contains(scene.told(), "\nstate,stopped by an error,\n"));
    EXPECT_TRUE(contains(scene.told(), "particle 3 moves at 500 m/s"));
    EXPECT_EQ(show(folder).exitCode, 2);
}

/// An error of the driver, whose text has several lines.
TEST(RunStatus, ofARunThatItsDriverFails) {
    const TestFolder folder;
    Outside scene(folder);
    scene.atHalf = [](Outside&) { throw std::runtime_error("no table,\nno run"); };
    EXPECT_THROW(scene.solve(), std::runtime_error);
    EXPECT_TRUE(contains(scene.told(), "\nstate,stopped by an error,\nreason,\"no table, no run\",\n"));
    EXPECT_TRUE(contains(show(folder).output, "NOT WELL: it stopped: no table, no run"));
}

TEST(RunStatus, ofARunThatIsAskedToStop) {
    const TestFolder folder;
    Outside scene(folder);
    scene.atHalf = [](Outside& of) { of.requestStop(); };
    EXPECT_THROW(scene.solve(), RunStopped);
    EXPECT_TRUE(contains(scene.told(), "\nstate,asked to stop,\nreason,\"requestStop() has stopped the run"));
    EXPECT_TRUE(contains(scene.told(), fmt::format("\nend time,{},s\n", 20 * dt)));
}

TEST(RunStatus, ofARunInParts) {
    const TestFolder folder;
    std::optional<Outside> scene(folder);
    const std::string file = scene->file;
    scene->runTo(8 * dt);
    EXPECT_TRUE(contains(contentOf(file), "\nstate,on its way,\n"));
    scene.reset();
    EXPECT_TRUE(contains(contentOf(file), "\nstate,asked to stop,\nreason,its program left it at "));
    scene.emplace(folder);
    scene->runTo(8 * dt);
    scene->finishRun();
    EXPECT_TRUE(contains(contentOf(file), "\nstate,at its end,\n"));
}

TEST(RunStatus, ofADriverThatStepsByItself) {
    const TestFolder folder;
    Outside scene(folder);
    scene.initialise();
    scene.writeAll();
    EXPECT_TRUE(contains(scene.told(), "\nstate,on its way,\n"));
    scene.step(10);
    scene.completeAll();
    EXPECT_TRUE(contains(scene.told(), "\nstate,at its end,\n"));
}

/// It is left without completeAll(): by its program, or by an error of that.
TEST(RunStatus, ofADriverThatStepsAndIsLeft) {
    for (const bool isError : {false, true}) {
        const TestFolder folder;
        try {
            Outside scene(folder);
            scene.initialise();
            scene.writeAll();
            scene.step(3);
            if (isError) throw std::runtime_error("no more");
        } catch (const std::runtime_error&) {}
        const std::string told = contentOf(folder.name() + "-summary.csv");
        EXPECT_TRUE(contains(told, isError ? "\nstate,stopped by an error,\nreason,an error of its program "
                                           : "\nstate,asked to stop,\nreason,its program left it at "));
    }
}

/// Without a name of its own, where it has frames: they have one, too.
TEST(RunStatus, ofARunWithoutAName) {
    const TestFolder folder;
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    for (const bool hasFrames : {false, true}) {
        scenes::SettlingBox<Rough> scene(1);
        scene.setQuiet();
        scene.setTimeMax(10 * dt);
        scene.addOutput(Counted{});
        if (hasFrames) scene.addOutput(ParaViewOutput());
        scene.solve();
        EXPECT_EQ(std::filesystem::exists("pendular-summary.csv"), hasFrames);
    }
    EXPECT_TRUE(contains(contentOf("pendular-summary.csv"), "\nstate,at its end,\n"));
    std::filesystem::current_path(before);
}

/// A scene without files writes nothing.
TEST(RunStatus, ofARunWithoutFilesThereIsNone) {
    const TestFolder folder;
    scenes::SettlingBox<Rough> scene(1);
    scene.setName(folder.name());
    scene.setQuiet();
    scene.setTimeMax(10 * dt);
    scene.solve();
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace pendular::runStatusTest
