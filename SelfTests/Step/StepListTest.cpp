#include "Kernel/Core/Step/StepList.h"

#include <gtest/gtest.h>

#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/MercuryNames.h"
#include "Kernel/Scene/Simulation.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::stepListTest {
namespace {

using S = LinearViscoelasticSlidingFrictionSpecies;

S material() {
    S species;
    species.setDensity(2500), species.setStiffness(200), species.setDissipation(2e-3);
    species.setSlidingStiffness(60), species.setSlidingDissipation(2e-3);
    species.setSlidingFrictionCoefficient(0.5);
    return species;
}

/// Writes down what it is called for; throws in one phase of one step, if that is asked for.
struct Diary : StepPart {
    Diary(std::string itsName, std::vector<std::string>& book, std::string failure = {},
          std::size_t failsAfter = 0)
        : title(std::move(itsName)), pages(book), failsIn(std::move(failure)), failsAt(failsAfter) {}

    [[nodiscard]] std::string_view name() const override { return title; }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}  // it has no settings
    void note(const StepContext& step, const std::string& phase) {
        pages.push_back(title + ' ' + phase);
        if (phase == failsIn && step.number == failsAt && step.length > 0) throw InputError("a fault.");
    }
    void prepare(StepContext& step) override { note(step, "prepare"); }
    void beforeMotion(StepContext& step) override { note(step, "beforeMotion"); }
    void moveGrains(StepContext& step) override { note(step, "moveGrains"); }
    void moveSurroundings(StepContext& step) override { note(step, "moveSurroundings"); }
    void afterMotion(StepContext& step) override { note(step, "afterMotion"); }
    void afterForces(StepContext& step) override { note(step, "afterForces"); }
    void accelerate(StepContext& step) override { note(step, "accelerate"); }
    void finish(StepContext& step) override { note(step, "finish"); }
    void atEnd(StepContext& step) override { note(step, "atEnd"); }
    void takeBack(StepContext& step) override { note(step, "takeBack"); }

    std::string title;
    std::vector<std::string>& pages;
    std::string failsIn;
    std::size_t failsAt;
};

/// Three grains that touch, on their way.
struct Scene3 : scenes::FewGrains<S> {
    Scene3()
        : FewGrains<S>(material(),
                       {{.radius = 1e-3, .velocity = {0.1, 0, 0}},
                        {.radius = 1e-3, .position = {1.99e-3, 1e-4, 0}, .spin = {0, 0, 20}},
                        {.radius = 1e-3, .position = {1e-3, 1.8e-3, 0}, .velocity = {0, -0.1, 0.02}}},
                       1e-5) {
        setQuiet();
    }
    [[nodiscard]] std::uint64_t hash() { return stateHash(particleHandler.store()); }
};

const std::vector<std::string> phases{"prepare",          "beforeMotion", "moveGrains",
                                      "moveSurroundings", "afterMotion",  "afterForces",
                                      "accelerate",       "finish",       "atEnd"};

TEST(StepList, callsItsPartsPhaseByPhase) {
    std::vector<std::string> book, expected;
    Scene3 scene;
    scene.addPart<Diary>("first", book);
    scene.addPart<Diary>("second", book);
    scene.initialise();
    book.clear();
    scene.step();
    for (const std::string& phase : phases)
        for (const char* const part : {"first ", "second "}) expected.push_back(part + phase);
    EXPECT_EQ(book, expected);
}

TEST(StepList, callsNoPartThatSleeps) {
    struct Sleeper : Diary {
        using Diary::Diary;
        [[nodiscard]] Features features(const StepContext&) const override { return {}; }
    };
    std::vector<std::string> book;
    Scene3 scene;
    scene.addPart<Sleeper>("sleeper", book);
    scene.initialise();
    scene.step();
    EXPECT_TRUE(book.empty());
}

TEST(StepList, takesAFailedStepBackInTheOppositeOrder) {
    for (std::size_t k = 1; k < 7; ++k) {  // from beforeMotion to accelerate
        std::vector<std::string> book;
        Scene3 scene, whole;
        scene.keepEnergyLedger(), whole.keepEnergyLedger();
        scene.addPart<Diary>("first", book);
        scene.addPart<Diary>("second", book, phases[k], 3);
        scene.run(3);
        whole.run(3);
        book.clear();
        EXPECT_THROW(scene.step(), RunError) << phases[k];
        ASSERT_GE(book.size(), 2u);
        EXPECT_EQ(book[book.size() - 2], "second takeBack");
        EXPECT_EQ(book.back(), "first takeBack");
        EXPECT_EQ(scene.getNumberOfTimeSteps(), 3u);
        // What is undone is undone to round-off; 1e-12 of the size of a step's numbers is far above it.
        for (std::size_t i = 0; i < 3; ++i) {
            const scenes::GrainMotion now = scene.motion(i), then = whole.motion(i);
            EXPECT_LT((now.position - then.position).norm(), 1e-12 * 1e-3) << phases[k];
            EXPECT_LT((now.velocity - then.velocity).norm(), 1e-12 * 0.1) << phases[k];
        }
        EXPECT_DOUBLE_EQ(scene.energyLedger().kinetic, whole.energyLedger().kinetic);
    }
}

TEST(StepList, refusesTwoPartsOfOneName) {
    std::vector<std::string> book;
    Scene3 scene;
    scene.addPart<Diary>("magnet", book);
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { scene.addPart<Diary>("magnet", book); })));
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { scene.addPart<Diary>("grains", book); })));
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { scene.addPart<Diary>("", book); })));
    scene.initialise();
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { scene.addPart<Diary>("late", book); })));
}

/// Pushes all grains with an acceleration that swings, and counts its steps.
struct Shaker : StepPart {
    [[nodiscard]] std::string_view name() const override { return "shaker"; }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}  // it has no settings
    [[nodiscard]] std::span<const Conflict> ownConflicts() const override {
        static constexpr Conflict walls{Feature::OwnPart, Feature::Walls, "the shaker has no floor",
                                        "leave the walls out"};
        return {&walls, 1};
    }
    void prepare(StepContext& step) override {
        phase += 0.1;
        for (GrainReference grain : step.particles) {
            const Vec3D before = grain.getVelocity();
            grain.setVelocity(before + step.length * std::cos(phase) * Vec3D(50, 0, 20));
            work += 0.5 * grain.getMass() * (grain.getVelocity().squaredNorm() - before.squaredNorm());
        }
    }
    void visitState(StateArchive& archive, StepContext& /*scene*/) override {
        archive.finite("phase", phase);
        archive.finite("work", work);
    }
    void addTo(SummaryRows& rows) const override { rows.addNumber("work of the shaker", work, "J"); }

    double phase = 0, work = 0;
};

TEST(OwnPart, goesOnFromARestartFileWithTheSameBits) {
    const support::TestFolder folder;
    const std::string file = folder.name() + ".h5";
    Scene3 whole, begun;
    const Shaker& shaker = whole.addPart<Shaker>();
    whole.run(40);
    begun.addPart<Shaker>();
    begun.run(15);
    begun.writeRestart(file);
    Scene3 goesOn;
    const Shaker& again = goesOn.addPart<Shaker>();
    goesOn.restartFrom(file);
    goesOn.run(25);
    EXPECT_EQ(goesOn.hash(), whole.hash());
    EXPECT_EQ(again.work, shaker.work);

    Scene3 without;
    without.restartFrom(file);
    const std::string told = support::refusal([&] { without.initialise(); });
    EXPECT_TRUE(support::contains(told, "shaker"));
}

TEST(OwnPart, hasItsWorkInTheLedger) {
    Scene3 scene;
    scene.keepEnergyLedger();
    const Shaker& shaker = scene.addPart<Shaker>();
    scene.initialise();
    const EnergyLedger& ledger = scene.energyLedger();
    const double atStart = ledger.closed();
    for (int k = 0; k < 200; ++k) scene.step();
    ASSERT_GT(std::abs(shaker.work), 1e-9);
    // Two sums of 200 terms of the kinetic energy, each with a relative round-off of 2^-53.
    EXPECT_NEAR(ledger.driver, shaker.work, 400 * 0x1p-53 * (ledger.kinetic + std::abs(shaker.work)));
    EXPECT_LT(std::abs(ledger.closed() - atStart), 1e-12 * ledger.kinetic);
}

TEST(OwnPart, isRefusedWithWhatItDoesNotGoTogetherWith) {
    Scene3 scene;
    scene.addPart<Shaker>();
    InfiniteWall floor;
    floor.set({0, 0, -1}, {0, 0, -1});
    floor.setSpecies(scene.speciesHandler.getObject(0));
    scene.wallHandler.copyAndAddObject(floor);
    const std::string told = support::refusal([&] { scene.initialise(); });
    EXPECT_TRUE(support::isOneSentence(told));
    for (const char* const part : {"(shaker)", "walls", "the shaker has no floor", "leave the walls out"})
        EXPECT_TRUE(support::contains(told, part));
}

TEST(OwnPart, hasItsRowInTheSummary) {
    Scene3 scene;
    scene.addPart<Shaker>();
    scene.run(1);
    SummaryRows rows;
    scene.addPartsTo(rows);
    EXPECT_TRUE(support::contains(rows.shown(), "work of the shaker"));
}

}  // namespace
}  // namespace pendular::stepListTest
