// What a run changes of shear and strain: targets, rates, steps that fail, restarts between any two steps.
#include <gtest/gtest.h>

#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Periodic/Lattice.h"
#include "SelfTests/Periodic/MovingImages.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::changesInRunTest {
namespace {

using periodic::againstFlow;
using periodic::Lattice;
using periodic::linear;
using periodic::Smooth;
using scenes::boxMaterial;
using scenes::FewGrains;
using scenes::GrainMotion;
using scenes::ShearedCloud;

/// A cloud in shear under two stresses, whose steps add up to rounded times.
class PressedShear : public ShearedCloud<Smooth> {
public:
    PressedShear() : ShearedCloud<Smooth>(60.0) {
        setTimeStep(0.9e-6);
        setTargetStress(1, 300, 1e-4, 50);
        setTargetShearStress(50, 1e-4, 200);
        setQuiet();
    }
    /// Until a step begins at a time that, with the step, is not that of its end.
    void stepToARoundedTime() {
        double sum = 0;
        do {
            sum = getTime() + getTimeStep();
            step();
        } while (sum == getTime());
    }
};

TEST(ChangesInRun, aRestartKeepsThePlaceOfTheImages) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    PressedShear whole;
    whole.initialise();
    whole.step(300);
    for (int k = 0; k < 3; ++k) {
        whole.stepToARoundedTime();
        PressedShear resumed;
        periodic::expectGoesOnAlike(whole, resumed, file, 100);
    }
}

/// A crystal under a stress along x and y that is squeezed along z: the drift of its servos is
/// rate x C12 / (C11 + C12), and without it the stress is off by rate x C12 x time. A new target keeps it.
TEST(ChangesInRun, aServoKeepsWhatItHasLearntWhenItsTargetChanges) {
    Lattice<Smooth> scene(linear(), 4, 2 * Lattice<Smooth>::radius * (1 - 1e-3));
    const double time = 20 * scene.timeStep, rate = 0.02;
    const double off = 100 / (std::sqrt(2.0) * scene.distance()) * rate * time;  // Pa
    const auto setTarget = [&](double target) {
        for (int axis = 0; axis < 2; ++axis) scene.setTargetStress(axis, target, time);
    };
    setTarget(280);
    scene.setStrainRate(2, -rate);
    scene.initialise();
    scene.step(20 * 16 * 30);
    setTarget(281);
    scene.step(100);
    EXPECT_GT(off, 0.25);
    for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(meanStress(scene).total()(axis, axis), 281, 0.02 * off + std::exp(-5));
    // Behind a target that goes up it lags by its speed times the time of the servo, but for one step.
    double target = 281;
    for (int k = 0; k < 1000; ++k) {
        setTarget(target += 0.005);
        scene.step();
    }
    for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(meanStress(scene).total()(axis, axis), target - 0.005 * 19, 0.1 * off);
}

TEST(ChangesInRun, aTargetThatRisesInEachStepAndCannotBeBorneEndsTheRun) {
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.position = {0.005, 0.005, 0.005}}}, 1e-5);
    periodic::repeatAlongAllAxes(scene, 0.01);
    scene.setQuiet();
    scene.setLeesEdwards(0, 1, 0);
    scene.setTargetShearStress(100, 1e-2);  // at most 100 1/s: a strain of 20 in 0.2 s
    scene.initialise();
    std::string end;
    for (int k = 0; k < 30000 && end.empty(); ++k) {
        scene.setTargetShearStress(100 + 1e-3 * k, 1e-2);
        try {
            scene.step();
        } catch (const RunError& error) {
            end = error.what();
        }
    }
    EXPECT_TRUE(support::contains(end, "cannot bear"));
}

constexpr double side = 0x1p-6;     // m
constexpr double length = 0x1p-20;  // s

/// Grains that go with a shear g and a compression g along its gradient: two large ones along the direction
/// n in which they approach fastest, at g (1 + sqrt(2)) / 2 = 1.21 g of their distance, are too far apart for
/// the first list by a ten-thousandth of its skin, which is small against them: a tenth of a small grain.
TEST(ChangesInRun, noContactIsMissedInShearWithStrain) {
    constexpr double g = 50, large = 1e-3, small = 1e-4;
    const Vec3D middle = Vec3D::Constant(side / 2), n = Vec3D(1, -1 - std::sqrt(2.0), 0).normalized();
    const double half = large + 0.5 * 1.0001 * 0.1 * small;
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0),
                            {{.radius = large, .position = middle - half * n},
                             {.radius = large, .position = middle + half * n},
                             {.radius = small, .position = {0.002, 0.002, 0.002}}},
                            length);
    periodic::repeatAlongAllAxes(scene, side);
    scene.setQuiet();
    scene.setLeesEdwards(0, 1, g);
    scene.setStrainRate(1, -g);
    for (auto&& grain : scene.particleHandler) grain.setVelocity(scene.shearFlowAt(grain.getPosition()));
    EXPECT_GT(periodic::overlapsKnownInRounds(scene, 150, 1), 30u);
}

/// What a run has asked of the flow holds in the step after one that failed.
TEST(ChangesInRun, aStepThatFailsTakesTheShearBack) {
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0),
                            {{.position = {0.002, 0.003, 0.004}},
                             {.position = {0.01, 0.012, 0.009}, .velocity = {0.1, 0.2, 0.3}}},
                            length);
    periodic::repeatAlongAllAxes(scene, side);
    scene.setQuiet();
    scene.setLeesEdwards(0, 1, 5);
    scene.initialise();
    scene.step(10);
    const Vec3D before = againstFlow(scene, scene.motion(1)), flow = scene.shearFlowAt({0, 0, 0});
    auto fast = scene.particleHandler.getObject(0);
    const Vec3D slow = fast.getVelocity();
    scene.setShearRate(50);
    fast.setVelocity({1e5, 0, 0});
    EXPECT_THROW(scene.step(), RunError);
    EXPECT_EQ(scene.shearFlowAt({0, 0, 0}), flow);
    fast.setVelocity(slow);
    scene.step();
    // -rate x C_y in a step, and round-off
    EXPECT_LT((againstFlow(scene, scene.motion(1)) - before).norm(), 1.01 * 50 * 0.2 * length);
}

TEST(ChangesInRun, whatIsRefusedLeavesTheSceneAsItWas) {
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.position = {0.005, 0.005, 0.005}}}, 1e-6);
    periodic::repeatAlongAllAxes(scene, 0.01);
    scene.setQuiet();
    scene.setLeesEdwards(0, 1, 5);
    scene.setStrainRate(1, 2);
    scene.initialise();
    EXPECT_TRUE(support::contains(support::refusal([&] { scene.setStrainRate(0, 1); }), "stays"));
    EXPECT_EQ(scene.getStrainRate(0), 0);
    EXPECT_NE(support::refusal([&] { scene.setTargetStress(1, 10, 4e-7); }), "");
    EXPECT_NE(support::refusal([&] { scene.setTargetShearStress(10, 4e-7); }), "");
    EXPECT_NE(support::refusal([&] { scene.setGravity({0, -1, 0}); }), "");
    EXPECT_EQ(scene.getGravity(), Vec3D::Zero());
    scene.step(10);  // no servo looks at the stress
    EXPECT_EQ(scene.getStrainRate(1), 2);
    EXPECT_EQ(scene.getShearRate(), 5);
}

}  // namespace
}  // namespace pendular::changesInRunTest
