// Scenes that several ranks share: they do the same, bit for bit, as on one.
#include <gtest/gtest.h>

#include <algorithm>

#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Observables/Clusters.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/PendularState.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/MovingBenchmark.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::sharedSceneTest {
namespace {

using ranks::cutsStay;
using ranks::cutsWander;
using ranks::expectSameOnRanks;
using ranks::Outcome;
using ranks::runOnRanks;
using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
using Smooth = LinearViscoelasticSpecies;

template <class S>
auto box(int layers, int threads = 1) {
    return [=](auto&& use) {
        scenes::SettlingBox<S> scene(layers);
        scene.setNumberOfThreads(threads);
        use(scene);
    };
}

/// The speeds of a dense cloud are those of grains at rest; contacts are to be listed again soon.
void letFly(Scene& scene) {
    for (GrainReference grain : scene.particleHandler) grain.setVelocity(20 * grain.getVelocity());
}

TEST(SharedScene, boxOfWetGrains) { expectSameOnRanks(1000, box<Wet>(8)); }
TEST(SharedScene, boxOfSmoothGrains) { expectSameOnRanks(1000, box<Smooth>(8)); }
TEST(SharedScene, boxOfWetGrainsOnTwoThreadsEach) { expectSameOnRanks(400, box<Wet>(8, 2)); }
TEST(SharedScene, periodicCloud) {
    expectSameOnRanks(1000, [](auto&& use) {
        scenes::ShearedCloud<Wet> scene({});
        letFly(scene);
        use(scene);
    });
}

TEST(SharedScene, periodicGas) {
    expectSameOnRanks(1200, [](auto&& use) {
        Simulation<Smooth> scene;
        scenes::fillWithGas(scene, scene.speciesHandler.copyAndAddObject(scenes::boxMaterial<Smooth>(0)),
                            216);
        scene.setTimeStep(0x1p-17);  // grains fly twice as far as they were apart
        use(scene);
    });
}

/// Bridges that remember how their grains moved.
TEST(SharedScene, viscousBridges) {
    using Viscous = HertzianViscoelasticMindlinViscousLiquidBridgeWillettSpecies;
    expectSameOnRanks(600, [](auto&& use) {
        Viscous material = scenes::boxMaterial<Viscous>(0);
        material.setViscosity(1e-2);
        material.setRoughness(1e-5);
        scenes::ShearedCloud<Viscous> scene({}, 1, material);
        letFly(scene);
        use(scene);
    });
}

// Contacts feel accelerations, so that ghosts need them.
TEST(SharedScene, springsInTheStep) {
    expectSameOnRanks(600, [](auto&& use) {
        scenes::SettlingBox<Wet> scene(6);
        scene.setIntegrator(integrators::springsInStep);
        use(scene);
    });
}

/// Takes the accelerations (the last 48 of 120 bytes) out of what ghosts get in each step.
class WithoutAccelerations : public Exchange {
public:
    explicit WithoutAccelerations(Exchange& of) : inner(of) {}

    [[nodiscard]] std::size_t rank() const override { return inner.rank(); }
    [[nodiscard]] std::size_t count() const override { return inner.count(); }
    [[nodiscard]] std::vector<Message> swap(std::vector<Message> toEach) override {
        return inner.swap(std::move(toEach));
    }
    [[nodiscard]] std::vector<Message> swapWithNeighbours(
        std::vector<Message> toEach, const std::vector<std::size_t>& bytesFromEach) override {
        for (Message& message : toEach) {
            std::string bytes(message.all());
            for (std::size_t grain = 0; grain + 120 <= bytes.size(); grain += 120)
                std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(grain) + 72, 48, '\0');
            message = Message(bytes);
        }
        return inner.swapWithNeighbours(std::move(toEach), bytesFromEach);
    }
    [[nodiscard]] double largest(double own) override { return inner.largest(own); }

private:
    Exchange& inner;
};

// The tests above see what is missing: 72 bytes are not enough where springs work in the step.
TEST(SharedScene, isAnotherOneWhereGhostsLackAccelerations) {
    const auto outcome = [](const Integrator& scheme, auto run) {
        return run([&](auto&& use) {
            scenes::SettlingBox<Wet> scene(6);
            scene.setIntegrator(scheme);
            use(scene);
        });
    };
    const auto whole = [](auto&& make) { return runOnRanks(3, cutsStay, 600, make).hash; };
    const auto lacking = [](auto&& make) {
        return runOnRanks<WithoutAccelerations>(3, cutsStay, 600, make).hash;
    };
    EXPECT_NE(outcome(integrators::springsInStep, lacking), outcome(integrators::springsInStep, whole));
}

/// A cloud that is stirred, so that contacts are listed again and again.
class StirredCloud : public scenes::ShearedCloud<Wet> {
public:
    StirredCloud() : ShearedCloud({}) { letFly(*this); }

private:
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 2000 != 0) return;
        for (GrainReference grain : particleHandler.ownGrains()) {
            const auto id = static_cast<int>(grain.getId());
            grain.setVelocity(0.5 * Vec3D(id % 3 - 1, id / 3 % 3 - 1, id / 9 % 3 - 1));
        }
    }
};

// Cuts that wander until grains have changed their rank 10^5 times.
TEST(LongSharedScene, wanders) {
    constexpr std::size_t steps = 80000;
    const auto make = [](auto&& use) {
        StirredCloud scene;
        use(scene);
    };
    const std::uint64_t expected = runOnRanks(1, cutsStay, steps, make).hash;
    for (const std::size_t ranks : {2u, 4u}) {
        const Outcome found = runOnRanks(ranks, cutsWander, steps, make);
        EXPECT_EQ(found.hash, expected);
        EXPECT_GT(found.counts.migrated, ranks == 4 ? 100000u : 30000u);
        fmt::print("{} ranks: {} changes of owner, {} contacts held twice, {} lists\n", ranks,
                   found.counts.migrated, found.counts.heldTwice, found.counts.lists);
        EXPECT_GT(found.counts.heldTwice, 4000u);
        EXPECT_EQ(found.counts.unequal, 0u);
    }
}

/// One grain that is larger than the parts of all ranks, between small ones: all of them have it as a ghost.
TEST(SharedScene, oneGrainThatIsLargerThanAllParts) {
    std::vector<scenes::GrainMotion> grains{{.radius = 8e-3, .position = {0, 0, 0}, .velocity = {0.3, 0, 0}}};
    for (int k = 0; k < 60; ++k) {
        const double angle = 0.6 * k, height = 2.2e-3 * (k / 10) - 5.5e-3;
        grains.push_back({.radius = 0.5e-3,
                          .position = {0.0095 * std::cos(angle), 0.0095 * std::sin(angle), height},
                          .velocity = {-2 * std::cos(angle), -2 * std::sin(angle), -100 * height}});
    }
    expectSameOnRanks(800, [&](auto&& use) {
        scenes::FewGrains<Smooth> scene(scenes::boxMaterial<Smooth>(0), grains, 0x1p-19);
        use(scene);
    });
}

TEST(SharedScene, fewerGrainsThanRanks) {
    const std::vector<scenes::GrainMotion> grains{{.position = {0, 0, 0}, .velocity = {1, 0, 0}},
                                                  {.position = {2.1e-3, 0.5e-3, 0}},
                                                  {.position = {4.3e-3, 0, 0}, .velocity = {-1, 0, 0}}};
    const auto make = [&](auto&& use) {
        scenes::FewGrains<Wet> scene(scenes::boxMaterial<Wet>(0), grains, 0x1p-19);
        use(scene);
    };
    const std::uint64_t expected = runOnRanks(1, cutsStay, 1500, make).hash;
    for (const RankOptions& options : {cutsStay, cutsWander}) {
        const Outcome found = runOnRanks(7, options, 1500, make);
        EXPECT_EQ(found.hash, expected);
        EXPECT_EQ(found.fewest, 0u);
        EXPECT_EQ(found.grains, 3u);
    }
}

// The left one of three grains flies to the others: in the end its rank has none, and contacts are the
// other's.
TEST(SharedScene, aRankLosesItsLastGrain) {
    const std::vector<scenes::GrainMotion> grains{{.position = {0, 0, 0}, .velocity = {2.5, 0, 0}},
                                                  {.position = {4e-3, 0.4e-3, 0}, .velocity = {1, 0, 0}},
                                                  {.position = {6.2e-3, 0, 0}, .velocity = {1, 0, 0}}};
    const auto make = [&](auto&& use) {
        scenes::FewGrains<Wet> scene(scenes::boxMaterial<Wet>(0), grains, 0x1p-19);
        use(scene);
    };
    EXPECT_EQ(runOnRanks(2, cutsStay, 1, make).fewest, 1u);
    for (const std::size_t steps : {300u, 1500u}) {
        const Outcome found = runOnRanks(2, cutsStay, steps, make);
        EXPECT_EQ(found.hash, runOnRanks(1, cutsStay, steps, make).hash);
        EXPECT_EQ(found.fewest, steps == 300 ? 1u : 0u);
    }
}

// A rank has no other ghosts than those that are as near to one of its grains as the farthest of its listed
// pairs are to each other; it has all of these.
TEST(SharedScene, hasTheFewestGhosts) {
    std::array<TranslationRecord, 128> whole{};
    std::mutex mutex;
    RankCounts sums;
    VirtualRanks(4).run([&](Exchange& exchange) {
        scenes::SettlingBox<Smooth> scene(8);
        scene.setQuiet();
        scene.setRanks(exchange, {});
        scene.initialise();
        scene.step(800);
        const std::size_t lists = scene.contacts().rebuildCount();
        while (scene.contacts().rebuildCount() == lists) scene.step();  // grains are where they were listed
        const ParticleStore& grains = scene.particleHandler.store();
        {
            const std::lock_guard lock(mutex);
            for (const std::uint32_t place : grains.place)
                whole[grains.identity[place]] = grains.translation[place];
        }
        static_cast<void>(exchange.largest(0));  // all have told
        const auto gapOf = [](const TranslationRecord& a, const TranslationRecord& b) {
            return norm(a.position - b.position) - a.radius - b.radius;
        };
        double farthest = -1;  // m
        scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            if (bucket.wall < 0)
                farthest = std::max(farthest, gapOf(grains.translation[scene.contacts().firstOf(contact)],
                                                    grains.translation[scene.contacts().secondOf(contact)]));
        });
        EXPECT_GT(farthest, 0);
        for (std::uint32_t identity = 0; identity < whole.size(); ++identity) {
            if (grains.place.contains(identity)) continue;
            const bool isNear = std::ranges::any_of(grains.place, [&](std::uint32_t own) {
                return gapOf(grains.translation[own], whole[identity]) <= farthest * (1 + 1e-9);
            });
            const std::uint32_t place = grains.ghostPlace[identity];
            EXPECT_EQ(place != PlaceIndex::none && !grains.isGap(place), isNear) << identity;
        }
        const std::lock_guard lock(mutex);
        sums.asked += scene.rankCounts().asked, sums.ghosts += scene.rankCounts().ghosts;
    });
    EXPECT_GT(sums.ghosts, 0u);
    EXPECT_LT(sums.ghosts, sums.asked);
    fmt::print("{} of {} copies are in contacts\n", sums.ghosts, sums.asked);
}

class HeavySharedBenchmark : public testing::TestWithParam<const char*> {};

TEST_P(HeavySharedBenchmark, hasTheSameBits) {
    const support::TestFolder folder;
    const auto choice = scenes::smallBenchmark(GetParam(), folder.path());
    const auto make = [&](auto&& use) { scenes::withMovingBenchmark(choice, 1, use); };
    expectSameOnRanks(500, make, {3, 7});
}
INSTANTIATE_TEST_SUITE_P(All, HeavySharedBenchmark, testing::Values("wet-bed", "drum"),
                         scenes::benchmarkTestName);

/// All of them, on any number of ranks and threads.
class LongSharedBenchmark : public testing::TestWithParam<const char*> {};

TEST_P(LongSharedBenchmark, hasTheSameBits) {
    const support::TestFolder folder;
    const auto choice = scenes::smallBenchmark(GetParam(), folder.path());
    for (const int threads : {1, 2})
        expectSameOnRanks(
            1000, [&](auto&& use) { scenes::withMovingBenchmark(choice, threads, use); }, {1, 2, 3, 4, 7},
            choice.scene == "gas");
}
INSTANTIATE_TEST_SUITE_P(All, LongSharedBenchmark, scenes::benchmarkScenes(), scenes::benchmarkTestName);

// What ranks cannot share yet is refused, by all of them.

template <class SetUp>
std::string refusalOnRanks(SetUp&& setUp) {
    return support::refusal([&] {
        VirtualRanks(2).run([&](Exchange& exchange) {
            scenes::SettlingBox<Wet> scene(1);
            scene.setQuiet();
            scene.setRanks(exchange, {});
            setUp(scene);
        });
    });
}

struct NoPart : StepPart {
    [[nodiscard]] std::string_view name() const override { return "no part"; }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}  // it has no settings
};

TEST(SharedScene, refusesWhatRanksCannotShareYet) {
    const auto expectRefused = [](auto&& change, std::string_view part) {
        const std::string told = refusalOnRanks([&](auto& scene) {
            change(scene);
            scene.initialise();
        });
        EXPECT_TRUE(support::isOneSentence(told)) << told;
        EXPECT_TRUE(support::contains(told, part)) << told;
        EXPECT_TRUE(support::contains(told, "setRanks()")) << told;
    };
    expectRefused([](auto& scene) { scene.template addPart<NoPart>(); }, "addPart()");
    EXPECT_EQ(refusalOnRanks([](auto& scene) { scene.initialise(); }), "");
}

TEST(SharedScene, refusesToTellOfAllGrainsWhatARankCannotKnow) {
    const auto expectRefused = [](auto&& ask) {
        const std::string told = refusalOnRanks([&](auto& scene) {
            scene.initialise();
            scene.step(10);
            static_cast<void>(ask(scene));
        });
        EXPECT_TRUE(support::isOneSentence(told)) << told;
        EXPECT_TRUE(support::contains(told, "setRanks()")) << told;
    };
    expectRefused([](auto& scene) { return clustersOfContacts(scene); });
    expectRefused([](auto& scene) { return clustersWithin(scene, 1e-5); });
    expectRefused([](auto& scene) { return pendularState(scene, true); });
    expectRefused([](auto& scene) { return scene.stabilityAdvice(); });
    expectRefused([](auto& scene) { return stateOf(scene); });
}

/// Clusters, figures of bridges, advice on the time step, and the number of grains that fields are made of.
template <class S>
std::vector<double> figuresOf(S& scene) {
    std::vector<double> figures;
    for (const Clusters& clusters : {clustersOfContacts(scene), clustersWithin(scene, 2.4e-3)}) {
        figures.push_back(static_cast<double>(clusters.list.size()));
        for (const Cluster& one : clusters.list)
            figures.insert(figures.end(),
                           {static_cast<double>(one.size), one.gyrationRadius, one.bridgeVolume});
    }
    const PendularState liquid = pendularState(scene, true);
    figures.insert(figures.end(), {liquid.liquidOverSolid, liquid.bridgesOfAGrain, liquid.overlappingShare});
    const StabilityAdvice advice = scene.stabilityAdvice();
    figures.insert(figures.end(), {advice.step, advice.byOverlap, advice.byNeighbours, advice.meanOverlap,
                                   advice.contactsOfGrain, advice.slidingShare, advice.overlapOfThis});
    figures.push_back(static_cast<double>(stateOf(scene).grains.size()));
    return figures;
}

TEST(SharedScene, tellsOfAllGrainsAfterGathering) {
    constexpr std::size_t steps = 900;
    scenes::SettlingBox<Wet> alone(4);
    alone.initialise();
    alone.step(steps);
    const std::vector<double> expected = figuresOf(alone);
    EXPECT_GT(alone.contacts().counts().acting, 64u);
    VirtualRanks(3).run([&](Exchange& exchange) {
        scenes::SettlingBox<Wet> scene(4);
        scene.setQuiet();
        scene.setRanks(exchange, cutsWander);
        scene.initialise();
        scene.step(steps);
        scene.gather();
        EXPECT_EQ(figuresOf(scene), expected);
    });
}

TEST(SharedScene, refusesEachConflictInOneSentence) {
    for (const Conflict& conflict : conflictsOfRanks()) {
        const std::string told = support::refusal([&] {
            refuseConflicts({conflict.a, conflict.b}, conflictsOfRanks());
        });
        EXPECT_TRUE(support::isOneSentence(told)) << told;
    }
}

TEST(SharedScene, refusesChangesInARun) {
    const auto run = [](auto&& change) {
        VirtualRanks(2).run([&](Exchange& exchange) {
            scenes::SettlingBox<Wet> scene(1);
            scene.setQuiet();
            scene.setRanks(exchange, {});
            scene.initialise();
            scene.step();
            change(scene);
            scene.step();
        });
    };
    EXPECT_THROW(run([](auto& scene) { scene.setTimeStep(0x1p-18); }), RunError);
    EXPECT_THROW(run([](auto& scene) {
                     if (scene.particleHandler.contains(0)) scene.particleHandler.removeObject(0);
                 }),
                 InputError);
    EXPECT_NO_THROW(run([](auto& scene) { scene.setGravity({0, 0, -1}); }));
}

// Each rank asks for all grains, of which it has some.
TEST(SharedScene, saysThatAGrainIsOnAnotherRank) {
    VirtualRanks(3).run([&](Exchange& exchange) {
        scenes::SettlingBox<Wet> scene(1);
        scene.setQuiet();
        const std::size_t count = scene.particleHandler.getSize();
        scene.setRanks(exchange, {});
        scene.initialise();
        std::size_t here = 0;
        for (std::size_t identity = 0; identity < count; ++identity) {
            const std::string told =
                support::refusal([&] { static_cast<void>(scene.particleHandler.getObject(identity)); });
            EXPECT_EQ(told.empty(), scene.particleHandler.contains(identity)) << told;
            if (told.empty()) ++here;
            else EXPECT_TRUE(support::contains(told, "is on another rank")) << told;
        }
        EXPECT_LT(here, count);
        EXPECT_EQ(scene.sumOverRanks(static_cast<double>(here)), static_cast<double>(count));
        EXPECT_TRUE(support::contains(
            support::refusal([&] { static_cast<void>(scene.particleHandler.getObject(count)); }),
            "There is no particle"));
    });
}

}  // namespace
}  // namespace pendular::sharedSceneTest
