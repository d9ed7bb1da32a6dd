#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "Kernel/Laws/Friction/CombinedLaws.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"

// What single mechanisms take or give, against closed forms; torsion, plastic contacts and adhesions are
// beside their laws (SelfTests/Species).

namespace pendular::mechanismTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using Rough = Species<LinearViscoelastic, SlidingRollingTorsion>;

constexpr double radius = 1e-3, density = 2500, fieldStrength = 9.81;  // m, kg/m^3, m/s^2
constexpr double stiffness = 2000, stepLength = 2e-6;                  // N/m, s
const double mass = sphereMass(radius, density);                       // kg

Rough material(double friction, double rolling, double dissipation = 0.02) {
    Rough species;
    species.setDensity(density);
    species.setStiffness(stiffness);
    species.setDissipation(dissipation);
    species.setSlidingStiffness(2.0 / 7 * stiffness);
    species.setSlidingDissipation(friction > 0 ? 0.01 : 0);
    species.setSlidingFrictionCoefficient(friction);
    species.setRollingStiffness(500);
    species.setRollingDissipation(0.01);
    species.setRollingFrictionCoefficient(rolling);
    return species;
}

/// A grain on the plane z = 0, pressed in by what its weight needs.
struct OnPlane : FewGrains<Rough> {
    OnPlane(const Rough& species, const Vec3D& velocity, const Vec3D& spin)
        : FewGrains(species,
                    {{.radius = radius,
                      .position = {0, 0, radius - mass * fieldStrength / stiffness},
                      .velocity = velocity,
                      .spin = spin}},
                    stepLength, {{{0, 0, -1}, {0, 0, 0}}}) {
        setGravity({0, 0, -fieldStrength});
        keepEnergyLedger();
        initialise();
    }
    void runTo(double time) {
        while (getTime() < time) step();
    }
};

// A sphere that slides without spin slows down by mu g and is turned by 5/2 mu g / r, so that it slips by
// s(t) = v t - 7/4 mu g t^2 until it rolls, at t = 2 v / (7 mu g): mu m g s is lost, m v^2 / 7 in all. The
// spring takes up mu m g / k_t = 5e-8 m first, 1e-4 of the way; the lever is shorter by half the overlap,
// 3e-5 of it.
TEST(Mechanism, slidingTakesFrictionTimesWay) {
    const double friction = 0.3, speed = 0.1, toRoll = 2 * speed / (7 * friction * fieldStrength);
    OnPlane sphere(material(friction, 0), {speed, 0, 0}, {0, 0, 0});
    const EnergyLedger& ledger = sphere.energyLedger();
    sphere.runTo(0.5 * toRoll);
    const double now = sphere.getTime(), way = speed * now - 1.75 * friction * fieldStrength * now * now;
    EXPECT_NEAR(ledger.sliding / (friction * mass * fieldStrength * way), 1, 5e-4);
    EXPECT_NEAR(ledger.tangentialElastic /
                    (0.5 * std::pow(friction * mass * fieldStrength, 2) / (2.0 / 7 * stiffness)),
                1, 5e-4);
    sphere.runTo(2 * toRoll);
    EXPECT_NEAR(ledger.sliding / (mass * speed * speed / 7), 1, 5e-4);
    EXPECT_NEAR(ledger.kinetic / (mass * speed * speed * 5 / 14), 1, 5e-4);
    EXPECT_EQ(ledger.rolling, 0);
    EXPECT_EQ(ledger.plastic, 0);
}

// A sphere that rolls comes to rest by rolling friction alone, which takes all its energy, 7/10 m v^2; the
// springs hold (mu_r m g)^2 / (2 k_r) and as much of sliding before they swing out, 3e-4 of it.
TEST(Mechanism, rollingTakesAllOfARollingSphere) {
    const double speed = 0.02;
    OnPlane sphere(material(0.8, 0.2), {speed, 0, 0}, {0, speed / radius, 0});
    sphere.runTo(0.03);
    EXPECT_LT(std::abs(sphere.motion(0).velocity.x()), 1e-3 * speed);
    EXPECT_NEAR(sphere.energyLedger().rolling / (0.7 * mass * speed * speed), 1, 1e-3);
    EXPECT_EQ(sphere.energyLedger().sliding, 0);
}

// A wall, or a grain that is held, and moves with V against a grain at rest throws it off with 2 V: it has
// done the work 2 m V^2. The steps err by (w dt)^2 / 12 = 6e-5 of it, w = sqrt(k / m).
TEST(Mechanism, wallsAndHeldGrainsThatMoveDoWork) {
    const double speed = 0.1, work = 2 * mass * speed * speed;
    const GrainMotion resting{.radius = radius, .position = {0, 0, 1.01 * radius}};
    for (const bool isWall : {true, false}) {
        std::vector<GrainMotion> grains{resting};
        if (!isWall) grains.push_back({.radius = radius, .position = {0, 0, -radius}, .fixed = true});
        FewGrains<Rough> scene(material(0, 0, 0), grains, stepLength);
        if (isWall) {
            InfiniteWall wall;
            wall.set({0, 0, -1}, {0, 0, 0});
            wall.setSpecies(scene.speciesHandler.getObject(0));
            wall.setVelocity({0, 0, speed});
            scene.wallHandler.copyAndAddObject(wall);
        } else {
            scene.particleHandler.getObject(1).setVelocity({0, 0, speed});
        }
        scene.keepEnergyLedger();
        scene.initialise();
        for (int k = 0; k < 1000; ++k) scene.step();
        const EnergyLedger& ledger = scene.energyLedger();
        EXPECT_NEAR(ledger.walls / work, 1, 2e-4) << isWall;
        EXPECT_NEAR(ledger.kinetic / work, 1, 2e-4) << isWall;
        EXPECT_NEAR(ledger.closed(), 0, 1e-14 * work) << isWall;
        EXPECT_EQ(ledger.driver, 0);
    }
}

TEST(Mechanism, whatADriverChangesIsItsOwnEntry) {
    FewGrains<Rough> scene(
        material(0, 0), {{.radius = radius, .position = {0, 0, 1}, .velocity = {1, 0, 0}, .spin = {0, 9, 0}}},
        stepLength);
    scene.setGravity({0, 0, -fieldStrength});
    scene.keepEnergyLedger();
    scene.initialise();
    scene.step();
    const double before = scene.energyLedger().closed(), fall = stepLength * stepLength * fieldStrength;
    const Vec3D velocity = scene.motion(0).velocity;
    scene.particleHandler.getObject(0).setVelocity({0, 3, 0});
    scene.step();
    const double given = 0.5 * mass * (9 - velocity.squaredNorm());
    EXPECT_NEAR(scene.energyLedger().driver / given, 1, 1e-12);
    scene.setGravity({0, 0, -2 * fieldStrength});
    scene.step();
    // The grain has fallen by next to nothing below 1 m.
    EXPECT_NEAR((scene.energyLedger().driver - given) / (mass * fieldStrength), 1, 4 * fall + 1e-10);
    EXPECT_NEAR(scene.energyLedger().closed() / before, 1, 1e-14);
}

// Grains that collide with friction under each integrator. A step rounds each velocity at most four times,
// by up to 2^-53, and the field's share, the same in each step, always to the same side: so the 300 steps
// may move the account by 300 x 4 x 2^-53 of it.
TEST(Mechanism, theAccountClosesUnderEveryIntegrator) {
    for (const Integrator& integrator : integrators::all) {
        FewGrains<Rough> scene(material(0.3, 0.1),
                               {{.radius = radius, .velocity = {0.3, 0.1, 0}, .spin = {90, -200, 70}},
                                {.radius = radius, .position = {2.01e-3, 2e-4, 0}, .velocity = {0, 0.1, 0}}},
                               stepLength);
        scene.setIntegrator(integrator);
        scene.setGravity({1, 2, -fieldStrength});
        scene.keepEnergyLedger();
        scene.initialise();
        const double start = scene.energyLedger().closed();
        for (int k = 0; k < 300; ++k) scene.step();
        const EnergyLedger& ledger = scene.energyLedger();
        EXPECT_NEAR(ledger.closed(), start, 1.4e-13 * std::abs(start)) << integrator.name;
        for (const double lost : {ledger.normalDashpots, ledger.sliding, ledger.rolling})
            EXPECT_GT(lost, 1e-3 * start) << integrator.name;
    }
}

/// A held grain on a plate that moves: the plate shears the contact, then presses it to another overlap.
template <class F>
struct PressedAndSheared : FewGrains<Species<HertzianViscoelastic, F>> {
    static constexpr double shallow = 0.01 * radius, way = 1e-6;  // m
    static constexpr int stepsOfMotion = 2000;

    PressedAndSheared()
        : FewGrains<Species<HertzianViscoelastic, F>>(
              hertzian(), {{.radius = radius, .position = {0, 0, radius - shallow}, .fixed = true}},
              stepLength, {{{0, 0, -1}, {0, 0, 0}}}) {
        this->setHeldContacts(HeldContacts::All);
        this->keepEnergyLedger();
        this->acceptUnstableTimeStep();
        this->initialise();
    }
    static Species<HertzianViscoelastic, F> hertzian() {
        Species<HertzianViscoelastic, F> species;
        species.setDensity(density);
        species.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.5);
        species.setEffectiveShearModulus(4e6);
        species.setSlidingFrictionCoefficient(100);  // nothing slides
        return species;
    }
    /// @param by m, of the plate, in so many steps; then it rests for some
    void move(const Vec3D& by) {
        const auto go = [&](const Vec3D& velocity, int steps) {
            dynamic_cast<InfiniteWall&>(this->wallHandler.getObject(0)).setVelocity(velocity);
            for (int k = 0; k < steps; ++k) this->step();
        };
        go(by / (stepsOfMotion * stepLength), stepsOfMotion);
        go(Vec3D::Zero(), 3);
    }
    void press(double by) { move({0, 0, by}); }
};

/// What the stiffness takes of the energy E of a sheared contact that is pressed to four times its overlap,
/// so that k becomes 2 k, and let back: over E.
template <class F>
std::array<double, 2> lostByStiffness() {
    PressedAndSheared<F> contact, unsheared;
    const EnergyLedger &ledger = contact.energyLedger(), &ofNormal = unsheared.energyLedger();
    contact.move({contact.way, 0, 0});
    const double stored = ledger.tangentialElastic;
    const double stiffness = 8 * 4e6 * std::sqrt(radius * contact.shallow) * F{}.getSpringFactor();
    EXPECT_NEAR(stored / (0.5 * stiffness * contact.way * contact.way), 1, 1e-3);  // half a step of the way
    EXPECT_EQ(ledger.stiffening, 0);
    EXPECT_GT(ledger.tangentialDashpots, 0);
    const double before = ledger.stepError;
    std::array<double, 2> lost{};
    for (const double by : {3 * contact.shallow, -3 * contact.shallow}) {
        const double last = ledger.stiffening;
        contact.press(by), unsheared.press(by);
        lost[by > 0 ? 0 : 1] = (ledger.stiffening - last) / stored;
    }
    EXPECT_EQ(ledger.sliding, 0);
    EXPECT_NEAR((ledger.stepError - before - ofNormal.stepError) / stored, 0, 1e-5);
    return lost;
}

// A spring that keeps its stretch gains E, and gives it back. One that keeps its force as the contact closes
// has E/2 then, and half of that where it opens again: 1/2 and 1/4 of E are lost, and nothing has slid. (So
// nothing is worn of a wall, either.) The stiffness changes by 1/1000 in a step: 1e-5 is ten times the
// square.
TEST(Mechanism, stiffnessTakesOfSpringsWhatTheirLawSays) {
    const auto kept = lostByStiffness<Mindlin>();
    EXPECT_NEAR(kept[0], -1, 1e-5);
    EXPECT_NEAR(kept[1], 1, 1e-5);
    const auto follows = lostByStiffness<MindlinIncremental>();
    EXPECT_NEAR(follows[0], 0.5, 1e-5);
    EXPECT_NEAR(follows[1], 0.25, 1e-5);
}

}  // namespace
}  // namespace pendular::mechanismTest
