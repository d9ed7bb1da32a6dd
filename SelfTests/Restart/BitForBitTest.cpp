// A run that is restarted is in the same state, in every bit, as one that never stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Laws/Normal/Sinter.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::bitForBitTest {
namespace {

using scenes::SettlingBox;
using support::expectSameState;
using support::TestFolder;

using Smooth = Species<LinearViscoelastic>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

/// A normal law that remembers and sinters, and a friction law that remembers, with a torque of the contact's
/// own.
using Remembering = Species<Sinter, MindlinRollingTorsion>;

template <class Scene>
void runTo(Scene& scene, std::size_t steps) {
    while (scene.getNumberOfTimeSteps() < steps) scene.step();
}

/// Contacts that touch, and bridges that are stretched between grains that do not.
std::pair<int, int> touchingAndStretched(const Scene& scene) {
    const ContactCounts all = scene.contacts().counts();
    return {static_cast<int>(all.touching), static_cast<int>(all.acting - all.touching)};
}

/// Runs a scene to `end` in one go, and in another one that is restarted at `middle`.
/// @param make makes the scene, by the number of threads
template <class Make>
void expectSameAfterRestart(Make&& make, std::size_t middle, std::size_t end, int threadsBefore = 1,
                            int threadsAfter = 1) {
    const TestFolder folder;
    const std::filesystem::path whole = folder.path() / "whole.h5", half = folder.path() / "half.h5",
                                restarted = folder.path() / "restarted.h5";
    {
        auto scene = make(threadsBefore);
        scene->initialise();
        runTo(*scene, middle);
        scene->writeRestart(half);
        runTo(*scene, end);
        scene->writeRestart(whole);
    }
    auto scene = make(threadsAfter);
    scene->restartFrom(half);
    scene->initialise();
    ASSERT_EQ(scene->getNumberOfTimeSteps(), middle);
    scene->writeRestart(restarted);
    expectSameState(half, restarted);
    runTo(*scene, end);
    scene->writeRestart(restarted);
    expectSameState(whole, restarted);
}

template <class S>
auto box(int layers) {
    return [=](int threads) {
        auto scene = std::make_unique<SettlingBox<S>>(layers);
        scene->setNumberOfThreads(threads);
        return scene;
    };
}

TEST(Restart, ofSmoothDryGrainsIsBitForBit) {
    for (const std::size_t middle : {0, 1, 500, 1500}) expectSameAfterRestart(box<Smooth>(3), middle, 2000);
}

TEST(Restart, ofLawsThatRememberIsBitForBit) {
    for (const std::size_t middle : {300, 900}) expectSameAfterRestart(box<Remembering>(2), middle, 1200);
    const TestFolder folder;
    auto scene = box<Remembering>(2)(1);
    scene->initialise();
    runTo(*scene, 900);
    scene->writeRestart(folder.path() / "remembering.h5");
    const auto content = support::contentOfState(folder.path() / "remembering.h5");
    // The histories of both laws come first; a torque is before the last number, which is unused.
    constexpr std::size_t remembered = layoutOf<Remembering>.history + layoutOf<Remembering>.normalHistory;
    const std::size_t pairs = content.at("contacts/pairs").size() / (4 * sizeof(double));  // widest rows
    std::vector<double> numbers(content.at("contacts/numbers").size() / sizeof(double));
    std::memcpy(numbers.data(), content.at("contacts/numbers").data(), numbers.size() * sizeof(double));
    ASSERT_GT(pairs, 0u);
    const std::size_t width = numbers.size() / pairs;
    ASSERT_EQ(width, remembered + layoutOf<Remembering>.interaction + 8 + 4);
    const auto isUsed = [&](std::size_t column) {
        for (std::size_t k = 0; k < pairs; ++k)
            if (numbers[k * width + column] != 0) return true;
        return false;
    };
    for (std::size_t column = 0; column < remembered; ++column) EXPECT_TRUE(isUsed(column)) << column;
    for (std::size_t column = width - 4; column < width - 1; ++column) EXPECT_TRUE(isUsed(column)) << column;
}

TEST(Restart, withStretchedBridgesIsBitForBit) {
    const auto make = box<Wet>(3);
    auto probe = make(1);
    probe->initialise();
    runTo(*probe, 900);
    const auto [touching, stretched] = touchingAndStretched(*probe);
    EXPECT_GT(touching, 5);
    EXPECT_GT(stretched, 10);
    for (const std::size_t middle : {0, 300, 900}) expectSameAfterRestart(make, middle, 1500);
}

TEST(Restart, withOtherThreadsIsBitForBit) {
    for (const auto& [before, after] : {std::pair{1, 3}, std::pair{2, 1}})
        expectSameAfterRestart(box<Wet>(2), 100, 250, before, after);
}

/// The step before the contacts are listed again, that step, and the one after it.
TEST(Restart, aroundARelistingIsBitForBit) {
    auto probe = box<Wet>(3)(1);
    probe->initialise();
    runTo(*probe, 400);
    const std::size_t rebuilds = probe->contacts().rebuildCount();
    while (probe->contacts().rebuildCount() == rebuilds) probe->step();
    const std::size_t at = probe->getNumberOfTimeSteps();
    for (const std::size_t middle : {at - 1, at, at + 1})
        expectSameAfterRestart(box<Wet>(3), middle, at + 300);
}

/// All else that a run changes: an energy ledger, walls that move and keep forces, whose motion the driver
/// sets again during the run, gravity that it turns, a periodic direction, random numbers and a counter of
/// its own.
class Everything : public SettlingBox<Wet> {
public:
    Everything() : SettlingBox<Wet>(2) {
        keepEnergyLedger();
        const double far = 1;  // m, along x: no grain meets its image but the account of the rounds is kept
        setPeriodic(0, -0.5 * far, 0.5 * far);
        const Wet* material = speciesHandler.getObject(0);
        TriangleWall paddle;
        paddle.setSpecies(material);
        const double edge = width, height = 1e-4;  // m: just below the lowest grains
        paddle.set(std::vector<Triangle>{{{{0, 0, height}, {edge, 0, height}, {0, edge, height}}},
                                         {{{edge, edge, height}, {edge, 0, height}, {0, edge, height}}}});
        paddle.setAngularVelocity({0, 20, 0}, {0.5 * edge, 0, height});
        moved = wallHandler.copyAndAddObject(paddle);
        moved->keepForces(true, {0, 0, height});
        AxisymmetricWall cone;
        cone.setSpecies(material);
        cone.set({0, 0, 1}, {0.5 * edge, 0.5 * edge, 0}, {{2e-3, 7.5e-3}, {4e-3, 7e-3}});
        cone.setMotion(shake);
        shaken = wallHandler.copyAndAddObject(cone);
        speciesHandler.getMixedObject(0, 1)->setSlidingFrictionCoefficient(0.25);
    }
    void actionsAfterTimeStep() override {
        const std::size_t step = getNumberOfTimeSteps();
        if (step % 100 == 50) {
            const double kick = random.uniform(-0.1, 0.1);
            particleHandler.getObject(step % particleHandler.getSize()).setVelocity({kick, 0, 0});
            ++kicks;
        }
        if (step == 120) shaken->setVelocity({0, 0, -0.01});
        if (step == 180) shaken->setMotion(shake);  // from where it is then
        if (step == 250) moved->setSurfaceVelocity({0, 0.1, 0});
        if (step == 270) moved->setVelocity({0.01, 0, 0.005});
        if (step == 330) moved->setAngularVelocity({0, -15, 0}, {3e-3, 0, 0});
        if (step == 350) shaken->setVelocity({0, 0, -0.01});
        if (step == 300) setGravity({1, 0, -9.7});
    }
    void visitState(StateArchive& archive) override {
        random.visitState(archive);
        archive.value("kicks", kicks);
    }
    std::size_t kicks = 0;

    /// m: of the cone, from where its function alone would have it.
    [[nodiscard]] double coneBelow() const {
        return shake(getTime()).translation().z() - shaken->getPose().shift.z;
    }

private:
    static Eigen::Isometry3d shake(double time) {
        return Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1e-5 * std::sin(1000 * time)));
    }
    UniformRandom random{7};
    RigidWall *moved = nullptr, *shaken = nullptr;
};

TEST(Restart, ofAllThatARunChangesIsBitForBit) {
    const auto make = [](int threads) {
        auto scene = std::make_unique<Everything>();
        scene->setNumberOfThreads(threads);
        return scene;
    };
    Everything probe;
    probe.initialise();
    runTo(probe, 200);
    // It sank at 0.01 m/s for 60 steps of 2^-17 s, 4.578 um, in which its function would have lifted it by
    // 1e-5 m (sin(1.3733) - sin(0.9155)) = 1.877 um.
    EXPECT_NEAR(probe.coneBelow(), 6.454e-6, 1e-9);
    runTo(probe, 400);
    EXPECT_GT(probe.wallHandler.getObject(6).getForce().norm(), 0) << "the paddle meets grains";
    EXPECT_NE(probe.energyLedger().normalDashpots, 0);
    EXPECT_NE(probe.energyLedger().walls, 0);
    EXPECT_EQ(probe.kicks, 4u);
    for (const std::size_t middle : {200, 260, 300, 400}) expectSameAfterRestart(make, middle, 700);
}

/// A plate comes in after some steps, and moves from the step after that on. A scene that goes on is set up
/// with it.
class LatePlate : public SettlingBox<Smooth> {
public:
    static constexpr std::size_t added = 5;  // step
    LatePlate() : SettlingBox<Smooth>(2) {}
    void setupInitialConditions() override {
        if (isRestarted()) addPlate();
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() == added) addPlate();
        if (getNumberOfTimeSteps() == added + 1) plate->setVelocity({0, 0, 0.01});
    }

private:
    void addPlate() {
        InfiniteWall wall;
        wall.setSpecies(speciesHandler.getObject(0));
        wall.set({0, 0, -1}, {0, 0, 5e-5});  // m: below the lowest grains
        plate = wallHandler.copyAndAddObject(wall);
    }
    RigidWall* plate = nullptr;
};

/// The file may be written at the end of the step that adds the wall, too: it has not been moved to any time
/// yet.
TEST(Restart, withAWallThatWasAddedIsBitForBit) {
    const auto make = [](int) { return std::make_unique<LatePlate>(); };
    for (const std::size_t middle : {LatePlate::added, LatePlate::added + 1, std::size_t{100}})
        expectSameAfterRestart(make, middle, 300);
}

/// Equal states make equal files, without exception.
TEST(Restart, writesTheSameBytesForTheSameState) {
    const TestFolder folder;
    std::vector<std::string> bytes;
    for (int k = 0; k < 2; ++k) {
        auto scene = box<Wet>(2)(1 + k);
        scene->initialise();
        runTo(*scene, 100);
        const auto file = folder.path() / std::to_string(k);
        scene->writeRestart(file);
        std::ifstream stream(file, std::ios::binary);
        bytes.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    EXPECT_GT(bytes[0].size(), 10000u);
    EXPECT_TRUE(bytes[0] == bytes[1]);
}

}  // namespace
}  // namespace pendular::bitForBitTest
