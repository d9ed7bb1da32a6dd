#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Energy/OpenAccount.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Grains and rigid bodies that are held along and about some axes of space, or altogether.

namespace pendular::heldAxesTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using support::contains;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;
using Hertz = Species<HertzianViscoelastic>;

constexpr double r = 1e-3, density = 2500, k = 1000;                // m, kg/m^3, N/m
const double m = 4.0 / 3 * std::numbers::pi * r * r * r * density;  // kg

constexpr HeldAxes turnsOnly{.x = true, .y = true, .z = true},
    inPlane{.z = true, .aboutX = true, .aboutY = true};

Smooth smooth() {
    Smooth s;
    s.setDensity(density);
    s.setStiffness(k);
    s.setDissipation(0);
    return s;
}
Rough rough(double friction = 0.4) {
    Rough s;
    s.setDensity(density);
    s.setStiffness(k);
    s.setDissipation(0.002);
    s.setSlidingStiffness(300);
    s.setSlidingDissipation(0.001);
    s.setSlidingFrictionCoefficient(friction);
    return s;
}

// A sphere that turns about y only lies on a plane that is dragged along x at u. Coulomb's force mu k d at
// the arm a = r - d/2 gives it the torque T, of which the spring of friction takes the way s = mu k d / k_t
// to build up: w(t) = T/I (t - s / (2 u)), as long as a w < u; in the end it rolls with the plane, a w = u.
TEST(HeldAxes, aSphereThatOnlyTurnsIsSpunUpByADraggedPlane) {
    constexpr double d = 1e-5, u = 1, h = 1e-6, mu = 0.4;
    FewGrains<Rough> scene(rough(mu), {{.radius = r, .position = {0, 0, r - d}}}, h);
    InfiniteWall plane;
    plane.set({0, 0, -1}, {0, 0, 0});
    plane.setSpecies(scene.speciesHandler.getLastObject());
    plane.setVelocity({u, 0, 0});
    scene.wallHandler.copyAndAddObject(plane);
    scene.keepEnergyLedger();
    scene.particleHandler.getObject(0).setHeldAxes(
        {.x = true, .y = true, .z = true, .aboutX = true, .aboutZ = true});
    scene.initialise();
    const double torque = mu * k * d * (r - 0.5 * d), inertia = 0.4 * m * r * r, way = mu * k * d / 300;
    const double closed = scene.energyLedger().closed();
    for (int step = 0; step < 500; ++step) scene.step();
    // The sphere's own motion in the way of the spring, and its dashpot, are of a few steps' worth.
    const double time = 500 * h, spin = torque / inertia * (time - 0.5 * way / u);
    EXPECT_LT(spin * r, 0.9 * u);
    EXPECT_NEAR(scene.motion(0).spin.y(), -spin, torque / inertia * 3 * h + 0.05 * spin * way / u / time);
    // Its dashpot stops the swinging against the spring of friction at a rate of g / (2 I / a^2) = 119/s.
    for (int step = 0; step < 120000; ++step) scene.step();
    EXPECT_NEAR(scene.motion(0).spin.y() * (r - 0.5 * d), -u, 1e-6 * u);
    EXPECT_EQ(scene.motion(0).position, Vec3D(0, 0, r - d));
    EXPECT_EQ(scene.motion(0).spin.x(), 0);
    // The plane has given what the sphere turns with, and what sliding took.
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(ledger.walls, ledger.kinetic);
    EXPECT_NEAR(ledger.closed(), closed, 120500 * 40 * 0x1p-53 * ledger.walls);
}

// Gravity has a part across the slope: held along it, a sphere rolls as without that part, with 5/7 of g.
TEST(HeldAxes, aSphereInAPlaneRollsDownASlopeAsWithoutTheRest) {
    constexpr double h = 1e-6;
    const auto rolled = [&](bool isHeld) {
        FewGrains<Rough> scene(rough(), {{.radius = r, .position = {0, 0, r}}}, h, {{{0, 0, -1}, {0, 0, 0}}});
        scene.setGravity({0.5, isHeld ? 2.0 : 0.0, -9.81});
        if (isHeld)
            scene.particleHandler.getObject(0).setHeldAxes({.y = true, .aboutX = true, .aboutZ = true});
        scene.run(100000);
        return scene.motion(0);
    };
    const GrainMotion held = rolled(true), free = rolled(false);
    EXPECT_EQ(held.position.y(), 0);
    EXPECT_EQ(held.velocity.y(), 0);
    EXPECT_EQ(held.velocity.x(), free.velocity.x());
    EXPECT_EQ(held.position.z(), free.position.z());
    EXPECT_EQ(held.spin, free.spin);
    EXPECT_NEAR(held.velocity.x(), 5.0 / 7 * 0.5 * 0.1, 1e-3 * 0.036);
}

// Two spheres at arms a = r rest on two held ones at an overlap d: turned by q, the spring of each is pressed
// by a q more or less, so that I q'' = -2 k a^2 q to first order, I = 2 (2/5 m r^2 + m a^2).
double torsionAfter(const Integrator& scheme, int steps, const HeldAxes& axes, Vec3D* place = nullptr) {
    constexpr double d = 1e-5, q = 1e-5;
    const double inertia = 2.8 * m * r * r, frequency = std::sqrt(2 * k * r * r / inertia);
    const Vec3D arm(r * std::cos(q), 0, r * std::sin(q));
    FewGrains<Smooth> scene(smooth(),
                            {{.radius = r, .position = -arm},
                             {.radius = r, .position = arm},
                             {.radius = r, .position = {-r, 0, d - 2 * r}, .fixed = true},
                             {.radius = r, .position = {r, 0, d - 2 * r}, .fixed = true}},
                            0.75 * std::numbers::pi / frequency / steps);
    scene.setIntegrator(scheme);
    scene.acceptUnstableTimeStep();
    BodyReference body = scene.bodyHandler.join({0, 1});
    body.setHeldAxes(axes);
    scene.run(steps);
    if (place) *place = body.getPosition();
    const Vec3D along = scene.motion(1).position - scene.motion(0).position;
    return std::atan2(along.z(), along.x()) / q;
}

TEST(HeldAxes, aClumpHeldAgainstTranslationSwingsBetweenSprings) {
    // Terms of second order in q and d/r: 1e-5 of q at most; of the step (w h)^2/24 of the angle 3/4 pi.
    const double exact = -std::sqrt(0.5);
    for (const HeldAxes& axes : {turnsOnly, HeldAxes{true, true, true, true, false, true}}) {
        Vec3D place;
        const double coarse = torsionAfter(integrators::velocityVerlet, 50, axes) - exact,
                     fine = torsionAfter(integrators::velocityVerlet, 100, axes, &place) - exact;
        EXPECT_NEAR(std::log2(coarse / fine), 2, 0.2);
        EXPECT_LT(std::abs(fine), 1e-3);
        EXPECT_LT(place.norm(), 1e-19);
    }
}

/// Discs in a box, of which some are dimers.
struct FlatGas : FewGrains<Rough> {
    const bool byScene;  // the scene holds them, and not each by itself

    explicit FlatGas(int threads = 1, bool isFlat = false, bool isHeldByScene = false)
        : FewGrains(rough(), discs(isFlat), 1e-6,
                    {{{-1, 0, 0}, {0, 0, 0}},
                     {{1, 0, 0}, {0.02, 0, 0}},
                     {{0, -1, 0}, {0, 0, 0}},
                     {{0, 1, 0}, {0, 0.02, 0}}}),
          byScene(isHeldByScene) {
        if (byScene) particleHandler.holdAll(inPlane);
        setNumberOfThreads(threads);
        keepEnergyLedger();
        acceptUnstableTimeStep();
    }
    void setupInitialConditions() override {
        if (bodyHandler.getSize() > 0) return;
        for (std::uint32_t n = 0; n < 8; n += 2) {
            BodyReference body = bodyHandler.join({n, n + 1});
            if (!byScene) body.setHeldAxes(inPlane);
        }
        for (std::uint32_t n = 8; n < particleHandler.getSize() && !byScene; ++n) {
            GrainReference grain = particleHandler.getObject(n);
            grain.setHeldAxes(inPlane);
        }
    }
    /// @param flat moving in the plane from the start
    static std::vector<GrainMotion> discs(bool flat) {
        std::mt19937 random(7);
        const auto even = [&] { return static_cast<double>(random()) / 0x1p32 - 0.5; };
        std::vector<GrainMotion> all;
        for (int x = 0; x < 8; ++x)
            for (int y = 0; y < 8; ++y)
                all.push_back({.radius = r * (0.8 + 0.3 * even()),
                               .position = {0.0025 * x + 0.0013, 0.0025 * y + 0.0013, 1e-4 * even()},
                               .velocity = {even(), even(), even()},
                               .spin = {100 * even(), 100 * even(), 100 * even()}});
        for (GrainMotion& grain : all)
            if (flat) grain.velocity.z() = grain.spin.x() = grain.spin.y() = 0;
        return all;
    }
    void steps(int count) {
        for (int n = 0; n < count; ++n) step();
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(particleHandler.store()); }
};

TEST(HeldAxes, aFlatGasStaysFlatAndClosesItsLedger) {
    FlatGas scene;
    scene.initialise();
    const std::vector<double> heights = [&] {
        std::vector<double> all;
        for (const GrainReference grain : scene.particleHandler) all.push_back(grain.getPosition().z());
        return all;
    }();
    EXPECT_LT(energy::openness<FlatGas>(
                  scene, [](FlatGas&) {}, 5000),
              1);
    EXPECT_GT(scene.energyLedger().lost(), 0);
    std::size_t n = 0;
    for (const GrainReference grain : scene.particleHandler) {
        EXPECT_EQ(grain.getVelocity().z(), 0);
        EXPECT_EQ(grain.getAngularVelocity().x(), 0);
        EXPECT_EQ(grain.getAngularVelocity().y(), 0);
        // Grains of bodies are placed about the centres of these: round-off of a radius.
        EXPECT_NEAR(grain.getPosition().z(), heights[n], n < 8 ? 5000 * 0x1p-53 * r : 0);
        ++n;
    }
    EXPECT_EQ(scene.energyLedger().walls, 0);
}

TEST(HeldAxes, areTheSameBitsForAnyThreadsAndRestarts) {
    FlatGas one, three(3);
    one.initialise(), three.initialise();
    one.steps(3000), three.steps(3000);
    EXPECT_EQ(one.hash(), three.hash());
    const support::TestFolder folder;
    FlatGas half;
    half.initialise();
    half.steps(1000);
    half.writeRestart(folder.path() / "half.h5");
    half.steps(1000);
    half.writeRestart(folder.path() / "whole.h5");
    FlatGas resumed;
    resumed.restartFrom(folder.path() / "half.h5");
    resumed.initialise();
    resumed.steps(1000);
    resumed.writeRestart(folder.path() / "resumed.h5");
    support::expectSameState(folder.path() / "whole.h5", folder.path() / "resumed.h5");
    EXPECT_EQ(resumed.particleHandler.getObject(0).getHeldAxes(), inPlane);
    EXPECT_EQ(resumed.particleHandler.getObject(20).getHeldAxes(), inPlane);
}

TEST(HeldAxes, allThatTheSceneHoldsMoveAsThoseThatAreHeldOneByOne) {
    FlatGas one(1, true), scene(1, true, true);
    one.initialise(), scene.initialise();
    one.steps(2000), scene.steps(2000);
    EXPECT_EQ(one.hash(), scene.hash());
    EXPECT_EQ(scene.particleHandler.getObject(0).getHeldAxes(), inPlane);
    EXPECT_EQ(scene.particleHandler.getObject(20).getHeldAxes(), inPlane);
    for (std::size_t k = 0; k < scene.bodyHandler.getSize(); ++k) {
        EXPECT_EQ(scene.bodyHandler.getObject(k).getVelocity().z(), 0);
        EXPECT_EQ(scene.bodyHandler.getObject(k).getAngularVelocity().x(), 0);
    }
}

TEST(HeldAxes, aSceneInAPlaneGoesOnFromOneInThatPlane) {
    const support::TestFolder folder;
    FlatGas whole(1, true, true);
    whole.initialise();
    whole.steps(300);
    whole.writeRestart(folder.path() / "half.h5");
    whole.steps(300);
    FlatGas resumed(1, true, true);
    resumed.restartFrom(folder.path() / "half.h5");
    resumed.initialise();
    resumed.steps(300);
    EXPECT_EQ(resumed.hash(), whole.hash());
    FewGrains<Rough> free(rough(), {{.radius = r}}, 1e-6), flat(rough(), {{.radius = r}}, 1e-6);
    free.initialise();
    free.writeRestart(folder.path() / "free.h5");
    flat.particleHandler.holdAll(inPlane);
    flat.restartFrom(folder.path() / "free.h5");
    const std::string said = support::refusal([&] { flat.initialise(); });
    EXPECT_TRUE(support::isOneSentence(said) && contains(said, "holds all")) << said;
}

TEST(HeldAxes, discsDoNotGoOnAsSpheres) {
    const support::TestFolder folder;
    const auto scene = [] {
        auto made =
            std::make_unique<FewGrains<Rough>>(rough(), std::vector<GrainMotion>{{.radius = r}}, 1e-6);
        made->particleHandler.holdAll(inPlane);
        made->setIntegrator(integrators::velocityVerlet);
        return made;
    };
    const auto discs = scene(), spheres = scene(), more = scene();
    discs->speciesHandler.setGrainsAreDiscs(), more->speciesHandler.setGrainsAreDiscs();
    discs->initialise();
    discs->writeRestart(folder.path() / "discs.h5");
    spheres->restartFrom(folder.path() / "discs.h5");
    const std::string said = support::refusal([&] { spheres->initialise(); });
    EXPECT_TRUE(support::isOneSentence(said) && contains(said, "discs")) << said;
    more->restartFrom(folder.path() / "discs.h5");
    more->initialise();
    EXPECT_EQ(more->particleHandler.getObject(0).getMass(), std::numbers::pi * r * r * density);
}

TEST(HeldAxes, whatTheSceneHoldsIsNotLetGo) {
    FewGrains<Rough> scene(rough(),
                           {{.radius = r, .velocity = {0.1, 0, 0}, .spin = {0, 0, 3}},
                            {.radius = r, .position = {0, 3 * r, 0}, .fixed = true}},
                           1e-6);
    scene.particleHandler.holdAll(inPlane);
    GrainReference free = scene.particleHandler.getObject(0), fixed = scene.particleHandler.getObject(1);
    EXPECT_EQ(free.getHeldAxes(), inPlane);
    EXPECT_TRUE(fixed.isFixed());
    scene.particleHandler.holdAll({});
    EXPECT_EQ(free.getHeldAxes(), HeldAxes{});
    scene.particleHandler.holdAll(inPlane);
    EXPECT_EQ(free.getHeldAxes(), inPlane);
    fixed.fixParticle(false);
    EXPECT_EQ(fixed.getHeldAxes(), inPlane);
    EXPECT_EQ(fixed.getMass(), free.getMass());
    free.setHeldAxes({.x = true});
    EXPECT_EQ(free.getHeldAxes(), (HeldAxes{true, false, true, true, true, false}));
    free.setHeldAxes({.x = true, .y = true, .aboutZ = true});
    EXPECT_TRUE(free.isFixed());
    free.fixParticle(false);
    EXPECT_EQ(free.getHeldAxes(), inPlane);
    SphericalParticle rising(scene.speciesHandler.getLastObject());
    rising.setRadius(r), rising.setVelocity({0, 0, 1e-300});
    BodyReference body = scene.bodyHandler.join({1});
    for (const std::string& said :
         {support::refusal([&] {
              free.setVelocity({0, 0, 1});
          }),
          support::refusal([&] {
              free.setAngularVelocity({1, 0, 0});
          }),
          support::refusal([&] {
              body.setVelocity({0, 0, 1});
          }),
          support::refusal([&] {
              body.setAngularVelocity({0, 1, 0});
          }),
          support::refusal([&] { scene.particleHandler.copyAndAddObject(rising); }),
          support::refusal([&] { scene.particleHandler.holdAll({}); }), support::refusal([&] {
              scene.setGravity({0, 0, -1});
              scene.initialise();
          })})
        EXPECT_TRUE(support::isOneSentence(said) && contains(said, "held")) << said;
    body.setHeldAxes({});
    EXPECT_EQ(body.getHeldAxes(), inPlane);
}

// A disc has the moment m r^2 / 2: down a slope it rolls with 2/3 of g sin, where a sphere has 5/7.
TEST(HeldAxes, discsRollAsDiscsDo) {
    const double mass = std::numbers::pi * r * r * density, depth = mass * 9.81 / k;  // 8 % of the radius
    FewGrains<Rough> scene(rough(), {{.radius = r, .position = {0, r - depth, 0}}}, 1e-6,
                           {{{0, -1, 0}, {0, 0, 0}}});
    scene.setGravity({0.5, -9.81, 0});
    scene.acceptOverlaps(0.1);
    scene.setIntegrator(integrators::velocityVerlet);
    scene.speciesHandler.setGrainsAreDiscs();
    scene.particleHandler.holdAll(inPlane);
    scene.run(100000);
    EXPECT_NEAR(scene.particleHandler.getObject(0).getMass(), mass, 1e-14 * mass);
    EXPECT_NEAR(scene.particleHandler.getObject(0).getInertia(), 0.5 * mass * r * r, 1e-14 * mass * r * r);
    // Its lever is less by half the depth. What begins at rest swings on the spring of friction, 3/m of it.
    const double lever = 1 - 0.5 * depth / r, swing = 0.5 / 3 / std::sqrt(3 * 300 / mass);
    EXPECT_NEAR(scene.motion(0).velocity.x(), 0.05 / (1 + 0.5 / (lever * lever)), 1.1 * swing);
    EXPECT_EQ(scene.motion(0).velocity.z(), 0);
    for (const bool withIntegrator : {false, true}) {
        FewGrains<Rough> other(rough(), {{.radius = r}}, 1e-6);
        other.speciesHandler.setGrainsAreDiscs();
        if (withIntegrator) other.setIntegrator(integrators::velocityVerlet);
        else other.particleHandler.holdAll(inPlane);
        const std::string said = support::refusal([&] { other.initialise(); });
        EXPECT_TRUE(support::isOneSentence(said) &&
                    contains(said, withIntegrator ? "plane of x and y" : "velocityVerlet"))
            << said;
    }
}

// Whatever holds the target, a grain rebounds from it as from a wall, with e = 0.5: dashpots are made for the
// grain's mass, where a free target would halve it.
TEST(HeldAxes, aGrainReboundsFromWhatIsHeldAsFromAWall) {
    const auto rebound = [](const std::function<void(FewGrains<Hertz>&)>& hold) {
        Hertz s;
        s.setDensity(density);
        s.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.5);
        FewGrains<Hertz> scene(s,
                               {{.radius = r, .position = {0, 0, 2.001 * r}, .velocity = {0, 0, -0.1}},
                                {.radius = r, .position = {0, 0, 0}},
                                {.radius = r, .position = {0, 0, -2 * r}}},
                               1e-6);
        hold(scene);
        scene.run(2000);
        EXPECT_TRUE(scene.interactions().empty());
        EXPECT_LT(scene.motion(1).velocity.norm(), 1e-15);  // round-off where it may move sideways
        return scene.motion(0).velocity.z() / 0.1;
    };
    const double fixed = rebound([](auto& s) { s.particleHandler.getObject(1).fixParticle(); });
    EXPECT_NEAR(fixed, 0.5, 0.005);
    EXPECT_NEAR(rebound([](auto& s) { s.particleHandler.getObject(1).setHeldAxes(turnsOnly); }), fixed, 1e-9);
    EXPECT_NEAR(rebound([](auto& s) { s.particleHandler.getObject(1).setHeldAxes({.z = true}); }), fixed,
                1e-9);
    EXPECT_NEAR(rebound([](auto& s) { s.bodyHandler.join({1, 2}).fixBody(); }), fixed, 1e-9);
    EXPECT_NEAR(rebound([](auto& s) { s.bodyHandler.join({1, 2}).setHeldAxes(turnsOnly); }), fixed, 1e-9);
}

// A body that is held goes its way at the velocity and the spin that it is given, whatever hits it: its
// grains are on circles about the centre.
TEST(HeldAxes, aHeldBodyKeepsItsMotion) {
    FewGrains<Rough> scene(rough(),
                           {{.radius = r, .position = {-r, 0, 0}},
                            {.radius = r, .position = {r, 0, 0}},
                            {.radius = r, .position = {0, 0, 3 * r}, .velocity = {0, 0, -0.5}}},
                           1e-6);
    scene.keepEnergyLedger();
    BodyReference body = scene.bodyHandler.join({0, 1});
    body.fixBody();
    body.setVelocity({0.01, 0, 0});
    body.setAngularVelocity({0, 0, 50});
    EXPECT_TRUE(body.isFixed() && scene.particleHandler.getObject(0).isFixed());
    scene.initialise();
    EXPECT_EQ(scene.getKineticEnergy(), scene.energyLedger().kinetic);  // of the third grain only
    EXPECT_LT(energy::openness<FewGrains<Rough>>(
                  scene, [](auto&) {}, 10000),
              1);
    EXPECT_GT(scene.motion(2).velocity.z(), 0);  // it has bounced
    const double angle = 50 * 0.01;
    EXPECT_LT((body.getPosition() - Vec3D(1e-4, 0, 0)).norm(), 1e-15);
    // (w h)^4 / 120 a step of the turn
    EXPECT_LT(
        (scene.motion(1).position - body.getPosition() - Vec3D(r * std::cos(angle), r * std::sin(angle), 0))
            .norm(),
        1e-12 * r);
    EXPECT_EQ(body.getAngularVelocity(), Vec3D(0, 0, 50));
    EXPECT_NE(scene.energyLedger().walls, 0);
    body.fixBody(false);
    scene.step();
    EXPECT_FALSE(scene.particleHandler.getObject(0).isFixed());
    EXPECT_NEAR(body.getMass(), 2 * m, 1e-12 * m);
}

// What holds a body in a motion gives and takes energy; about the other axes it is free.
TEST(HeldAxes, bodiesAndGrainsThatAreDrivenAlongHeldAxesCloseTheLedger) {
    FewGrains<Rough> scene(rough(),
                           {{.radius = r, .position = {0, 0, r}},
                            {.radius = r, .position = {0.5 * r, 0, 1.2 * r}},
                            {.radius = 0.7 * r, .position = {0, 1.2 * r, 0.9 * r}},
                            {.radius = r, .position = {3 * r, 0.2 * r, r}},
                            {.radius = r, .position = {5 * r, 0.3 * r, 1.01 * r}}},
                           1e-6, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setGravity({1, 0.5, -9.81});
    scene.keepEnergyLedger();
    scene.acceptUnstableTimeStep();
    const double i = m * r * r;
    BodyReference body = scene.bodyHandler.join(
        {0, 1, 2}, BodyMass{2 * m, {0.1 * r, 0.3 * r, r}, Vec3D(0.5 * i, 0.6 * i, 0.8 * i).asDiagonal()});
    body.setHeldAxes({.y = true, .aboutZ = true});
    body.setVelocity({0.1, 0.02, 0});
    body.setAngularVelocity({3, 0, 40});
    GrainReference grain = scene.particleHandler.getObject(3);
    grain.setHeldAxes({.x = true, .aboutY = true});
    grain.setVelocity({0.05, 0, 0});
    grain.setAngularVelocity({0, 30, 0});
    scene.initialise();
    const double total = scene.energyLedger().total();
    EXPECT_LT(energy::openness<FewGrains<Rough>>(
                  scene, [](auto&) {}, 20000),
              1);
    EXPECT_EQ(body.getVelocity().y(), 0.02);
    EXPECT_EQ(body.getAngularVelocity().z(), 40);
    EXPECT_EQ(scene.motion(3).velocity.x(), 0.05);
    EXPECT_EQ(scene.motion(3).spin.y(), 30);
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(std::abs(ledger.walls), 0.01 * energy::largestOf(ledger));
    // Beside the error of the steps, a part of a thousand of what has been given and lost.
    EXPECT_NEAR(ledger.total(), total, 2e-3 * (std::abs(ledger.walls) + ledger.lost() + ledger.kinetic));
}

TEST(HeldAxes, momentumIsKeptAlongFreeAxesOnly) {
    FewGrains<Rough> scene(rough(),
                           {{.radius = r, .position = {0, 0, 0}, .velocity = {0.3, 0.1, 0}},
                            {.radius = r, .position = {2.1 * r, 0.4 * r, 0.3 * r}, .velocity = {-0.2, 0, 0}}},
                           1e-6);
    for (const std::uint32_t n : {0, 1}) scene.particleHandler.getObject(n).setHeldAxes({.z = true});
    scene.initialise();
    const Vec3D before = scene.getTotalMomentum();
    for (int n = 0; n < 3000; ++n) scene.step();
    const Vec3D change = scene.getTotalMomentum() - before;
    EXPECT_GT((scene.motion(0).velocity - Vec3D(0.3, 0.1, 0)).norm(), 0.05);
    EXPECT_LT(change.norm(), 3000 * 0x1p-53 * 2 * m * 0.3);
    EXPECT_EQ(scene.motion(0).velocity.z(), 0);
}

TEST(HeldAxes, ofGrainsThatAreJoinedAreThoseOfTheBody) {
    FewGrains<Smooth> scene(smooth(),
                            {{.radius = r, .position = {0, 0, 0}, .fixed = true},
                             {.radius = r, .position = {2 * r, 0, 0}, .fixed = true},
                             {.radius = r, .position = {5 * r, 0, 0}},
                             {.radius = r, .position = {7 * r, 0, 0}}},
                            1e-6);
    const std::string refusal = support::refusal([&] { scene.bodyHandler.join({0, 2}); });
    EXPECT_TRUE(contains(refusal, "particles 0 and 2 are not held alike")) << refusal;
    EXPECT_TRUE(support::isOneSentence(refusal));
    scene.particleHandler.getObject(1).setVelocity({0, 0.2, 0});
    const BodyReference held = scene.bodyHandler.join({0, 1});
    EXPECT_TRUE(held.isFixed());
    EXPECT_LT((held.getVelocity() - Vec3D(0, 0.1, 0)).norm(), 1e-15);
    for (const std::uint32_t n : {2, 3}) scene.particleHandler.getObject(n).setHeldAxes(inPlane);
    EXPECT_EQ(scene.bodyHandler.join({2, 3}).getHeldAxes(), inPlane);
    const std::string changed =
        support::refusal([&] { scene.particleHandler.getObject(2).setHeldAxes(turnsOnly); });
    EXPECT_TRUE(contains(changed, "part of the rigid body 1")) << changed;
}

TEST(HeldAxes, canBeChangedInTheRun) {
    FewGrains<Smooth> scene(smooth(), {{.radius = r, .position = {0, 0, 1}}}, 1e-5);
    scene.setGravity({0, 0, -10});
    scene.initialise();
    GrainReference grain = scene.particleHandler.getObject(0);
    for (int n = 0; n < 100; ++n) scene.step();
    EXPECT_NEAR(grain.getVelocity().z(), -0.01, 1e-15);
    grain.setHeldAxes({.z = true});
    for (int n = 0; n < 100; ++n) scene.step();
    EXPECT_EQ(grain.getVelocity().z(), 0);
    grain.setHeldAxes({});
    for (int n = 0; n < 100; ++n) scene.step();
    EXPECT_NEAR(grain.getVelocity().z(), -0.01, 1e-15);
    EXPECT_FALSE(grain.isFixed());
    grain.setHeldAxes(HeldAxes::all());
    EXPECT_TRUE(grain.isFixed());
    EXPECT_EQ(grain.getHeldAxes(), HeldAxes::all());
}

}  // namespace
}  // namespace pendular::heldAxesTest
