// What acts in the steps of a scene does the same, bit for bit, where ranks share its grains.
#include <gtest/gtest.h>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/Periodic/PavedFloor.h"
#include "SelfTests/Ranks/SharedInlets.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Scenes/ShearedCloud.h"

namespace pendular::sharedFeaturesTest {
namespace {

using ranks::expectSameOnRanks;
using Wet = HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies;
using Smooth = LinearViscoelasticSpecies;

/// A dense periodic cloud, to which setUp(scene) adds something.
template <class S, class SetUp>
auto cloud(std::optional<double> shearRate, SetUp&& setUp) {
    return [=](auto&& use) {
        scenes::ShearedCloud<S> scene(shearRate);
        scene.setQuiet();
        for (GrainReference grain : scene.particleHandler) {
            const Vec3D flow = scene.shearFlowAt(grain.getPosition());
            grain.setVelocity(flow + 20 * (grain.getVelocity() - flow));
        }
        setUp(scene);
        use(scene);
    };
}

template <class S, class SetUp>
auto box(int layers, SetUp&& setUp) {
    return [=](auto&& use) {
        scenes::SettlingBox<S> scene(layers);
        scene.setQuiet();
        setUp(scene);
        use(scene);
    };
}

void keepLedger(Scene& scene) { scene.keepEnergyLedger(); }

/// Grains of the box that are behind each other are joined: two, three, four of them.
void joinGrains(Scene& scene) {
    scene.setTimeStep(0x1p-20);
    for (std::uint32_t first = 0, size = 2; first + size < scene.particleHandler.getSize();
         first += size + 1, size = 2 + (size + 1) % 3) {
        std::vector<std::uint32_t> members;
        for (std::uint32_t k = 0; k < size; ++k) members.push_back(first + k);
        scene.bodyHandler.join(members);
    }
}

TEST(SharedFeatures, bridgesAtTheStart) {
    expectSameOnRanks(300, cloud<Wet>({}, [](Scene& scene) { scene.joinAtStart(2e-4); }));
}
TEST(SharedFeatures, shear) {
    expectSameOnRanks(600, cloud<Wet>(200.0, [](Scene&) {}));
}
TEST(SharedFeatures, strain) {
    expectSameOnRanks(600, cloud<Wet>({}, [](Scene& scene) {
                          scene.setStrainRate(0, 3);
                          scene.setStrainRate(2, -4);
                      }));
}

TEST(SharedFeatures, eventsOfContacts) {
    expectSameOnRanks(400, cloud<Wet>({}, [](Scene& scene) { scene.listenToContacts(); }));
}

constexpr double servoTime = 100 * 0x1p-20;  // s

void setTargets(Scene& scene) {
    for (int axis = 0; axis < 3; ++axis) scene.setTargetStress(axis, 200, servoTime);
}
void shearByServo(Scene& scene) { scene.setTargetShearStress(50, servoTime); }

TEST(SharedFeatures, servosOfTheStress) {
    expectSameOnRanks(600, cloud<Wet>({}, setTargets));
    expectSameOnRanks(600, cloud<Wet>(20.0, shearByServo), {1, 3});
}
TEST(LongSharedFeatures, servosOfTheStressOverManySteps) {
    expectSameOnRanks(10000, cloud<Wet>({}, setTargets), {3, 7});
    expectSameOnRanks(10000, cloud<Wet>(20.0, shearByServo), {3, 7});
}

void adapt(Scene& scene) { scene.setAdaptiveTimeStep(0.2); }

TEST(SharedFeatures, theAdaptiveStep) {
    expectSameOnRanks(600, box<Wet>(6, adapt));
    expectSameOnRanks(300, cloud<Wet>(200.0, adapt), {3});
}
TEST(LongSharedFeatures, theAdaptiveStepOverManySteps) {
    expectSameOnRanks(10000, box<Wet>(6, adapt), {3, 7});
}

TEST(SharedFeatures, theEnergyLedger) {
    expectSameOnRanks(300, box<Wet>(6, keepLedger), {1, 2, 3, 7});
    expectSameOnRanks(300, cloud<Wet>(200.0, keepLedger), {3});
}

/// A box whose grains a hook slows down.
class SlowedBox : public scenes::SettlingBox<Wet> {
public:
    SlowedBox() : scenes::SettlingBox<Wet>(6) { setQuiet(), keepEnergyLedger(); }

private:
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 7 != 0) return;
        for (GrainReference grain : particleHandler.ownGrains())
            grain.setVelocity(0.999 * grain.getVelocity());
    }
};

// What a hook has given to a grain, the ledger sees of its ghosts too.
TEST(SharedFeatures, theEnergyLedgerWhereAHookSlowsGrains) {
    expectSameOnRanks(600,
                      [](auto&& use) {
                          SlowedBox scene;
                          use(scene);
                      },
                      {2, 3});
}

TEST(SharedFeatures, anIntegratorThatRemembers) {
    expectSameOnRanks(600, box<Smooth>(6, [](Scene& scene) {
                          scene.setIntegrator(integrators::adamsMoulton);
                          scene.acceptUnstableTimeStep();
                      }));
}

TEST(SharedFeatures, planesThatCount) {
    expectSameOnRanks(600, cloud<Wet>({}, [](Scene& scene) {
                          for (const double at : {0.003, 0.01})
                              scene.fluxPlaneHandler.copyAndAddObject({{1, 0, 0}, {at, 0, 0}});
                      }));
    expectSameOnRanks(600,
                      cloud<Wet>(200.0,
                                 [](Scene& scene) {
                                     scene.fluxPlaneHandler.copyAndAddObject({{0, 1, 0}, {0, 0.008, 0}});
                                 }),
                      {3});
}

/// Grains of two sizes come above, some of them where the parts of two ranks meet.
template <class S>
void letIn(S& scene) {
    Inlet inlet;
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    inlet.setGrain(grain);
    inlet.setSizes(evenSizes(1.8e-3, 2.1e-3));
    inlet.setRegion(BoxRegion({0.001, 0.001, 0.0095}, {0.0115, 0.0115, 0.0118}));
    inlet.setNumberFlow(1800);
    scene.inletHandler.copyAndAddObject(inlet);
}

TEST(SharedFeatures, inlets) {
    std::size_t come = 0;
    box<Smooth>(3, [](auto& scene) { letIn(scene); })([&](Scene& scene) {
        scene.initialise();
        scene.step(1500);
        come = scene.inletHandler.countOf(0).number;
    });
    EXPECT_GT(come, 12u);
    expectSameOnRanks(1500, box<Smooth>(3, [](auto& scene) { letIn(scene); }));
    expectSameOnRanks(800,
                      box<Wet>(3,
                               [](auto& scene) {
                                   letIn(scene);
                                   adapt(scene);
                               }),
                      {3});
}

/// Also between the parts of ranks.
template <class S>
void letClumpsIn(S& scene) {
    ranks::letClumpsIn(scene, 0.0063, 0.009, 3000);
    scene.setTimeStep(0x1p-18);
}

TEST(SharedFeatures, inletsOfClumps) {
    std::size_t come = 0;
    box<Smooth>(2, [](auto& scene) { letClumpsIn(scene); })([&](Scene& scene) {
        scene.initialise();
        scene.step(1600);
        come = scene.bodyHandler.getSize();
    });
    EXPECT_GT(come, 8u);
    expectSameOnRanks(1600, box<Smooth>(2, [](auto& scene) { letClumpsIn(scene); }), {2, 3, 7});
    expectSameOnRanks(800,
                      box<Wet>(2,
                               [](auto& scene) {
                                   letClumpsIn(scene);
                                   scene.setTimeStep(0x1p-20);
                                   keepLedger(scene);
                               }),
                      {3});
}

/// Grains leave at the bottom: in the end all, so that ranks lose their last ones.
void letOut(Scene& scene) {
    Outlet outlet;
    outlet.setPlane({0, 0, -1}, {0, 0, 0.004});
    scene.outletHandler.copyAndAddObject(outlet);
}

TEST(SharedFeatures, outlets) {
    expectSameOnRanks(1500, box<Wet>(6, letOut));
    expectSameOnRanks(400,
                      box<Wet>(6,
                               [](Scene& scene) {
                                   letOut(scene);
                                   keepLedger(scene);
                                   for (const std::size_t wall : {0u, 5u})
                                       scene.wallHandler.getObject(wall).keepForces();
                               }),
                      {3});
}
TEST(SharedFeatures, outletsOfRigidBodies) {
    expectSameOnRanks(1000,
                      box<Wet>(6,
                               [](Scene& scene) {
                                   joinGrains(scene);
                                   letOut(scene);
                               }),
                      {2, 3});
}

/// The lid of the box is a plane that forces move, and the floor one that keeps them.
template <class Drive>
auto lidOf(Drive&& drive) {
    return [=](Scene& scene) {
        drive(*dynamic_cast<InfiniteWall*>(&scene.wallHandler.getObject(4)));
        scene.wallHandler.getObject(5).keepForces();
    };
}

TEST(SharedFeatures, pistonsAndServosOfAForce) {
    expectSameOnRanks(600, box<Wet>(4, lidOf([](InfiniteWall& lid) { lid.setPiston(1e-3, 0.1); })));
    expectSameOnRanks(600, box<Wet>(4, lidOf([](InfiniteWall& lid) { lid.setTargetForce(0.1, 1e-3, 1); })),
                      {3});
    expectSameOnRanks(200,
                      box<Wet>(4,
                               [](Scene& scene) {
                                   lidOf([](InfiniteWall& lid) { lid.setPiston(1e-3, 0.1); })(scene);
                                   keepLedger(scene);
                               }),
                      {3});
}

TEST(SharedFeatures, rigidBodies) {
    expectSameOnRanks(800, box<Wet>(8, joinGrains));
    expectSameOnRanks(600, cloud<Wet>({}, joinGrains), {2, 3, 7});
}
TEST(SharedFeatures, rigidBodiesInShear) { expectSameOnRanks(600, cloud<Wet>(200.0, joinGrains), {2, 3}); }
TEST(SharedFeatures, rigidBodiesWithTheLedger) {
    expectSameOnRanks(200,
                      box<Wet>(6,
                               [](Scene& scene) {
                                   joinGrains(scene);
                                   keepLedger(scene);
                               }),
                      {2, 3});
}
TEST(SharedFeatures, rigidBodiesWithServosAndTheAdaptiveStep) {
    expectSameOnRanks(400,
                      cloud<Wet>({},
                                 [](Scene& scene) {
                                     joinGrains(scene);
                                     setTargets(scene);
                                 }),
                      {3});
    expectSameOnRanks(400,
                      box<Wet>(6,
                               [](Scene& scene) {
                                   joinGrains(scene);
                                   adapt(scene);
                               }),
                      {3});
}
/// A rod that is longer than the parts of all ranks, between grains that fall on it.
TEST(SharedFeatures, oneBodyThatIsLongerThanAllParts) {
    expectSameOnRanks(800,
                      box<Smooth>(8,
                                  [](Scene& scene) {
                                      std::vector<std::uint32_t> members;
                                      for (std::uint32_t layer = 0; layer < 8; ++layer)
                                          members.push_back(16 * layer + 5);
                                      scene.bodyHandler.join(members);
                                  }),
                      {3, 7});
}

/// Grains, or pairs of them, that go to and fro on a mesh of one period, which is repeated with the scene.
template <class S>
auto onRepeatedFloor(bool arePairs) {
    using namespace periodic;
    return [=](auto&& use) {
        std::vector<scenes::GrainMotion> grains;
        for (int k = 0; k < 50; ++k) {
            const Vec3D cell(k % 5 + 0.5, k / 5 % 5 + 0.5, 0);
            grains.push_back({.radius = 0.9e-3 + 2e-6 * k,
                              .position = 0.2 * length * cell + Vec3D(0, 0, k < 25 ? 1.1e-3 : 3.3e-3),
                              .velocity = {k % 2 == 0 ? 1.5 : -1.3, 0.3 * (k % 3 - 1), 0}});
        }
        auto scene = floors::filmedGrains<S>(grains, {0, 1});
        scene->keepEnergyLedger();
        floors::addFloor(*scene, {true, 0.37 * length, 1.37 * length});
        if (arePairs)
            for (std::uint32_t k = 0; k < 50; k += 4) scene->bodyHandler.join({k, k + 1});
        use(*scene);
    };
}

TEST(SharedFeatures, wallsThatAreRepeated) {
    for (const bool arePairs : {false, true})
        onRepeatedFloor<periodic::floors::Dry>(arePairs)([](auto& scene) {
            scene.initialise();
            scene.steps(1000);
            EXPECT_GT(scene.crossings, 5);
            EXPECT_TRUE(scene.wallHandler.getObject(0).isRepeated());
        });
    expectSameOnRanks(1000, onRepeatedFloor<periodic::floors::Dry>(false), {2, 3, 7});
    expectSameOnRanks(1000, onRepeatedFloor<periodic::floors::Dry>(true), {2, 3});
    expectSameOnRanks(1000, onRepeatedFloor<periodic::floors::Migrating>(false), {3});
}

}  // namespace
}  // namespace pendular::sharedFeaturesTest
