// Liquid that moves between grains, bridges and walls which ranks share: the same bits, and none lost.
#include <gtest/gtest.h>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Ranks/SharedInlets.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Scenes/CubicLattice.h"
#include "SelfTests/Support/Random.h"

namespace pendular::sharedLiquidTest {
namespace {

using ranks::expectSameOnRanks;
using Law = Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeBagheri>>;
using Box = wet::WetBox<Law>;
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

/// Grains with films come, and more of them than the quantum was made for are refused.
void letWetGrainsIn(Box& scene) {
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    grain.setLiquidVolume(2e-12);
    Inlet inlet;
    inlet.setGrain(grain);
    inlet.setSizes(evenSizes(1.8e-3, 2.1e-3));
    inlet.setRegion(BoxRegion({0.001, 0.001, 0.0125}, {0.0115, 0.0115, 0.015}));
    inlet.setNumberFlow(5000);
    scene.inletHandler.copyAndAddObject(inlet);
    scene.setTimeMax(1);
}

TEST(SharedLiquid, comesWithGrains) { expectSameOnRanks(800, box<Box>(4, letWetGrainsIn), {2, 3, 7}); }

void spray(Box& scene) {
    scene.sprayHandler.copyAndAddObject(ranks::rainFrom(0.0145));
    scene.setTimeMax(0.01);
}

TEST(SharedLiquid, comesByASpray) {
    std::size_t byGrains = 0, byWalls = 0, lost = 0;
    box<Box>(4, spray)([&](Box& scene) {
        scene.initialise();
        for (int k = 0; k < 600; ++k) {
            scene.step();
            for (const CaughtDroplet& one : scene.sprayHandler.caught())
                ++(one.particle != CaughtDroplet::none ? byGrains : one.wall >= 0 ? byWalls : lost);
        }
    });
    EXPECT_GT(byGrains, 50u);
    EXPECT_GT(byWalls, 0u);
    EXPECT_GT(lost, 0u);
    expectSameOnRanks(600, box<Box>(4, spray), {2, 3, 7});
}

/// Films weigh so much that the motion is another one; so do those of the grains of rigid bodies.
TEST(SharedLiquid, hasMass) {
    const auto wet = [](Box& scene) {
        scene.setLiquidDensity(1e6);
        spray(scene);
    };
    expectSameOnRanks(600, box<Box>(4, wet), {2, 3, 7});
    expectSameOnRanks(400,
                      box<Box>(4,
                               [=](Box& scene) {
                                   wet(scene);
                                   for (std::uint32_t k = 0; k + 1 < 64; k += 8)
                                       scene.bodyHandler.join({k, k + 1});
                                   scene.setTimeStep(0x1p-20);
                               }),
                      {3});
    Box light(4), heavy(4);
    spray(light), wet(heavy);
    for (Box* const scene : {&light, &heavy}) scene->initialise(), scene->step(600);
    EXPECT_NE(stateHash(light.particleHandler.store()), stateHash(heavy.particleHandler.store()));
}

/// Grains that nearly touch, in a box of wet walls. They are thrown into other directions again and again, so
/// that small bridges form and rupture all the time.
class ShakenBox : public Simulation<Law> {
public:
    explicit ShakenBox(int edge) {
        Law* const wet = speciesHandler.copyAndAddObject(wet::boxMaterial<Law>(1));
        wet->setLiquidBridgeVolumeMax(1e-13);
        support::Random random(1);
        for (int k = 0; k < edge * edge * edge; ++k) {
            SphericalParticle grain;
            grain.setSpecies(wet);
            grain.setRadius(random.uniform(0.9e-3, 1.03e-3));
            grain.setPosition(scenes::cellOfCube(k, edge, spacing));
            grain.setLiquidVolume(1e-12 + 1e-15 * k);
            particleHandler.copyAndAddObject(grain);
        }
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0}) {
                InfiniteWall wall;
                wall.setSpecies(wet);
                wall.set(side * Vec3D::Unit(axis),
                         side > 0 ? edge * spacing * Vec3D(1, 1, 1) : Vec3D(0, 0, 0));
                wallHandler.copyAndAddObject(wall);
            }
        setTimeStep(0x1p-17);
        setQuiet();
    }

private:
    static constexpr double spacing = 2.1e-3;  // m

    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 32 != 1) return;
        for (GrainReference grain : particleHandler.ownGrains()) {
            support::Random random(getNumberOfTimeSteps() + 1000003 * grain.getId());
            grain.setVelocity(random.inCube(0.5));
        }
    }
};

/// All that a scene has had is somewhere, after each step, with cuts that wander at each list.
/// @param leastRuptures so many bridges rupture
void expectNoneLost(int edge, double leastRuptures) {
    VirtualRanks(3).run([&](Exchange& exchange) {
        ShakenBox scene(edge);
        scene.setRanks(exchange, ranks::cutsWander);
        scene.listenToContacts();
        scene.initialise();
        double ruptures = 0;
        while (ruptures < leastRuptures) {
            for (int k = 0; k < 100; ++k) {
                scene.step();
                ASSERT_EQ(scene.liquidLedger().unaccounted(), 0) << "step " << scene.getNumberOfTimeSteps();
            }
            ruptures = static_cast<double>(scene.contactEventCounts().bridgesRuptured);
            ASSERT_LT(scene.getNumberOfTimeSteps(), 100000u) << "there are too few ruptures";
        }
        const LiquidLedger ledger = scene.liquidLedger();
        EXPECT_GT(ledger.bridges, 0);
        EXPECT_NE(ledger.walls, 0);
        if (exchange.rank() == 0)
            fmt::print("{} ruptures in {} steps\n", ruptures, scene.getNumberOfTimeSteps());
    });
}

TEST(SharedLiquid, noneIsLost) { expectNoneLost(4, 200); }
TEST(LongSharedLiquid, noneIsLost) { expectNoneLost(8, 100000); }

}  // namespace
}  // namespace pendular::sharedLiquidTest
