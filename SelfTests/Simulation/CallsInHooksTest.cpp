// What a hook may call of its own scene, and what is refused there: a step in a step would have no end.
#include <gtest/gtest.h>

#include <functional>

#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Analysis/Output/RunTable.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::callsInHooksTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

using Smooth = Species<LinearViscoelastic>;

constexpr double dt = 1e-6;  // s

Smooth material() {
    Smooth species;
    species.setDensity(2000);
    species.setStiffness(1000);
    return species;
}

/// Two grains that touch from the third step on, and an action in each hook.
class Hooked : public scenes::FewGrains<Smooth> {
public:
    using Action = std::function<void(Hooked&)>;

    explicit Hooked(const TestFolder& folder)
        : FewGrains(material(), {{}, {.position = {2.0025e-3, 0, 0}, .velocity = {-1, 0, 0}}}, dt) {
        setName(folder.name());
        setQuiet();
        setTimeMax(20 * dt);
        setSaveCount(5);
        listenToContacts();
    }
    void setupInitialConditions() override { call(inSetUp); }
    void actionsBeforeTimeStep() override { call(before); }
    void actionsAfterTimeStep() override { call(after); }
    void actionsOnContactEvent(const ContactEvent&) override { call(onEvent); }
    void writeOutput() override { call(inOutput); }
    void completeOutput() override { call(atEnd); }
    void visitState(StateArchive&) override { call(inState); }

    Action inSetUp, before, after, onEvent, inOutput, atEnd, inState;

private:
    void call(const Action& action) {
        if (action) action(*this);
    }
};

struct Hook {
    const char* name;
    Hooked::Action Hooked::*action;
};
constexpr std::array hooks{Hook{"before", &Hooked::before},       Hook{"after", &Hooked::after},
                           Hook{"on an event", &Hooked::onEvent}, Hook{"in the output", &Hooked::inOutput},
                           Hook{"at the end", &Hooked::atEnd},    Hook{"in set-up", &Hooked::inSetUp}};

std::string refusalIn(const Hook& hook, const Hooked::Action& call) {
    const TestFolder folder;
    Hooked scene(folder);
    scene.*hook.action = call;
    return refusal([&] { scene.solve(); });
}

TEST(CallInAHook, ofTheRunItselfIsRefused) {
    const std::vector<std::pair<const char*, Hooked::Action>> calls{
        {"step()", [](Hooked& s) { s.step(); }},
        {"initialise()", [](Hooked& s) { s.initialise(); }},
        {"solve()", [](Hooked& s) { s.solve(); }},
        {"completeAll()", [](Hooked& s) { s.completeAll(); }}};
    for (const Hook& hook : hooks)
        for (const auto& [name, call] : calls) {
            SCOPED_TRACE(std::string(name) + " " + hook.name);
            const std::string text = refusalIn(hook, call);
            EXPECT_TRUE(isOneSentence(text));
            EXPECT_TRUE(contains(text, name));
        }
}

/// A driver that steps by itself is told the same, and may go on.
TEST(CallInAHook, ofAStepIsRefusedInAStep) {
    const TestFolder folder;
    Hooked scene(folder);
    scene.initialise();
    scene.before = [](Hooked& s) { s.step(); };
    const std::string text = refusal([&] { scene.step(); });
    EXPECT_TRUE(contains(text, "step() cannot be called from this hook of the same scene"));
    scene.before = {};
    scene.step();
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 1u);
    EXPECT_TRUE(contains(refusal([&] { scene.initialise(); }), "the scene has begun already"));
}

TEST(CallInAHook, ofWriteAllIsRefusedWhereItIsUnderWay) {
    const std::string text = refusalIn(hooks[3], [](Hooked& s) { s.writeAll(); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "writeAll() cannot be called from this hook of the same scene"));
    // Elsewhere it may be.
    const TestFolder folder;
    Hooked scene(folder);
    int written = 0;
    scene.after = [](Hooked& s) { s.writeAll(); };
    scene.inOutput = [&](Hooked&) { ++written; };
    scene.solve();
    EXPECT_EQ(written, 20 + 5);
}

TEST(CallInAHook, ofWriteRestartIsRefusedInVisitState) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    Hooked scene(folder);
    scene.keepRestartFile();
    scene.inState = [&](Hooked& s) { s.writeRestart(folder.path() / "other.h5"); };
    EXPECT_TRUE(contains(refusal([&] { scene.solve(); }), "writeRestart() cannot be called from this hook"));
    Hooked stepping(folder);
    stepping.inState = [](Hooked& s) { s.step(); };
    stepping.initialise();
    EXPECT_TRUE(contains(refusal([&] { stepping.writeRestart(folder.path() / "other.h5"); }),
                         "step() cannot be called from this hook"));
}

/// Calls are refused that would be ignored, or whose files would have no lock.
TEST(CallInAHook, ofWhatIsSetUpIsRefused) {
    const std::vector<std::pair<const char*, Hooked::Action>> calls{
        {"the outputs can only be set", [](Hooked& s) { s.addOutput(ParaViewOutput()); }},
        {"the restart file to go on from can only be set", [](Hooked& s) { s.restartFrom("none.h5"); }},
        {"the restart file can only be set", [](Hooked& s) {
             if (Hdf5File::isAvailable()) s.keepRestartFile();
             else throw InputError("the restart file can only be set.");
         }}};
    for (const auto& [sentence, call] : calls)
        for (const Hook& hook : {hooks[0], hooks[2], hooks[3]}) {
            const std::string text = refusalIn(hook, call);
            EXPECT_TRUE(isOneSentence(text));
            EXPECT_TRUE(contains(text, sentence));
        }
}

/// An output may add another one when it is prepared.
TEST(CallInAHook, ofAddOutputIsTakenInSetUp) {
    const TestFolder folder;
    struct Counts : RemembersNothing {
        int* count;
        void write(const Scene&) const { ++*count; }
    };
    struct Adds : RemembersNothing {
        int* count;
        bool isInRun = false;
        void prepare(Scene& scene) {
            for (int k = 0; k < 20 && isInRun; ++k) scene.addOutput(Counts{{}, count});
            isInRun = true;  // when it is prepared for the second time
        }
        void write(const Scene&) const {}
    };
    int count = 0;
    Hooked scene(folder);
    scene.addOutput(Adds{{}, &count});
    scene.solve();
    EXPECT_EQ(count, 20 * 5);
}

/// It was ignored: the run had a copy of the schedule.
TEST(CallInAHook, ofSetRestartCountHoldsFromThenOn) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    Hooked scene(folder);
    scene.keepRestartFile();
    bool isThere = false;
    scene.before = [&](Hooked& s) {
        if (s.getNumberOfTimeSteps() == 4) {
            s.setRestartCount(3);
            std::filesystem::remove(s.restartFile());
        }
        if (s.getNumberOfTimeSteps() == 7) isThere = std::filesystem::exists(s.restartFile());
    };
    scene.solve();
    EXPECT_TRUE(isThere);
}

/// Another scene may run in a hook, and changes nothing.
TEST(CallInAHook, ofAnotherSceneIsTaken) {
    const TestFolder folder, other;
    Hooked alone(folder), outer(folder);
    alone.solve();
    outer.after = [&](Hooked& s) {
        if (s.getNumberOfTimeSteps() == 7) Hooked(other).solve();
    };
    outer.solve();
    EXPECT_EQ(stateHash(outer.particleHandler.store()), stateHash(alone.particleHandler.store()));
}

// ---- After the end of a run

/// Its tables are complete: a restart file can be written, and a row is refused.
TEST(TableOfARunThatHasEnded, isNotWrittenAnyMore) {
    const TestFolder folder;
    Hooked scene(folder);
    scene.addOutput(EnergyFile(0));
    scene.solve();
    const auto file = folder.name() + "-energy.csv";
    const std::string table = support::contentOf(file);
    if (Hdf5File::isAvailable()) scene.writeRestart(folder.path() / "end.h5");
    scene.step();
    const std::string text = refusal([&] { scene.writeAll(); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "run-energy.csv is complete; nothing can be added to it"));
    EXPECT_EQ(support::contentOf(file), table);
}

}  // namespace
}  // namespace pendular::callsInHooksTest
