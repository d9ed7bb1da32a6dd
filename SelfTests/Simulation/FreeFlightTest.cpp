#include <gtest/gtest.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::freeFlightTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, Mindlin>;

template <class S>
S material() {
    S species;
    species.setDensity(2000);
    species.setStiffness(1e4);
    if constexpr (S::hasTorque) {
        species.setEffectiveShearModulus(1e6);
        species.setSlidingDissipation(0);
    }
    return species;
}

template <class S>
class FreeFlight : public testing::Test {};
using BothSpecies = testing::Types<Smooth, Rough>;
TYPED_TEST_SUITE(FreeFlight, BothSpecies);

const Vec3D position(0.3, -0.2, 0.5), velocity(1.5, -0.25, 3);
constexpr double step = 1e-5;
constexpr int steps = 5000;

// Velocity Verlet is exact for a parabola. Each of the steps rounds a sum to 1.1e-16 of its size.
constexpr double roundOff = steps * 1.2e-16;

TYPED_TEST(FreeFlight, ofOneGrainIsStraight) {
    FewGrains<TypeParam> scene(material<TypeParam>(),
                               {{.position = position, .velocity = velocity, .spin = {1, -2, 300}}}, step);
    scene.run(steps);
    EXPECT_EQ(scene.motion(0).velocity, velocity);
    EXPECT_LT((scene.motion(0).position - (position + steps * step * velocity)).norm(),
              roundOff * position.norm());
    EXPECT_EQ(scene.motion(0).spin, TypeParam::hasTorque ? Vec3D(1, -2, 300) : Vec3D(0, 0, 0));
    EXPECT_EQ(scene.particleHandler.getObject(0).getForce(), Vec3D(0, 0, 0));
}

TYPED_TEST(FreeFlight, underGravityIsAParabola) {
    FewGrains<TypeParam> scene(material<TypeParam>(),
                               {{.position = position, .velocity = velocity, .spin = {1, -2, 300}}}, step);
    const Vec3D gravity(0.5, 1, -9.81);
    scene.setGravity(gravity);
    scene.run(steps);
    const double time = steps * step;
    EXPECT_NEAR(scene.getTime(), time, 1e-15);
    EXPECT_LT((scene.motion(0).velocity - (velocity + time * gravity)).norm(), roundOff * velocity.norm());
    EXPECT_LT((scene.motion(0).position - (position + time * velocity + 0.5 * time * time * gravity)).norm(),
              roundOff * position.norm());
    EXPECT_EQ(scene.motion(0).spin, TypeParam::hasTorque ? Vec3D(1, -2, 300) : Vec3D(0, 0, 0));
    const double mass = scene.particleHandler.getObject(0).getMass();
    EXPECT_LT((scene.particleHandler.getObject(0).getForce() - mass * gravity).norm(),
              1e-15 * mass * gravity.norm());
}

TYPED_TEST(FreeFlight, keepsTheEnergyToRoundOff) {
    FewGrains<TypeParam> scene(material<TypeParam>(),
                               {{.position = position, .velocity = velocity, .spin = {1, -2, 300}}}, step);
    scene.setGravity({0, 0, -9.81});
    scene.keepEnergyLedger();
    scene.initialise();
    const double energy = scene.energyLedger().total();
    const double mass = scene.particleHandler.getObject(0).getMass();
    const double spinEnergy = TypeParam::hasTorque ? 0.2 * mass * 1e-6 * (1 + 4 + 90000) : 0;
    EXPECT_NEAR(energy, mass * (0.5 * velocity.squaredNorm() + 9.81 * position.z()) + spinEnergy,
                1e-15 * energy);
    for (int k = 0; k < steps; ++k) scene.step();
    EXPECT_NEAR(scene.energyLedger().total(), energy, 10 * roundOff * energy);
    EXPECT_EQ(scene.energyLedger().lost(), 0);
    EXPECT_EQ(scene.energyLedger().stored(), 0);
}

TYPED_TEST(FreeFlight, ofAFixedGrainIsNone) {
    FewGrains<TypeParam> scene(material<TypeParam>(), {{.position = position, .fixed = true}}, step);
    scene.setGravity({0, 0, -9.81});
    scene.run(100);
    EXPECT_EQ(scene.motion(0).position, position);
    EXPECT_EQ(scene.motion(0).velocity, Vec3D(0, 0, 0));
}

TYPED_TEST(FreeFlight, ofManyGrainsIsThatOfEach) {
    // The list of contacts is made again many times on the way; grains keep their identity.
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 40; ++k)
        grains.push_back({.radius = 1e-3 * (1 + k % 7),
                          .position = {0.05 * k, 0.02 * (k % 5), -0.03 * (k % 3)},
                          .velocity = {20.0 * ((k * 7) % 11 - 5), 0, 0}});
    for (int k = 0; k < 40; ++k) grains[k].position.y() = 0.05 * k;  // no two in each other's way
    FewGrains<TypeParam> scene(material<TypeParam>(), grains, step);
    scene.run(500);
    EXPECT_GT(scene.contacts().rebuildCount(), 20u);
    for (int k = 0; k < 40; ++k) {
        EXPECT_EQ(scene.motion(k).velocity, grains[k].velocity);
        EXPECT_LT((scene.motion(k).position - (grains[k].position + 500 * step * grains[k].velocity)).norm(),
                  1e-12);
        EXPECT_EQ(scene.motion(k).radius, grains[k].radius);
    }
}

template <class S>
class Counting : public Simulation<S> {
public:
    void setupInitialConditions() override { ++setUps; }
    void actionsBeforeTimeStep() override { ++before; }
    void actionsAfterTimeStep() override { ++after; }
    void writeOutput() override { outputs.push_back(this->getNumberOfTimeSteps()); }
    [[nodiscard]] bool continueSolve() const override { return after < stopAfter; }

    int setUps = 0, before = 0, after = 0, stopAfter = 1000000;
    std::vector<std::size_t> outputs;
};

TYPED_TEST(FreeFlight, emptySceneRuns) {
    Counting<TypeParam> scene;
    scene.speciesHandler.copyAndAddObject(material<TypeParam>());
    scene.setTimeStep(0.1);
    scene.setTimeMax(1);
    scene.setSaveCount(4);
    scene.keepEnergyLedger();
    scene.solve();
    EXPECT_EQ(scene.setUps, 1);
    EXPECT_EQ(scene.before, 10);
    EXPECT_EQ(scene.after, 10);
    EXPECT_EQ(scene.outputs, (std::vector<std::size_t>{0, 4, 8, 10}));
    EXPECT_EQ(scene.energyLedger().total(), 0);
    EXPECT_TRUE(std::isinf(scene.stabilityLimit()));
}

TYPED_TEST(FreeFlight, emptySceneWithAWallRuns) {
    Counting<TypeParam> scene;
    InfiniteWall wall;
    wall.set({0, 0, -1}, {0, 0, 0});
    wall.setSpecies(scene.speciesHandler.copyAndAddObject(material<TypeParam>()));
    scene.wallHandler.copyAndAddObject(wall);
    scene.setTimeStep(0.1);
    scene.setTimeMax(1);
    scene.stopAfter = 3;
    scene.solve();
    EXPECT_EQ(scene.after, 3);
    EXPECT_EQ(scene.outputs, (std::vector<std::size_t>{0, 3}));
}

TYPED_TEST(FreeFlight, noTimeIsNoStep) {
    Counting<TypeParam> scene;
    scene.speciesHandler.copyAndAddObject(material<TypeParam>());
    scene.setTimeStep(0.1);
    scene.setTimeMax(0);
    scene.solve();
    EXPECT_EQ(scene.after, 0);
    EXPECT_FALSE(scene.outputs.empty());
}

}  // namespace
}  // namespace pendular::freeFlightTest
