#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Friction/SlidingRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Restart/SameBits.h"
#include "SelfTests/Superquadrics/BoxOfShapes.h"
#include "SelfTests/Superquadrics/SameAsSpheres.h"
#include "SelfTests/Support/LedgerError.h"

// Rolling and torsion resistance of superquadrics: its torque is the coefficient times the normal force and
// Gauss' radius R* of the contact.

namespace pendular::superquadricRollingTest {
namespace {

using scenes::BoxOfShapes;
using scenes::expectForcesOfSpheres;
using scenes::FewSuperquadrics;

using Linear = Species<LinearViscoelastic, SlidingRollingTorsion>;
using Hertz = Species<HertzianViscoelastic, MindlinRollingTorsion>;

constexpr double density = 2500, g = 9.81;  // kg/m^3, m/s^2

template <class S>
void setRotation(S& s, double stiffness, double dissipation, double rolling, double torsion) {
    s.setRollingStiffness(stiffness), s.setTorsionStiffness(stiffness);
    s.setRollingDissipation(dissipation), s.setTorsionDissipation(dissipation);
    s.setRollingFrictionCoefficient(rolling), s.setTorsionFrictionCoefficient(torsion);
}
Linear linear(double stiffness, double rolling, double torsion) {
    Linear s;
    s.setDensity(density);
    s.setStiffness(stiffness);
    s.setDissipation(2e-6 * stiffness);
    s.setSlidingStiffness(0.3 * stiffness), s.setSlidingDissipation(1e-6 * stiffness);
    s.setSlidingFrictionCoefficient(0.5);
    setRotation(s, 0.1 * stiffness, 1e-6 * stiffness, rolling, torsion);
    return s;
}
Hertz hertz() {
    Hertz s;
    s.setDensity(density);
    s.setEffectiveElasticModulus(1e7), s.setDissipation(0.3);
    s.setEffectiveShearModulus(3e6), s.setSlidingDissipation(0.2);
    s.setSlidingFrictionCoefficient(0.4);
    setRotation(s, 300, 1e-3, 0.1, 0.2);
    return s;
}

TEST(SuperquadricRolling, spheresHaveTheForcesOfTheSphereKernel) {
    expectForcesOfSpheres(hertz(), {-15e-6, -8e-6}, 1e-7, 20);
    expectForcesOfSpheres(linear(1000, 0.1, 0.2), {-15e-6, -8e-6}, 1e-7, 20);
    expectForcesOfSpheres(linear(1000, 1e-3, 2e-3), {-15e-6, -8e-6}, 1e-7, 20);  // sliders slide
}

// In a scene with blocks contacts are found another way.
TEST(SuperquadricRolling, spheresBesideABlockHaveThemToo) {
    const scenes::StartGaps gaps{-15e-6, -8e-6};
    scenes::FewGrains<Hertz> spheres(hertz(), {}, 1e-7);
    FewSuperquadrics<Hertz> beside(hertz(), {}, 1e-7);
    for (const auto& motion : scenes::twoRoundGrains(gaps.pair)) {
        scenes::addSphere(spheres, motion);
        scenes::addSphere(beside, motion);
    }
    BlockGrain block({1e-3, 1e-3, 1e-3}, 2e-4);
    block.setSpecies(beside.speciesHandler.getObject(0));
    block.setPosition({0, 0, 0.1});
    beside.superquadricHandler.copyAndAddObject(block);
    beginAtPlane(spheres, gaps, false), beginAtPlane(beside, gaps, false);
    expectSameForces(spheres, beside, 20);
}

/// A prolate ellipsoid on a floor that rolls about its long axis, along x. The radii of curvature where it
/// touches are a and c^2 / a: R* = c.
struct Roller : FewSuperquadrics<Linear> {
    static constexpr double a = 1e-3, c = 1.5e-3, coefficient = 0.05, stiffness = 1e4;

    explicit Roller(double speed, double slope)
        : FewSuperquadrics(linear(stiffness, coefficient, 0), {}, 1e-6) {
        const double mass = density * 4 / 3 * std::numbers::pi * a * a * c,
                     sinking = mass * g * std::cos(slope) / stiffness;
        add({{a, c, a}, {0, 0, a - sinking}, {speed, 0, 0}, {0, speed / a, 0}});
        addPlane({0, 0, -1}, {0, 0, 0});
        setGravity(g * Vec3D(std::sin(slope), 0, -std::cos(slope)));
        initialise();
    }
    void stepUntil(double time) {
        while (getTime() < time) step();
    }
};

// (m a^2 + I) dw/dt = -mu m g R* with I = 2/5 m a^2: the body slows down by mu g (c / a) / (7/5), and stops.
// It sinks in by 1.5e-5 of a.
TEST(SuperquadricRolling, anEllipsoidThatRollsStopsWhereTheTorqueSays) {
    constexpr double speed = 0.05;
    const double slowing = Roller::coefficient * g * (Roller::c / Roller::a) / 1.4, end = speed / slowing;
    Roller roller(speed, 0);
    roller.stepUntil(0.5 * end);
    EXPECT_NEAR(roller.body(0).getVelocity().x() / speed, 0.5, 5e-4);
    roller.stepUntil(1.2 * end);
    const double way = roller.body(0).getPosition().x();
    EXPECT_NEAR(way / (0.5 * speed * end), 1, 5e-4);
    EXPECT_LT(roller.body(0).getVelocity().norm(), 1e-5 * speed);
    roller.stepUntil(1.3 * end);
    EXPECT_NEAR(roller.body(0).getPosition().x(), way, 1e-6 * way);
}

// It stays on slopes of tan(angle) below mu c / a, and goes down steeper ones as the two torques differ.
TEST(SuperquadricRolling, anEllipsoidStaysOnASlopeBelowTheLimit) {
    const double limit = Roller::coefficient * Roller::c / Roller::a, time = 0.1;
    Roller below(0, std::atan(0.98 * limit));
    below.stepUntil(time);
    EXPECT_LT(below.body(0).getVelocity().norm(), 1e-7);
    EXPECT_LT(below.body(0).getPosition().x(), 1e-6);
    for (const double over : {1.02, 2.0}) {
        const double slope = std::atan(over * limit);
        Roller above(0, slope);
        above.stepUntil(0.5 * time);
        const double half = above.body(0).getVelocity().x();
        above.stepUntil(time);
        const double gained = (over - 1) * limit * g * std::cos(slope) / 1.4 * 0.5 * time;
        EXPECT_NEAR((above.body(0).getVelocity().x() - half) / gained, 1, 0.01) << over;
    }
}

// An oblate one that spins on its pole, R* = a^2 / c: I dw/dt = -mu m g a^2 / c, I = 2/5 m a^2.
TEST(SuperquadricRolling, anEllipsoidThatSpinsOnItsPoleStopsByTorsion) {
    constexpr double a = 1.5e-3, c = 1e-3, spin = 20, coefficient = 0.05, stiffness = 1e4;
    const double mass = density * 4 / 3 * std::numbers::pi * a * a * c;
    FewSuperquadrics<Linear> scene(linear(stiffness, 0, coefficient), {}, 1e-6);
    scene.add({{a, a, c}, {0, 0, c - mass * g / stiffness}, {0, 0, 0}, {0, 0, spin}});
    scene.addPlane({0, 0, -1}, {0, 0, 0});
    scene.setGravity({0, 0, -g});
    scene.initialise();
    const double end = 0.4 * spin * c / (coefficient * g);
    while (scene.getTime() < 0.5 * end) scene.step();
    EXPECT_NEAR(scene.body(0).getAngularVelocity().z() / spin, 0.5, 1e-3);
    while (scene.getTime() < 1.5 * end) scene.step();
    EXPECT_LT(scene.body(0).getAngularVelocity().norm(), 1e-4 * spin);
}

// A step rounds momenta by 2^-53 of their parts, with signs at random.
TEST(SuperquadricRolling, collisionsKeepMomentumAndAngularMomentum) {
    FewSuperquadrics<Linear> scene(linear(1000, 0.2, 0.2), scenes::offCentreCollision(), 2e-6);
    scene.initialise();
    const Vec3D p = scene.linearMomentum(), l = scene.angularMomentum();
    const double size = scene.body(0).getMass() * 0.2;
    for (int k = 0; k < 3000; ++k) scene.step();
    EXPECT_LT((scene.linearMomentum() - p).norm(), 1e-13 * size);
    EXPECT_LT((scene.angularMomentum() - l).norm(), 1e-13 * size * 3e-3);
}

struct Box : BoxOfShapes<Linear> {
    explicit Box(int perSide) : BoxOfShapes(material(), perSide, 8e-7) {}
    static Linear material() {
        Linear s = linear(1000, 0.1, 0.1);
        setRotation(s, 20, 5e-4, 0.1, 0.1);
        return s;
    }
};

TEST(HeavySuperquadricRolling, givesTheSameBitsForAnyThreadsAndRestarts) {
    Box half(4), resumed(4), threaded(4);
    half.run(9000);
    EXPECT_GT(half.interactions().size(), 0u);
    support::expectSameBits(half, resumed, threaded, 9000, 1000);
}

/// A held body that spins, at the centre, and one that falls on it: what holds it does work by all of the
/// contact's torque, also that of a normal force that does not point to the centre.
TEST(SuperquadricRolling, closesTheLedgerOfAHeldShapeThatSpins) {
    const scenes::SuperquadricMotion spinning{
        {1e-3, 2e-3, 1e-3, 4, 2}, {0, 0, 0}, {0, 0, 0}, {0, 0, 50}, scenes::turnedBy(0.6, {1, 2, 0})},
        falling{{1e-3, 1.2e-3, 0.8e-3, 2, 2},
                {0.3e-3, 0.4e-3, 2.6e-3},
                {0.1, 0, -0.3},
                {5, 0, 3},
                scenes::turnedBy(0.6, {1, 2, 0})};
    for (const std::size_t held : {0, 1}) {
        FewSuperquadrics<Linear> scene(linear(1000, 0.1, 0.1), {}, 1e-6);
        for (const std::size_t k : {0, 1}) scene.add(k == held ? spinning : falling);
        scene.body(held).fixBody();
        scene.body(held).setAngularVelocity({0, 0, 50});
        support::expectClosedLedger(scene, 10000);
        EXPECT_GT(std::abs(scene.energyLedger().walls), 1e-3 * scene.energyLedger().kinetic) << held;
    }
}

TEST(SuperquadricRolling, closesTheEnergyLedgerToRoundOff) {
    Box scene(3);
    support::expectClosedLedger(scene, 10000);
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(ledger.rolling, 0.01 * ledger.lost());
    EXPECT_GT(ledger.torsion, 0.001 * ledger.lost());
    EXPECT_LT(std::abs(ledger.stepError), 0.01 * ledger.lost());
}

}  // namespace
}  // namespace pendular::superquadricRollingTest
