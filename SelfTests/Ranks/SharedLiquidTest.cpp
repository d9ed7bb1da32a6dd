// Liquid that moves between grains, bridges and walls which ranks share: the same bits, and none lost.
#include <gtest/gtest.h>

#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::sharedLiquidTest {
namespace {

using ranks::expectSameOnRanks;
using Box = wet::WetBox<Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeBagheri>>>;
using Film = Species<HertzianViscoelastic, NoFriction, ViscousLiquidMigrationWillett>;

template <class Scene, class SetUp>
auto box(int layers, SetUp&& setUp) {
    return [=](auto&& use) {
        Scene scene(layers);
        setUp(scene);
        use(scene);
    };
}

TEST(SharedLiquid, movesAtTouchesAndRuptures) {
    expectSameOnRanks(1500, box<Box>(6, [](Scene& scene) { scene.listenToContacts(); }));
}

/// Bridges that form where films meet, whose thickness ghosts need.
TEST(SharedLiquid, movesWhereFilmsMeet) {
    expectSameOnRanks(
        800,
        box<wet::WetBox<Film>>(4,
                               [](auto& scene) {
                                   for (const std::size_t kind : {0, 1}) {
                                       Film& material = *scene.speciesHandler.getObject(kind);
                                       material.setViscosity(1e-3);
                                       material.setRoughness(1e-6);
                                       material.setFormsAtFilmContact(true);
                                       material.setLiquidBridgeVolumeMax(kind == 0 ? 4e-11 : 6e-11);
                                   }
                                   for (auto&& grain : scene.particleHandler)
                                       grain.setLiquidVolume(8e-11 + 1e-15 * grain.getId());
                                   scene.acceptUnstableTimeStep();
                               }),
        {2, 3, 7});
}

TEST(SharedLiquid, dries) {
    expectSameOnRanks(1000,
                      box<Box>(4,
                               [](Scene& scene) {
                                   Evaporation law;
                                   law.setFlux(1e-6);
                                   scene.setEvaporation(law);
                               }),
                      {2, 3});
}

TEST(SharedLiquid, isInTheEnergyLedger) {
    expectSameOnRanks(300, box<Box>(4, [](Scene& scene) { scene.keepEnergyLedger(); }), {3});
}

TEST(SharedLiquid, goesWithGrainsThatLeave) {
    expectSameOnRanks(1200,
                      box<Box>(4,
                               [](Scene& scene) {
                                   Outlet outlet;
                                   outlet.setPlane({0, 0, -1}, {0, 0, 0.003});
                                   scene.outletHandler.copyAndAddObject(outlet);
                               }),
                      {3});
}

/// All that a scene has had is somewhere, after each step, with cuts that wander at each list.
void expectNoneLost(int steps) {
    VirtualRanks(3).run([&](Exchange& exchange) {
        Box scene(6);
        scene.setRanks(exchange, ranks::cutsWander);
        scene.listenToContacts();
        scene.initialise();
        for (int k = 0; k < steps; ++k) {
            scene.step();
            const LiquidLedger ledger = scene.liquidLedger();
            ASSERT_EQ(ledger.unaccounted(), 0) << "step " << k;
            if (k % 100 != 0) continue;
            for (auto&& grain : scene.particleHandler) {  // ruptures go on
                const double up = scene.getNumberOfTimeSteps() % 200 == 0 ? 0.6 : -0.3;
                grain.setVelocity(grain.getVelocity() + Vec3D(0, 0, grain.getId() % 2 == 0 ? up : 0));
            }
        }
        const double ruptures =
            scene.sumOverRanks(static_cast<double>(scene.contactEventCounts().bridgesRuptured));
        EXPECT_GT(ruptures, steps / 50);
        if (exchange.rank() == 0) fmt::print("{} ruptures in {} steps\n", ruptures, steps);
    });
}

// Its accounts are those of each rank: they are refused rather than written wrong.
TEST(SharedLiquid, isNotGatheredYet) {
    const auto expectRefused = [](auto&& run) {
        const std::string told = support::refusal([&] {
            VirtualRanks(2).run([&](Exchange& exchange) {
                Box scene(1);
                scene.setRanks(exchange, {});
                run(scene);
            });
        });
        EXPECT_TRUE(support::isOneSentence(told)) << told;
        EXPECT_TRUE(support::contains(told, "in which liquid moves")) << told;
    };
    expectRefused([](Box& scene) { scene.setTimeMax(1), scene.solve(); });
    expectRefused([](Box& scene) { scene.initialise(), scene.step(), scene.gather(); });
}

TEST(SharedLiquid, noneIsLost) { expectNoneLost(1000); }
TEST(LongSharedLiquid, noneIsLost) { expectNoneLost(200000); }

}  // namespace
}  // namespace pendular::sharedLiquidTest
