// Servos of stress and of shear stress on crystals with dashpots: their own rate is not fed back.
#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Features/ShearAndStrain/StressServo.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "SelfTests/Periodic/Lattice.h"

namespace pendular::dampedServoTest {
namespace {

using periodic::Lattice;
using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;

constexpr double stiffness = 100;  // N/m
const double mass = sphereMass(Lattice<Smooth>::radius, 2500);
const double unit = std::sqrt(mass / stiffness);  // s, 1.1e-4

Smooth smooth(double ratio) {
    Smooth material = periodic::linear();
    material.setDissipation(2 * ratio * std::sqrt(mass * stiffness));
    return material;
}
Rough rough(double ratio) {
    Rough material;
    material.setStiffness(stiffness), material.setSlidingStiffness(stiffness);
    material.setDissipation(2 * ratio * std::sqrt(mass * stiffness));
    material.setSlidingDissipation(2 * ratio * std::sqrt(mass * stiffness));
    material.setSlidingFrictionCoefficient(100);
    return material;
}

template <class S>
struct Crystal : Lattice<S> {
    explicit Crystal(const S& material) : Lattice<S>(material, 4, 2 * Lattice<S>::radius * (1 - 1e-4)) {
        this->setTimeStep(timeStep);
        this->acceptUnstableTimeStep();
    }
    static constexpr double timeStep = 5e-6;  // s, 0.044 sqrt(m/k)
};

/// The crystal follows the strain as a whole, so that the elastic part of the stress goes by
/// 1 - h / (time + C/K), C/K = c/k: each step reads the stress of the step before. Its stiffness changes by
/// the strain, of 2.5e-4, over which it is 1 - 3 times that at most.
TEST(DampedServo, bringsACrystalToItsStressByTheClosedForm) {
    for (const double ratio : {0.1, 1.})
        for (const double time : {0.2, 1.5}) {
            Crystal<Smooth> scene(smooth(ratio));
            for (int axis = 0; axis < 3; ++axis) scene.setTargetStress(axis, 100, time * unit, 1e4);
            scene.initialise();
            const double first = meanStress(scene).total()(2, 2) - 100, slowest = (time + 2 * ratio) * unit;
            ASSERT_LT(first, -70);
            double elastic = first;
            double largest = 0;
            const int steps = static_cast<int>(std::lround(8 * slowest / scene.timeStep));
            for (int n = 0; n < steps; ++n) {
                const double rate = elastic / ((time + 2 * ratio) * unit);  // times K
                elastic -= scene.timeStep * rate;
                scene.step();
                if (n % 4 != 0) continue;
                const double off = meanStress(scene).total()(2, 2) - 100;
                largest = std::max(largest, std::abs(off));
                EXPECT_NEAR(off, elastic - 2 * ratio * unit * rate, 2e-3 * std::abs(first))
                    << ratio << " " << time << " " << n;
            }
            EXPECT_LE(largest, 1.001 * std::abs(first));
            EXPECT_NEAR(meanStress(scene).total()(2, 2), 100, 2e-3 * std::abs(first));
        }
}

/// One axis alone, two, and with friction, whose springs and dashpots also answer to the rate.
TEST(HeavyDampedServo, bringsOneAxisAndFrictionalCrystalsToTheirStress) {
    const auto expectTarget = [](auto& scene, int axes, double time, double ratio) {
        for (int axis = 0; axis < axes; ++axis) scene.setTargetStress(axis, 40 + 10 * axis, time, 1e4);
        scene.initialise();
        double largest = 0;
        const int steps = static_cast<int>(std::lround(100 * (time + 2 * ratio * unit) / scene.timeStep));
        for (int n = 0; n < steps; ++n) {
            scene.step();
            if (n % 10 == 0) largest = std::max(largest, std::abs(meanStress(scene).total()(0, 0) - 40));
        }
        EXPECT_LT(largest, 30) << axes << " " << time << " " << ratio;  // 12 at first, along others more
        for (int axis = 0; axis < axes; ++axis)
            EXPECT_NEAR(meanStress(scene).total()(axis, axis), 40 + 10 * axis, 0.1) << axes << " " << time;
    };
    constexpr double time = 0.04;  // below a step
    for (const double ratio : {0.1, 1.}) {
        Crystal<Smooth> two(smooth(ratio));
        expectTarget(two, 2, time * unit, ratio);
        for (const int axes : {1, 3}) {
            Crystal<Rough> scene(rough(0.3 * ratio));
            expectTarget(scene, axes, time * unit, 0.3 * ratio);
        }
    }
}

TEST(HeavyDampedServo, bringsACrystalToItsShearStress) {
    const auto expectTarget = [](auto& scene, double time, double ratio, double largestShare) {
        scene.setLeesEdwards(0, 1, 0);
        scene.setTargetShearStress(5, time * unit, 1e4);
        scene.initialise();
        double largest = 0;
        const int steps = static_cast<int>(std::lround(100 * (time + 2 * ratio) * unit / scene.timeStep));
        for (int n = 0; n < steps; ++n) {
            scene.step();
            if (n % 10 == 0) largest = std::max(largest, std::abs(-meanStress(scene).total()(0, 1)));
        }
        EXPECT_LT(largest, largestShare * 5) << time << " " << ratio;
        EXPECT_NEAR(-meanStress(scene).total()(0, 1), 5, 0.05) << time << " " << ratio;
    };
    for (const auto& [time, ratio] : {std::pair{0.04, 0.1}, {0.04, 1.}, {1., 1.}}) {
        Crystal<Smooth> crystal(smooth(ratio));
        expectTarget(crystal, time, ratio, 1.15);
        if (time > 0.5) continue;
        Crystal<Rough> frictional(rough(0.3 * ratio));
        expectTarget(frictional, time, 0.3 * ratio, 2);
    }
}

/// The dashpots of a crystal: each is c over k of the stiffness of its springs.
TEST(DampedServo, knowsTheDashpotsOfACrystal) {
    Crystal<Smooth> scene(smooth(0.3));
    HomogeneousStrain strain;
    for (AxisStrain& axis : strain.axes) axis.isControlled = true;
    scene.initialise();
    const DiagonalStress now = diagonalStress(scene.contacts(), scene.particleHandler.store(), strain);
    for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_NEAR(now.dashpot[a], 0.6 * unit * now.stiffness[a], 1e-9 * now.dashpot[a]);
        EXPECT_EQ(now.tangential[a], 0);
    }
    EXPECT_NEAR(now.shearDashpot, 0.6 * unit * now.shearStiffness, 1e-9 * now.shearDashpot);
}

}  // namespace
}  // namespace pendular::dampedServoTest
