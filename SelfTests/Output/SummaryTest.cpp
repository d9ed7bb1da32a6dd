#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <fstream>
#include <thread>

#include "BuildFolders.h"
#include "Kernel/Analysis/Output/RunSummary.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinIncremental.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/Simulation.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::summaryTest {
namespace {

using support::contains;
using support::contentOf;
using support::TestFolder;
using Rough = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, NoFriction, LiquidBridgeWillett>;

const std::string tool = (folders::tools / "summary").string();
constexpr std::size_t wholeRun = 2000;  // steps
constexpr std::size_t eventStep = 700;

/// A settling box of 48 grains, whose largest overlap is found by brute force in every step.
template <class S>
struct Watched : scenes::SettlingBox<S> {
    explicit Watched(const std::string& name) : scenes::SettlingBox<S>(3) {
        this->setName(name);
        this->setTimeMax(wholeRun * 0x1p-17);
        this->setSaveCount(500);
        this->setQuiet();
        this->keepEnergyLedger();
        this->addOutput(RunSummary());
    }
    /// Grains that fall softly enough for Hertz's theory: 0.15 m/s after the 15 ms of the run.
    Watched& softly() {
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k) {
            auto grain = this->particleHandler.getObject(k);
            grain.setVelocity(0.02 * grain.getVelocity());
        }
        return *this;
    }
    void actionsAfterTimeStep() override {
        if (this->getNumberOfTimeSteps() == eventStep && event) event(*this);
        const auto& grains = this->particleHandler.store();
        const auto note = [&](double overlap, double effectiveRadius) {
            largest = std::max(largest, overlap / effectiveRadius);
            above += overlap > 0.1 * effectiveRadius ? 1 : 0;
        };
        for (std::size_t i = 0; i < grains.size(); ++i) {
            const TranslationRecord& a = grains.translation[i];
            for (std::size_t j = 0; j < i; ++j) {
                const TranslationRecord& b = grains.translation[j];
                note(a.radius + b.radius - norm(a.position - b.position),
                     a.radius * b.radius / (a.radius + b.radius));
            }
            for (const auto& plane : this->planes)
                note(a.radius - (plane.point - toEigen(a.position)).dot(plane.normal), a.radius);
        }
    }
    std::function<void(Watched&)> event = {};  // at eventStep
    double largest = 0;                        // of the effective radius
    std::uint64_t above = 0;
};

support::ProgramResult show(const TestFolder& folder) {
    return support::run(tool + " " + folder.path().string());
}
/// What a run that ends in any way prints.
template <class Scene>
std::string printedBy(Scene& scene) {
    testing::internal::CaptureStderr();
    try {
        scene.solve();
    } catch (const std::runtime_error&) {}
    return testing::internal::GetCapturedStderr();
}

TEST(Summary, saysWhatRunsAndHowFar) {
    const TestFolder folder;
    Watched<Rough> scene(folder.name());
    scene.softly().solve();
    const std::string text = contentOf(folder.name() + "-summary.csv");
    for (const std::string& line :
         {std::string("state,at its end,"), fmt::format("time,{},s", scene.getTime()),
          std::string("steps,2000,"), std::string("grains,48,"), std::string("walls,6,"),
          fmt::format("time step,{},s", 0x1p-17), fmt::format("stability limit,{},s", scene.stabilityLimit()),
          std::string("species 0: density,2500,kg/m^3"),
          std::string("species 1: effectiveElasticModulus,3000000,Pa"),
          fmt::format("species,{},", Rough::name), std::string("evaluations out of domain,0,"),
          fmt::format("lists of contacts made,{},", scene.contacts().rebuildCount())})
        EXPECT_TRUE(contains(text, "\n" + line + "\n"));
    EXPECT_TRUE(contains(text, "\nnote on friction,springs of Mindlin gain energy"));
    const auto shown = show(folder);
    EXPECT_EQ(shown.exitCode, 0) << shown.output;
    EXPECT_TRUE(contains(shown.output, "healthy, and at its end"));
}

template <class S>
bool hasNoteOnFriction(bool withLedger) {
    const TestFolder folder;
    Watched<S> scene(folder.name());
    scene.keepEnergyLedger(withLedger);
    scene.softly().solve();
    return contains(contentOf(folder.name() + "-summary.csv"), "note on friction");
}

// Only of springs that keep their stretch while the overlap changes, and where a ledger tells.
TEST(Summary, saysThatSpringsGainEnergyOnlyWhereTheyDo) {
    EXPECT_TRUE(hasNoteOnFriction<Rough>(true));
    EXPECT_FALSE(hasNoteOnFriction<Rough>(false));
    using Incremental = Species<HertzianViscoelastic, MindlinIncremental>;
    EXPECT_FALSE(hasNoteOnFriction<Incremental>(true));
    using Smooth = Species<HertzianViscoelastic>;
    EXPECT_FALSE(hasNoteOnFriction<Smooth>(true));
}

// With the adaptive step the scene moves springs in the step, whose limit is another one.
TEST(Summary, hasTheStabilityLimitOfTheRun) {
    const TestFolder folder;
    Watched<Rough> scene(folder.name());
    scene.setAdaptiveTimeStep(0.5);
    scene.setTimeMax(1e-3);
    const double before = scene.stabilityLimit();
    scene.solve();
    ASSERT_NE(scene.stabilityLimit(), before);
    EXPECT_TRUE(contains(contentOf(folder.name() + "-summary.csv"),
                         fmt::format("\nstability limit,{},s\n", scene.stabilityLimit())));
}

// Grains meet at 1 to 2 m/s, for less than the time between two outputs.
TEST(Summary, hasTheLargestOverlapThatWasMet) {
    const TestFolder folder;
    for (const int threads : {3, 1}) {
        Watched<Rough> scene(folder.name());
        scene.setNumberOfThreads(threads);
        if (threads > 1) scene.setTimeMax(300 * 0x1p-17);
        scene.solve();
        EXPECT_GT(scene.above, 100u);
        EXPECT_EQ(scene.contacts().overlaps().countAbove(), scene.above);
        // Positions of 0.02 m have errors of 1e-18 m, overlaps of 1e-4 m then of 1e-14.
        EXPECT_NEAR(scene.contacts().overlaps().largestOverlap(), scene.largest, 1e-13);
        const std::string text = contentOf(folder.name() + "-summary.csv");
        EXPECT_TRUE(contains(text, fmt::format("\nevaluations out of domain,{},\n", scene.above)));
        EXPECT_TRUE(contains(text, fmt::format("warning,HertzianViscoelastic: overlaps were above 0.1 of the "
                                               "effective radius in {} evaluations",
                                               scene.above)));
    }
    const auto shown = show(folder);
    EXPECT_EQ(shown.exitCode, 2);
    EXPECT_TRUE(contains(shown.output, "NOT WELL: HertzianViscoelastic: overlaps were above 0.1"));
}

TEST(Summary, goesOnAfterARestart) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    Watched<Rough> whole(folder.name()), begun(folder.name()), goesOn(folder.name());
    whole.solve();
    begun.keepRestartFile();
    begun.setTimeMax(1200 * 0x1p-17);
    begun.solve();
    EXPECT_GT(begun.above, 0u);
    goesOn.restartFrom(begun.restartFile());
    goesOn.solve();
    const OverlapWatch &a = whole.contacts().overlaps(), &b = goesOn.contacts().overlaps();
    EXPECT_EQ(a.largestOverlap(), b.largestOverlap());
    EXPECT_EQ(a.countAbove(), b.countAbove());
    EXPECT_EQ(whole.energyUnaccountedFor(), goesOn.energyUnaccountedFor());
    EXPECT_TRUE(contains(contentOf(folder.name() + "-summary.csv"), "\nrestarted after steps,1200,\n"));
}

TEST(Summary, isPrintedAtTheEnd) {
    const TestFolder folder;
    Watched<Rough> scene(folder.name());
    scene.setQuiet(false);
    const std::string printed = printedBy(scene.softly());
    for (const char* part :
         {"Summary of the run\n", "state                                at its end\n", "wall time: search",
          "wall time: contacts", "wall time: walls", "wall time: sum", "wall time: energy ledger",
          "wall time: output", " %)", "lists of contacts made", "largest overlap met",
          "evaluations out of domain            0\n", "energy unaccounted for"})
        EXPECT_TRUE(contains(printed, part));
    EXPECT_FALSE(contains(printed, "Warning"));
    scene.setQuiet();
    EXPECT_EQ(printedBy(scene), "") << "a quiet scene prints nothing";
}

/// A step that the driver has accepted is told, and is not ill; without its word it is.
TEST(Summary, tellsAnAcceptedStepFromOneThatIsTooLong) {
    const TestFolder folder;
    Watched<Rough> scene(folder.name());
    scene.setTimeStep(1.5 * scene.stabilityLimit());
    scene.setTimeMax(20 * scene.getTimeStep());  // nothing meets yet
    scene.acceptUnstableTimeStep();
    scene.softly().solve();
    auto shown = show(folder);
    EXPECT_EQ(shown.exitCode, 0) << shown.output;
    EXPECT_TRUE(
        contains(shown.output,
                 "healthy, and at its end; its time step is 1.50 times the stability limit, which its "
                 "driver has accepted\n"));
    const std::string file = folder.name() + "-summary.csv",
                      row = "\nstep above the stability limit,accepted,";
    std::string text = contentOf(file);
    ASSERT_TRUE(contains(text, row));
    std::ofstream(file) << text.erase(text.find(row), row.size());
    shown = show(folder);
    EXPECT_EQ(shown.exitCode, 2);
    EXPECT_TRUE(contains(shown.output, "NOT WELL: its time step is above the stability limit"));
}

TEST(Summary, saysThatARunHasStoppedAndWhy) {
    const TestFolder folder;
    Watched<Rough> scene(folder.name());
    scene.setQuiet(false);
    scene.event = [](auto& self) { self.particleHandler.getObject(7).setVelocity({0, 200, 0}); };
    const std::string printed = printedBy(scene);
    EXPECT_TRUE(contains(printed, "state                                stopped by an error\n"));
    EXPECT_TRUE(contains(printed, "particle 7 moves at 200 m/s"));
    const auto shown = show(folder);
    EXPECT_EQ(shown.exitCode, 2);
    EXPECT_TRUE(contains(shown.output, "NOT WELL: it stopped: At time"));
    EXPECT_TRUE(contains(shown.output, "particle 7 moves at 200 m/s"));
}

/// An error that the kernel knows nothing of, of the driver or of a disk.
TEST(Summary, saysThatAnyErrorHasStoppedTheRun) {
    const TestFolder folder;
    Watched<Rough> scene(folder.name());
    scene.event = [](auto&) { throw InputError("The disk of this test is full."); };
    EXPECT_EQ(support::refusal([&] { scene.softly().solve(); }), "The disk of this test is full.");
    const auto shown = show(folder);
    EXPECT_EQ(shown.exitCode, 2);
    EXPECT_TRUE(contains(shown.output, "NOT WELL: it stopped: The disk of this test is full."));
}

// A run that wrote its summary every 9 s is not heard of for ten times that.
TEST(Summary, saysThatARunMayHaveEndedUnheard) {
    const TestFolder folder;
    Watched<Rough> scene(folder.name());
    scene.softly().solve();
    const std::string file = folder.name() + "-summary.csv", end = "state,at its end,";
    std::string text = contentOf(file);
    text.replace(text.find(end), end.size(), "state,on its way,") +=
        "wall time since the summary before,9,s\n";
    std::ofstream(file) << text;
    EXPECT_TRUE(contains(show(folder).output, "healthy, and on its way"));
    for (const auto& [age, code] : {std::pair{80, 0}, {100, 2}}) {
        const auto now = std::filesystem::file_time_type::clock::now();
        std::filesystem::last_write_time(file, now - std::chrono::seconds(age));
        const auto shown = show(folder);
        EXPECT_EQ(shown.exitCode, code) << shown.output;
        EXPECT_EQ(contains(shown.output, "s ago, and may not run any more"), code == 2);
    }
}

// In a process of its own, because a program that was asked to stop begins no other run.
TEST(Summary, saysThatARunWasAskedToStop) {
    const TestFolder folder;
    const auto run = [&] {
        Watched<Rough> scene(folder.name());
        scene.setQuiet(false);
        scene.event = [](auto&) { std::raise(SIGTERM); };
        try {
            scene.softly().solve();
        } catch (const RunStopped& stop) {
            std::_Exit(stop.exitCode);
        }
    };
    EXPECT_EXIT(run(), testing::ExitedWithCode(143),
                "state +asked to stop\n *reason +SIGTERM has stopped the run");
    const auto shown = show(folder);
    EXPECT_EQ(shown.exitCode, 0) << shown.output;
    EXPECT_TRUE(contains(shown.output, "healthy, and asked to stop"));
}

TEST(Summary, saysThatEnergyIsMissing) {
    const TestFolder folder;
    Watched<Rough> scene(folder.name());
    scene.solve();
    const std::string file = folder.name() + "-summary.csv";
    std::string text = contentOf(file);
    const std::string lost = "\nenergy unaccounted for,";
    ASSERT_TRUE(contains(text, lost));
    const std::size_t at = text.find(lost) + lost.size();
    text.replace(at, text.find('\n', at) - at, "1,J");  // beside some 1e-5 J
    std::ofstream(file) << text;
    const auto shown = show(folder);
    EXPECT_EQ(shown.exitCode, 2);
    EXPECT_TRUE(contains(shown.output, "J of energy are unaccounted for"));
}

// Bridges of 2e-12 to 6e-12 m^3 between radii of 0.98 to 1.46 mm: V* = V / R^3 with R = 2 r1 r2 / (r1 + r2).
// The largest is that of two small grains with the small grains' volume, or of the second species' volume on
// the smallest of its sizes: 6e-12 m^3 between two grains of r = 1.46 mm, or 4e-12 m^3 of a mixed pair.
TEST(Summary, warnsOfBridgesThatTheLawIsNotMadeFor) {
    constexpr double small = scenes::SettlingBox<Wet>::smallRadius,
                     large = scenes::SettlingBox<Wet>::largeRadius,
                     between = 2 * small * large / (small + large);
    const auto cube = [](double x) { return x * x * x; };
    const double mostAtGrains = std::max({2e-12 / cube(small), 4e-12 / cube(between), 6e-12 / cube(large)});
    ASSERT_GT(mostAtGrains, LiquidBridgeWillett::madeForVolume.highest);
    const TestFolder folder;
    Watched<Wet> scene(folder.name());
    scene.setQuiet(false);
    const std::string printed = printedBy(scene);
    const std::string warning = fmt::format(
        "Warning: LiquidBridgeWillett: V* = {:.4g}; it is made for greater than 0 and at most 0.001",
        mostAtGrains);
    const auto first = printed.find(warning), last = printed.rfind(warning);
    EXPECT_TRUE(contains(printed, warning));
    EXPECT_NE(first, last) << "at set-up and at the end";
    std::size_t bridges = 0, out = 0;
    const auto& grains = scene.particleHandler.store();
    scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        const ObservedContact seen = scene.contacts().observe(grains, bucket, contact);
        if (!seen.bridged) return;
        const auto radius = [&](std::uint32_t k) { return grains.translation[grains.place[k]].radius; };
        const double r1 = radius(seen.particle1);
        const double size =
            bucket.wall >= 0 ? 2 * r1 : 2 * r1 * radius(seen.particle2) / (r1 + radius(seen.particle2));
        const double volume =
            scene.speciesHandler.mixture(bucket.species1, bucket.species2).getLiquidBridgeVolume();
        ++bridges;
        out += volume / cube(size) > 1e-3 ? 1 : 0;
    });
    EXPECT_GT(bridges, out);
    EXPECT_GT(out, 0u);
    EXPECT_TRUE(contains(printed, fmt::format("bridges                              {}\n", bridges)));
    EXPECT_TRUE(contains(printed, fmt::format("({} bridges now out of its domain)", out)));
    EXPECT_TRUE(contains(show(folder).output, "NOT WELL: LiquidBridgeWillett: V* ="));
}

TEST(Summary, doesNotChangeTheTrajectory) {
    const TestFolder folder;
    Watched<Rough> with(folder.name());
    scenes::SettlingBox<Rough> without(3);
    without.setTimeMax(with.getTimeMax());
    with.solve(), without.solve();
    EXPECT_EQ(stateHash(with.particleHandler.store()), stateHash(without.particleHandler.store()));
}

// A sleep lasts at least as long as it was to, on a busy machine too. Steps of 43 ms are all measured.
TEST(Summary, countsTheTimeOfEachPart) {
    using Part = StepTimes::Part;
    using std::chrono::milliseconds;
    const std::array<std::pair<Part, milliseconds>, 7> parts{{{Part::Motion, milliseconds(4)},
                                                              {Part::Search, milliseconds(16)},
                                                              {Part::Contacts, milliseconds(1)},
                                                              {Part::Walls, milliseconds(8)},
                                                              {Part::Sum, milliseconds(2)},
                                                              {Part::Ledger, milliseconds(12)},
                                                              {Part::Output, milliseconds(6)}}};
    constexpr int steps = 3;
    StepTimes times;
    times.measure();
    for (int step = 0; step < steps; ++step) {
        times.beginStep();
        for (const auto& [part, sleep] : parts) {
            if (part == Part::Output) times.enter(Part::Other), times.endStep();
            const Part before = times.enter(part);
            std::this_thread::sleep_for(sleep);
            if (part == Part::Output) times.enter(before);
        }
    }
    const auto seconds = times.seconds();
    for (const auto& [part, sleep] : parts) {
        const double slept = steps * 1e-3 * static_cast<double>(sleep.count());
        EXPECT_GE(seconds[static_cast<std::size_t>(part)], slept * (1 - 1e-9))
            << StepTimes::names[static_cast<std::size_t>(part)];
    }
}

// The parts of the step make up the time, also where most steps are not measured.
TEST(Summary, countsTheWholeTime) {
    using Part = StepTimes::Part;
    StepTimes times;
    times.measure();
    for (int step = 0; step < 20000; ++step) {
        times.beginStep();
        for (const Part part :
             {Part::Motion, Part::Search, Part::Contacts, Part::Walls, Part::Sum, Part::Ledger, Part::Other})
            times.enter(part);
        times.endStep();
    }
    times.enter(Part::Output), times.enter(Part::Other);
    const double before = times.total();
    double sum = 0;
    for (const double part : times.seconds()) {
        EXPECT_GE(part, 0);
        sum += part;
    }
    EXPECT_GE(sum, before * (1 - 1e-12));
    EXPECT_LE(sum, times.total() * (1 + 1e-12));
}

TEST(Summary, refusesAFolderWithoutRuns) {
    const TestFolder folder;
    support::expectOneSentence(support::run(tool + " " + folder.name()), "cannot be read");
    support::expectOneSentence(show(folder), "has no summary of a run");
}

}  // namespace
}  // namespace pendular::summaryTest
