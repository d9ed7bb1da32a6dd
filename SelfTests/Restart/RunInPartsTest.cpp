// A run in parts leaves the files, the restart file and the bits of one that solve() runs.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <thread>

#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Restart/ChildRun.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::runInPartsTest {
namespace {

using namespace support;

constexpr double dt = 0x1p-17;       // s
constexpr std::size_t length = 400;  // steps, of the run
constexpr double end = length * dt;  // s

/// A run with outputs of all kinds: at counts of steps and at intervals, in tables, frames and a file that
/// grows; and hooks that a test gives.
class Parts : public KeptRun {
public:
    explicit Parts(const std::filesystem::path& folder) : KeptRun(folder, length) {
        setQuiet();
        setRestartCount(31);
        addOutput(EnergyFile(9.3 * dt));
        addOutput(ParaViewOutput().withInterval(80 * dt));
        addOutput(MercuryOutput());
    }
    void actionsBeforeTimeStep() override {
        if (before) before(*this);
    }
    void actionsAfterTimeStep() override {
        if (after) after(*this);
    }
    [[nodiscard]] bool continueSolve() const override {
        ++asked;
        return getNumberOfTimeSteps() < lastStep;
    }
    [[nodiscard]] std::uint64_t hash() { return stateHash(particleHandler.store()); }

    std::function<void(Parts&)> before, after;
    std::size_t lastStep = length;
    mutable std::size_t asked = 0;
};

/// What a run leaves: all files of its folder, and how its grains are.
struct Left {
    std::filesystem::path folder;
    std::uint64_t hash;
};
std::set<std::string> filesOf(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) names.insert(std::filesystem::relative(entry, folder).string());
    return names;
}
void expectSame(const Left& a, const Left& b) {
    EXPECT_EQ(a.hash, b.hash);
    const auto names = filesOf(a.folder);
    EXPECT_GE(names.size(), 10u);
    EXPECT_EQ(names, filesOf(b.folder));
    for (const std::string& name : names) {
        EXPECT_FALSE(name.ends_with(".part") || name.ends_with("lock")) << name;
        if (name.ends_with("-restart.h5")) expectSameState(a.folder / name, b.folder / name);
        else EXPECT_EQ(contentOf(a.folder / name), contentOf(b.folder / name)) << name;
    }
}

class RunInParts : public testing::Test {
protected:
    const TestFolder folder;

    template <class Change>
    Left solved(const std::string& name, Change&& change) const {
        Parts scene(folder.path() / name);
        change(scene);
        scene.solve();
        return {folder.path() / name, scene.hash()};
    }
    [[nodiscard]] Left solved() const {
        return solved("whole", [](Parts&) {});
    }
    template <class Course>
    Left inParts(const std::string& name, Course&& course) const {
        Parts scene(folder.path() / name);
        course(scene);
        EXPECT_TRUE(scene.hasEnded());
        return {folder.path() / name, scene.hash()};
    }
};

/// A hook ends the part after its step; the next part goes on, and the last one ends the run.
TEST_F(RunInParts, isPausedByAHook) {
    const Left whole = solved("whole", [](Parts& scene) {
        scene.after = [](Parts& of) { of.requestPause(); };  // which a whole run takes no notice of
    });
    const Left parts = inParts("parts", [](Parts& scene) {
        scene.after = [](Parts& of) {
            if (of.getNumberOfTimeSteps() % 150 == 0) of.requestPause();
        };
        scene.requestPause();  // between two parts: nothing
        for (const std::size_t steps : {150, 300, 400}) {
            EXPECT_FALSE(scene.hasEnded());
            scene.runTo(end);
            EXPECT_EQ(scene.getNumberOfTimeSteps(), steps);
        }
    });
    expectSame(whole, parts);
}

/// The parts of 7 end between outputs, and between steps.
TEST_F(RunInParts, leavesWhatOneRunLeaves) {
    const Left whole = solved();
    for (const int count : {1, 7, 100}) {
        const auto parts = inParts(fmt::format("{}", count), [&](Parts& scene) {
            for (int k = 1; k <= count; ++k) {
                EXPECT_FALSE(scene.hasEnded());
                scene.runTo(end * k / count);
                const auto part = static_cast<std::size_t>(k), all = static_cast<std::size_t>(count);
                EXPECT_EQ(scene.getNumberOfTimeSteps(), (length * part + all - 1) / all);
            }
        });
        expectSame(whole, parts);
    }
    expectSame(whole, inParts("steps", [](Parts& scene) {
                   scene.runSteps(0);
                   while (!scene.hasEnded()) scene.runSteps(3);
               }));
}

/// Its maximum time was not set; the parts before say nothing of the end.
TEST_F(RunInParts, withoutAMaximumTimeEndsWhereItIsFinished) {
    struct Fresh : scenes::SettlingBox<Species<LinearViscoelastic>> {
        explicit Fresh(const TestFolder& of) : SettlingBox(1) {
            setName(of.name());
            setQuiet();
            setSaveCount(7);
            addOutput(EnergyFile());
        }
    };
    const TestFolder one, other;
    Fresh solved(one), parts(other);
    solved.setTimeMax(100 * dt);
    solved.solve();
    parts.runTo(33.3 * dt);
    EXPECT_EQ(parts.getNumberOfTimeSteps(), 34u);
    parts.runSteps(6);
    parts.runTo(100 * dt);
    EXPECT_FALSE(parts.hasEnded());
    EXPECT_EQ(parts.getTimeMax(), 100 * dt);
    parts.finishRun();
    EXPECT_TRUE(parts.hasEnded());
    EXPECT_EQ(contentOf(one.path() / "run-energy.csv"), contentOf(other.path() / "run-energy.csv"));
    EXPECT_EQ(filesOf(one.path()), filesOf(other.path()));
    EXPECT_EQ(refusal([&] { parts.finishRun(); }), "") << "there is nothing to do";
}

/// What is changed between two parts holds as if a hook had changed it before the next step.
TEST_F(RunInParts, changesBetweenThemAreThoseOfAHook) {
    const auto change = [](Parts& scene) {
        scene.setGravity({1, 0, -9.81});
        scene.speciesHandler.getObject(0)->setSlidingFrictionCoefficient(0.1);
        scene.wallHandler.removeObject(4);  // the lid
        scene.particleHandler.removeObject(17);
        scene.setTimeStep(0.75 * dt);
        scene.setRestartCount(40);
    };
    const Left hooked = solved("hooked", [&](Parts& scene) {
        scene.before = [&](Parts& s) {
            if (s.getNumberOfTimeSteps() == 123) change(s);
        };
    });
    const Left between = inParts("between", [&](Parts& scene) {
        scene.runSteps(123);
        change(scene);
        for (int k = 1; !scene.hasEnded(); ++k) scene.runTo((123 + 50 * k) * dt);
    });
    expectSame(hooked, between);
    EXPECT_NE(hooked.hash, solved().hash);
}

/// It is checked before the next step, with the sentence of set-up; the run has then stopped.
TEST_F(RunInParts, aWrongChangeBetweenThemEndsTheRun) {
    Parts scene(folder.path());
    scene.runSteps(10);
    scene.setTimeStep(1);
    std::string text;
    try {
        scene.runSteps(1);
    } catch (const RunError& error) {
        text = error.what();
    }
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "stability limit"));
    EXPECT_TRUE(contains(text, "the last whole step is in"));
    EXPECT_TRUE(scene.hasEnded());
    EXPECT_TRUE(
        contains(refusal([&] { scene.runSteps(1); }), "runSteps() cannot go on: this run has stopped"));
}

/// It goes on in another scene from the file that is written between two parts; the first scene goes without
/// an end.
TEST_F(RunInParts, goesOnFromARestartFileBetweenThem) {
    const Left whole = solved();
    const auto place = folder.path() / "part";
    {
        Parts scene(place);
        scene.setRestartCount(0);
        scene.runTo(0.4 * end);
        scene.writeRestart(scene.restartFile());
        scene.runTo(0.5 * end);
    }
    expectSame(whole, inParts("part", [](Parts& scene) {
                   ASSERT_TRUE(scene.isRestarted());
                   const std::string text = refusal([&] { scene.runTo(0.1 * end); });
                   EXPECT_TRUE(contains(text, "the run is at 0.0012207 s already"));
                   EXPECT_EQ(scene.getNumberOfTimeSteps(), length * 2 / 5);
                   scene.runTo(0.7 * end);
                   scene.runTo(2 * end);
               }));
}

/// A step that follows the contacts is the same whatever the parts.
TEST_F(RunInParts, withAnAdaptiveStepIsTheSame) {
    const auto adapt = [](Parts& scene) { scene.setAdaptiveTimeStep(0.5); };
    const Left whole = solved("whole", adapt);
    expectSame(whole, inParts("parts", [&](Parts& scene) {
                   adapt(scene);
                   for (int k = 1; k <= 13; ++k) scene.runTo(end * k / 13);
               }));
}

/// The driver is asked as often as in one run.
TEST_F(RunInParts, endsWhereTheDriverSaysSo) {
    std::size_t asked = 0;
    Parts one(folder.path() / "whole");
    one.lastStep = 150;
    one.solve();
    asked = one.asked;
    const auto parts = inParts("parts", [&](Parts& scene) {
        scene.lastStep = 150;
        scene.runSteps(150);
        EXPECT_FALSE(scene.hasEnded()) << "it was not asked yet";
        scene.runSteps(50);
        EXPECT_EQ(scene.getNumberOfTimeSteps(), 150u);
        EXPECT_EQ(scene.asked, asked);
    });
    expectSame({folder.path() / "whole", one.hash()}, parts);
}

/// Another thread may ask for it, or a hook: the run's files are complete, and a restart goes on as if
/// nothing had been.
TEST_F(RunInParts, stopsWhereItIsAskedTo) {
    const Left whole = solved();
    const auto stopOf = [](Parts& scene, auto&& run) {
        try {
            run();
        } catch (const RunStopped& stop) {
            EXPECT_EQ(stop.exitCode, 143);
            EXPECT_TRUE(scene.hasEnded() && scene.wasAskedToStop());
            return std::string(stop.what());
        }
        return std::string("it was not stopped");
    };
    const auto place = folder.path() / "part";
    {  // between two parts
        Parts scene(place);
        scene.runSteps(100);
        std::thread([&] { scene.requestStop(); }).join();
        const std::string text = stopOf(scene, [&] { scene.runTo(end); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text,
                             "requestStop() has stopped the run at time 0.000762939 s, after 100 steps; "
                             "restart from "));
        EXPECT_TRUE(
            contains(refusal([&] { scene.runTo(end); }), "runTo() cannot go on: this run has stopped"));
        for (const std::string& name : filesOf(place)) EXPECT_FALSE(name.ends_with(".part")) << name;
    }
    {  // in a step of solve()
        Parts scene(place);
        scene.after = [](Parts& s) {
            if (s.getNumberOfTimeSteps() == 200) s.requestStop();
        };
        EXPECT_TRUE(contains(stopOf(scene, [&] { scene.solve(); }), "after 200 steps"));
    }
    {  // while it runs
        Parts scene(place);
        std::thread other;
        scene.before = [&](Parts& s) {
            if (s.getNumberOfTimeSteps() == 250) other = std::thread([&] { scene.requestStop(); });
            if (s.getNumberOfTimeSteps() == 300) other.join();
        };
        EXPECT_TRUE(contains(stopOf(scene, [&] { scene.runTo(end); }), "requestStop() has stopped the run"));
        EXPECT_GE(scene.getNumberOfTimeSteps(), 251u);
        EXPECT_LE(scene.getNumberOfTimeSteps(), 301u);
        if (other.joinable()) other.join();
    }
    expectSame(whole, inParts("part", [](Parts& scene) { scene.runTo(end); }));
}

/// What a hook throws comes out as it is; the outputs are complete, the name is free, and no part follows.
TEST_F(RunInParts, endsWithWhatAHookThrows) {
    struct Other : std::runtime_error {
        using std::runtime_error::runtime_error;
    };
    Parts scene(folder.path());
    scene.runSteps(10);
    scene.after = [](Parts& s) {
        if (s.getNumberOfTimeSteps() == 20) throw Other("The user has had enough.");
    };
    EXPECT_THROW(scene.runSteps(20), Other);
    EXPECT_TRUE(scene.hasEnded());
    EXPECT_EQ(scene.stopSentence(), "The user has had enough.");
    const auto names = filesOf(folder.path());
    EXPECT_TRUE(names.contains("run-energy.csv") && !names.contains("run.pendular-lock"));
    const std::string text = refusal([&] { scene.runSteps(1); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "this run has stopped (The user has had enough)"));
    scene.after = [](Parts&) { throw 42; };
    EXPECT_NE(refusal([&] { scene.runSteps(1); }), "") << "it does not even begin";
}

/// The name is that of the run also between two parts, until its end or that of the scene.
TEST_F(RunInParts, keepsItsName) {
    const auto another = [&] {
        return refusal([&] {
            Parts scene(folder.path());
            scene.runSteps(1);
        });
    };
    {
        Parts scene(folder.path());
        scene.runSteps(1);
        EXPECT_TRUE(contains(another(), "run-* are in use by another run"));
        scene.finishRun();
        EXPECT_EQ(another(), "");
    }
    {
        Parts scene(folder.path());
        scene.runSteps(1);
        EXPECT_NE(another(), "");
    }
    EXPECT_EQ(another(), "");
}

/// A scene that goes in the middle of its run completes its outputs, with the rows that they have.
TEST_F(RunInParts, losesNoFileWithTheScene) {
    {
        Parts scene(folder.path());
        scene.runSteps(100);
    }
    const auto names = filesOf(folder.path());
    EXPECT_TRUE(names.contains("run-energy.csv"));
    const std::string table = contentOf(folder.path() / "run-energy.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 1 + 10) << table;  // each 9.3 of 100 steps
    // The driver's own table is complete but for its name.
    EXPECT_TRUE(names.contains("table.csv.part"));
}

/// Signals are heard from the start of the run to its end, also between parts.
TEST_F(RunInParts, hearsSignalsBetweenThem) {
    const auto place = folder.path() / "child";
    const Child child(place, [&] {
        Parts scene(place);
        scene.runSteps(50);
        std::raise(SIGTERM);
        scene.runSteps(50);
    });
    EXPECT_EQ(child.wait(), 143);
    EXPECT_TRUE(contains(contentOf(place / "printed"),
                         "SIGTERM has stopped the run at time 0.00038147 s, after "
                         "50 steps; restart from"));
}

TEST_F(RunInParts, whatDoesNotFitIsRefused) {
    using Call = std::function<void(Parts&)>;
    const Call toTheEnd = [](Parts& s) { s.runTo(end); };
    const std::vector<std::tuple<Call, Call, std::string>> cases{
        {[](Parts& s) { s.runSteps(10); }, [](Parts& s) { s.solve(); }, "finishRun() ends it"},
        {[](Parts& s) { s.runSteps(10); }, [](Parts& s) { s.runTo(5 * dt); }, "so take a later time"},
        {[](Parts&) {}, [](Parts& s) { s.runTo(std::nan("")); },
         "time of runTo() is not set or not a number"},
        {[](Parts&) {}, [](Parts& s) { s.runTo(-1); }, "time of runTo() = -1 s is out of range"},
        {[](Parts& s) { s.runSteps(10); }, [](Parts& s) { s.step(); }, "call runSteps() instead"},
        {[](Parts& s) { s.runSteps(10); }, [](Parts& s) { s.completeAll(); }, "call finishRun() instead"},
        {[](Parts& s) { s.runSteps(10); }, [](Parts& s) { s.initialise(); }, "has begun already"},
        {[](Parts& s) { s.runSteps(10); }, [](Parts& s) { s.addOutput(MercuryOutput()); },
         "can only be set before the run starts"},
        {toTheEnd, toTheEnd, "runTo() cannot go on: the run has ended at 0.00305176 s"},
        {[](Parts& s) { s.solve(); }, toTheEnd, "runTo() cannot go on: the run has ended at"},
        {toTheEnd, [](Parts& s) { s.solve(); }, "the run has begun already"},
        {[](Parts& s) { s.initialise(); }, toTheEnd, "by initialise(); runTo() begins a run by itself"},
        {[](Parts&) {}, [](Parts& s) { s.finishRun(); }, "there is none"}};
    for (const auto& [first, second, words] : cases) {
        const TestFolder own;
        Parts scene(own.path());
        first(scene);
        const std::string text = refusal([&, &then = second] { then(scene); });
        EXPECT_TRUE(isOneSentence(text)) << words;
        EXPECT_TRUE(contains(text, words));
    }
    // A refusal ends no run.
    Parts scene(folder.path());
    scene.runSteps(10);
    EXPECT_NE(refusal([&] { scene.runTo(5 * dt); }), "");
    scene.runSteps(1);
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 11u);
}

TEST_F(RunInParts, inAHookOfTheSameSceneIsRefused) {
    const std::vector<std::pair<std::string, std::function<void(Parts&)>>> calls{
        {"runTo()", [](Parts& s) { s.runTo(end); }},
        {"runSteps()", [](Parts& s) { s.runSteps(1); }},
        {"finishRun()", [](Parts& s) { s.finishRun(); }}};
    for (const auto& [name, call] : calls)
        for (const bool whole : {true, false}) {
            const TestFolder own;
            Parts scene(own.path());
            scene.before = call;
            const std::string text = refusal([&] { whole ? scene.solve() : scene.runSteps(2); });
            EXPECT_TRUE(isOneSentence(text));
            EXPECT_TRUE(contains(text, name + " cannot be called from this hook of the same scene"));
        }
}

}  // namespace
}  // namespace pendular::runInPartsTest
