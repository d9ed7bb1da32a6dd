// Contacts between bodies that are held along all axes: where something needs them, and nowhere else.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Heat/HeatPart.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::heldContactsTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using scenes::HookedGrains;
using scenes::PlaneAt;
using Linear = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;
using Hertz = Species<HertzianViscoelastic, Mindlin>;

constexpr double r = 1e-3, deep = 1e-5;                                    // m
constexpr double stiffness = 500, dashpot = 0.02;                          // N/m, kg/s
constexpr double density = 2500, dt = 2e-6;                                // kg/m^3, s
constexpr double mass = 4.0 / 3 * std::numbers::pi * r * r * r * density;  // kg
constexpr double roundOff = 10 * 0x1p-52 * r / deep;                       // of an overlap

Linear linear() {
    Linear species;
    species.setDensity(density), species.setStiffness(stiffness), species.setDissipation(dashpot);
    return species;
}
Rough rough() {
    Rough species;
    species.setDensity(density), species.setStiffness(stiffness), species.setDissipation(dashpot);
    species.setSlidingStiffness(200), species.setSlidingDissipation(0.01);
    species.setSlidingFrictionCoefficient(0.5);
    return species;
}
Hertz hertz() {
    Hertz species;
    species.setDensity(density), species.setEffectiveElasticModulus(2e6), species.setDissipation(0.3);
    species.setEffectiveShearModulus(1.4e6), species.setSlidingDissipation(0.2);
    species.setSlidingFrictionCoefficient(0.4);
    return species;
}

/// Two grains that are held and overlap.
std::vector<GrainMotion> heldPair(const Vec3D& velocity = Vec3D::Zero()) {
    return {{.radius = r, .fixed = true},
            {.radius = r, .position = {2 * r - deep, 0, 0}, .velocity = velocity, .fixed = true}};
}

template <class Scene>
Scene& ready(Scene& scene) {
    scene.keepEnergyLedger();
    scene.setQuiet();
    scene.setTimeMax(1);
    return scene;
}

/// A floor of driven and of still grains that overlap, with free grains on it, and a plate that rests on all.
class Driven : public FewGrains<Rough> {
public:
    explicit Driven(int threads = 1) : FewGrains(rough(), grainsOf(), dt) {
        setHeldContacts(HeldContacts::All);
        for (GrainReference grain : particleHandler)
            if (grain.isFixed() && grain.getId() % 3 == 0) grain.setVelocity({0.3, 0.1, 0.2});
        InfiniteWall plate({0, 0, 1}, {0, 0, 4.955 * r}, speciesHandler.getObject(0));
        plate.setPiston(1e-4, 0.02);
        wallHandler.copyAndAddObject(plate);
        setGravity({0, 0, -9.81});
        setNumberOfThreads(threads);
        ready(*this);
    }
    static std::vector<GrainMotion> grainsOf() {
        std::vector<GrainMotion> grains;
        for (int z = 0; z < 3; ++z)
            for (int k = 0; k < 64; ++k)
                grains.push_back({.radius = r,
                                  .position = {1.98 * r * (k % 8), 1.98 * r * (k / 8), 1.98 * r * z},
                                  .fixed = z < 2});
        return grains;
    }
};

class Lines {
public:
    Lines() {
        setLogSink([this](LogLevel level, std::string_view text) {
            if (level == LogLevel::Warn) told.emplace_back(text);
        });
    }
    ~Lines() { setLogSink({}); }
    std::vector<std::string> told;
};

/// The forces and torques of all held grains.
std::vector<Vec3D> loadsOfHeld(Scene& scene) {
    std::vector<Vec3D> all;
    for (const GrainReference grain : scene.particleHandler)
        if (grain.isFixed()) all.push_back(grain.getForce()), all.push_back(grain.getTorque());
    return all;
}

// --- Asked for

// Before the run there are none; on several ranks, when all grains are together, they are those of one.
TEST(HeldContacts, giveForceAndTorqueToGrains) {
    constexpr std::size_t steps = 40;
    Driven alone;
    for (const Vec3D& load : loadsOfHeld(alone)) EXPECT_EQ(load, Vec3D::Zero());
    alone.initialise();
    alone.step(steps);
    const std::vector<Vec3D> expected = loadsOfHeld(alone);
    ASSERT_EQ(expected.size(), 256u);
    double force = 0, torque = 0;
    for (std::size_t k = 0; k < expected.size(); k += 2) {
        force = std::max(force, expected[k].norm()), torque = std::max(torque, expected[k + 1].norm());
        EXPECT_LT((expected[k] - alone.contactForceOn(k / 2)).norm(), 1e-12);
    }
    EXPECT_GT(force, 1e-4);
    EXPECT_GT(torque, 1e-8);
    VirtualRanks(3).run([&](Exchange& exchange) {
        Driven scene;
        scene.setRanks(exchange, {});
        scene.initialise();
        scene.step(steps);
        scene.gather();
        const std::vector<Vec3D> found = loadsOfHeld(scene);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t k = 0; k < found.size(); k += 2) {
            EXPECT_LT((found[k] - expected[k]).norm(), 1e-12 * force) << k / 2;
            EXPECT_LT((found[k + 1] - expected[k + 1]).norm(), 1e-12 * torque) << k / 2;
        }
    });
}

// A force that lacks a contact which is not listed says so, as interactions() does.
TEST(HeldContacts, areToldOfWhereAForceLacksThem) {
    const Lines lines;
    FewGrains<Linear> scene(linear(), heldPair(), dt);
    ready(scene).setQuiet(false);
    scene.run(3);
    EXPECT_TRUE(lines.told.empty());
    EXPECT_EQ(scene.particleHandler.getObject(0).getForce(), Vec3D::Zero());
    ASSERT_EQ(lines.told.size(), 1u);
    EXPECT_TRUE(support::contains(lines.told[0], "getForce() and getTorque() do not have it"));
}

TEST(HeldContacts, haveTheForceOfTheirOverlap) {
    FewGrains<Linear> scene(linear(), heldPair(), dt);
    scene.setHeldContacts(HeldContacts::All);
    ready(scene).run(3);
    ASSERT_EQ(scene.interactions().size(), 1u);
    const double force = stiffness * deep;
    EXPECT_NEAR(scene.interactions()[0].normalForce, force, roundOff * force);
    EXPECT_NEAR(scene.contactForceOn(0).x(), -force, roundOff * force);
    EXPECT_EQ(scene.contactForceOn(1), -scene.contactForceOn(0));
    EXPECT_EQ(scene.interactionsOf(1).size(), 1u);
    EXPECT_EQ(scene.motion(1).position.x(), 2 * r - deep);
}

// The dashpot is that of the masses that both would have if they were free: m1 m2 / (m1 + m2), m at a wall.
// Restitution of Hertz: 2 sqrt(5/6) beta sqrt(S m*) v with S = 2 E* sqrt(R* d) (Thornton et al., 2023,
// equation 4.4), checked against what two free grains of the same speed have in their first step.
TEST(HeldContacts, drivenOnesHaveTheDashpotOfTheirMasses) {
    for (const bool atWall : {false, true}) {
        const auto forceAtStart = [&](bool held) {
            std::vector<GrainMotion> grains = heldPair({-0.1, 0, 0});
            if (atWall) grains.erase(grains.begin());
            const double left = r;
            FewGrains<Hertz> scene(
                hertz(), {}, dt,
                atWall ? std::vector<PlaneAt>{{{-1, 0, 0}, {left, 0, 0}}} : std::vector<PlaneAt>{});
            for (const GrainMotion& motion : grains) {
                SphericalParticle grain;
                grain.setSpecies(scene.speciesHandler.getObject(0));
                grain.setRadius(motion.radius), grain.setPosition(motion.position);
                grain.setVelocity(motion.velocity);
                if (held) grain.fixParticle();
                scene.particleHandler.copyAndAddObject(grain);
            }
            for (GrainReference grain : scene.particleHandler)
                if (grain.getPosition().x() > 0) grain.setVelocity({-0.1, 0, 0});
            scene.setHeldContacts(HeldContacts::All);
            ready(scene).initialise();
            EXPECT_EQ(scene.interactions().size(), 1u);
            return scene.interactions().at(0).normalForce;
        };
        const double free = forceAtStart(false);
        EXPECT_GT(free, 4.0 / 3 * 2e6 * std::sqrt(0.5 * r) * std::pow(deep, 1.5));
        EXPECT_NEAR(forceAtStart(true) / free, 1, 1e-12) << atWall;
    }
}

// Two grains that are moved past each other: the tangential spring grows by the way until it slides, and the
// work of who moves them is in the account.
TEST(HeldContacts, drivenOnesHaveFrictionAndWorkIsTheirDrivers) {
    FewGrains<Rough> scene(rough(), heldPair(), dt);
    scene.setHeldContacts(HeldContacts::All);
    ready(scene).initialise();
    const double speed = 0.01;  // m/s
    scene.particleHandler.getObject(1).setVelocity({0, speed, 0});
    const double start = scene.energyLedger().closed();
    for (int k = 1; k <= 50; ++k) scene.step();
    // The spring is kept half a step ahead, by the velocity at the start, which was 0. The pair has turned,
    // and its normal force with it.
    const double way = speed * dt * 49.5, turned = stiffness * deep * speed * dt * 50 / (2 * r);
    EXPECT_NEAR(scene.contactForceOn(1).y(), -200 * way - 0.01 * speed + turned, 2e-3 * 200 * way);
    for (int k = 0; k < 3000; ++k) scene.step();
    const ObservedContact seen = scene.interactions().at(0);
    const Vector<double> normal = seen.normal();
    const double tangential = norm(seen.force - dot(seen.force, normal) * normal);
    EXPECT_NEAR(tangential, 0.5 * seen.normalForce, 1e-9 * seen.normalForce);
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(ledger.sliding, 0);
    EXPECT_GT(ledger.walls, ledger.sliding);
    EXPECT_NEAR(ledger.closed(), start, 1e-12 * ledger.walls);
    EXPECT_LT(std::abs(ledger.stepError), 1e-4 * ledger.walls);
}

// A held grain that is pressed into a plane, and dragged along it.
TEST(HeldContacts, atAWallWhoseForcesAreKept) {
    FewGrains<Rough> scene(rough(), {{.radius = r, .velocity = {0.02, 0, 0}, .fixed = true}}, dt,
                           {{{0, 0, -1}, {0, 0, -r + deep}}});
    scene.particleHandler.getObject(0).setVelocity({0.02, 0, 0});
    scene.wallHandler.getObject(0).keepForces();
    ready(scene).run(2000);
    const double force = stiffness * deep;
    EXPECT_NEAR(scene.wallHandler.getObject(0).getForce().z(), -force, roundOff * force);
    EXPECT_NEAR(scene.wallHandler.getObject(0).getForce().x(), 0.5 * force, 1e-9 * force);
    EXPECT_EQ(toEigen(scene.interactions().at(0).force), -scene.wallHandler.getObject(0).getForce());
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_NEAR(ledger.walls, ledger.sliding + ledger.tangentialElastic + ledger.tangentialDashpots,
                1e-3 * ledger.walls);
    EXPECT_NEAR(ledger.closed(), ledger.elastic, 1e-12 * ledger.walls + 1e-12 * ledger.elastic);
}

// A plate of 1 g comes to rest on three held grains: k d = M g / 3.
TEST(HeldContacts, carryAWallThatForcesMove) {
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 3; ++k) {
        const double angle = 2 * std::numbers::pi * k / 3;
        grains.push_back(
            {.radius = r, .position = {4 * r * std::cos(angle), 4 * r * std::sin(angle), 0}, .fixed = true});
    }
    FewGrains<Linear> scene(linear(), grains, 2e-5);
    InfiniteWall plate({0, 0, 1}, {0, 0, r}, scene.speciesHandler.getObject(0));
    constexpr double plateMass = 1e-4;  // kg
    plate.setPiston(plateMass, 0);
    auto* const added = scene.wallHandler.copyAndAddObject(plate);
    scene.setGravity({0, 0, -9.81});
    ready(scene).run(20000);  // 0.4 s; 2 m / c is 3 ms
    const double weight = plateMass * 9.81;
    EXPECT_NEAR(added->getForce().z(), weight, 1e-6 * weight);
    EXPECT_NEAR(r - added->pointOnPlane().z, weight / (3 * stiffness), 1e-6 * weight / (3 * stiffness));
}

// A free body, a plate of triangles, rolls off held grains only by their forces: its momentum is their
// impulse, and it does not fall through.
TEST(HeldContacts, carryAFreeBody) {
    FewGrains<Rough> scene(rough(),
                           {{.radius = r, .fixed = true},
                            {.radius = r, .position = {6 * r, 0, 0}, .fixed = true},
                            {.radius = r, .position = {3 * r, 5 * r, 0}, .fixed = true}},
                           1e-5);
    TriangleWall plate;
    plate.set(std::vector<Triangle>{
        {{{-20 * r, -20 * r, 1.01 * r}, {20 * r, -20 * r, 1.01 * r}, {0, 30 * r, 1.01 * r}}}});
    plate.setSpecies(scene.speciesHandler.getObject(0));
    FreeBodySettings settings;
    settings.mass = 1e-4;
    settings.centre = {3 * r, 1.6 * r, 1.01 * r};
    settings.inertia = 1e-8 * Eigen::Matrix3d::Identity();
    plate.setFreeBody(settings);
    auto* const added = scene.wallHandler.copyAndAddObject(plate);
    scene.setGravity({0, 0, -9.81});
    ready(scene).run(20000);
    EXPECT_NEAR(added->getForce().z(), 1e-4 * 9.81, 1e-3 * 1e-4 * 9.81);
    EXPECT_LT(norm(std::as_const(*added).body()->free.velocity), 1e-4);
}

TEST(HeldContacts, conductHeat) {
    // W of two grains 10 K apart; of the second grain, that is held too, at a wall of 10 K more
    const auto power = [](bool isHeld, bool atWall) {
        Linear still;
        still.setDensity(density), still.setStiffness(1e-30);  // nothing moves
        FewGrains<Linear> scene(still,
                                {{.radius = r, .fixed = isHeld},
                                 {.radius = r, .position = {2 * r - deep, 0, 0}, .fixed = isHeld}},
                                1e-3, {{{0, 0, -1}, {0, 0, -r + deep}}});
        const GrainColumnReference temperature = scene.particleHandler.addColumn("temperature", "K", 300);
        auto& heat = scene.addPart<HeatPart>(temperature);
        heat.setMaterial(scene.speciesHandler.getObject(0), {.conductivity = 1, .heatCapacity = 800});
        if (atWall) heat.holdWall(0, 310);
        else temperature[1] = 310;
        scene.setQuiet();
        scene.setTimeMax(1);
        scene.run(1);
        return (temperature[0] - 300) * mass * 800 / 1e-3;
    };
    EXPECT_NEAR(power(false, false), 2 * std::sqrt(0.5 * r * deep) * 10, 1e-9 * power(false, false));
    for (const bool atWall : {false, true}) {
        EXPECT_GT(power(false, atWall), 0);
        EXPECT_EQ(power(true, atWall), power(false, atWall)) << atWall;
    }
}

// A held grain that is dragged along a wall wears it by Reye's law: V = k W.
TEST(HeldContacts, wearAWall) {
    FewGrains<Rough> scene(rough(), {{.radius = r, .fixed = true}}, dt);
    TriangleWall plate;
    plate.set(std::vector<Triangle>{
        {{{-9 * r, -9 * r, -r + deep}, {9 * r, -9 * r, -r + deep}, {0, 9 * r, -r + deep}}}});
    plate.setSpecies(scene.speciesHandler.getObject(0));
    plate.keepWear(WearLaw::reye(1e-9));
    auto* const added = scene.wallHandler.copyAndAddObject(plate);
    scene.particleHandler.getObject(0).setVelocity({0.02, 0, 0});
    ready(scene).run(3000);
    EXPECT_GT(scene.energyLedger().sliding, 0);
    EXPECT_NEAR(added->getWear().sum().volume, 1e-9 * scene.energyLedger().sliding,
                1e-9 * 1e-9 * scene.energyLedger().sliding);
    EXPECT_EQ(added->getWear().sum().impactWork, 0);
}

TEST(HeldContacts, ofClumps) {
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 4; ++k)
        grains.push_back({.radius = r, .position = {(k / 2) * (2 * r - deep), 2 * r * (k % 2), 0}});
    FewGrains<Linear> scene(linear(), grains, dt);
    for (const std::uint32_t first : {0u, 2u})
        scene.bodyHandler.join(std::vector<std::uint32_t>{first, first + 1}).fixBody();
    scene.setHeldContacts(HeldContacts::All);
    ready(scene).run(3);
    const double force = stiffness * deep;
    ASSERT_EQ(scene.interactions().size(), 2u);  // those beside each other; across it is no touch
    for (const ObservedContact& seen : scene.interactions())
        EXPECT_NEAR(seen.normalForce, force, roundOff * force);
}

TEST(HeldContacts, ofSuperquadrics) {
    scenes::FewSuperquadrics<Linear> scene(
        linear(),
        {{.shape = {r, r, r}, .position = {0, 0, 0}}, {.shape = {r, r, r}, .position = {2 * r - deep, 0, 0}}},
        dt);
    scene.addPlane({0, 0, -1}, {0, 0, -r + deep});
    for (const std::size_t k : {0, 1}) scene.body(k).fixBody();
    scene.body(1).setVelocity({-0.1, 0, 0});
    scene.setHeldContacts(HeldContacts::All);
    scene.setQuiet();
    scene.setTimeMax(1);
    scene.initialise();
    ASSERT_EQ(scene.interactions().size(), 3u);  // with each other, and both with the plane
    const double force = stiffness * deep;
    EXPECT_NEAR(scene.interactions()[0].normalForce, force + dashpot * 0.1, 1e-9 * force);
    EXPECT_NEAR(scene.interactions()[1].normalForce, force, 1e-9 * force);
}

// --- Not asked for

// A bed that is glued has no contacts within it, and pays for none; who asks is told once.
TEST(HeldContacts, areNotListedWhereNothingNeedsThem) {
    const Lines lines;
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 100; ++k)
        grains.push_back(
            {.radius = r, .position = {1.9 * r * (k % 10), 1.9 * r * (k / 10), 0}, .fixed = true});
    grains.push_back({.radius = r, .position = {10.45 * r, 10.45 * r, 1.47 * r}});
    FewGrains<Linear> scene(linear(), grains, dt, {{{0, 0, -1}, {0, 0, -0.99 * r}}});
    scene.setGravity({0, 0, -9.81});
    ready(scene).setQuiet(false);
    scene.run(3);
    std::size_t between = 0, listed = 0;
    scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        ++listed;
        between += scene.contacts().firstOf(contact) != scene.particleHandler.store().place[100] &&
                           (bucket.wall >= 0 ||
                            scene.contacts().secondOf(contact) != scene.particleHandler.store().place[100])
                       ? 1
                       : 0;
    });
    EXPECT_EQ(between, 0u);
    EXPECT_GT(listed, 0u);
    EXPECT_TRUE(lines.told.empty());
    EXPECT_GT(scene.interactions().size(), 0u);
    static_cast<void>(scene.contactForceOn(3));
    scene.step();
    static_cast<void>(scene.interactions());
    ASSERT_EQ(lines.told.size(), 1u);
    EXPECT_EQ(
        lines.told[0],
        "particle 0 and particle 1 overlap and are held along all axes: their contact is not listed, so "
        "that interactions(), interactionsOf(), contactForceOn(), getForce() and getTorque() do not have it; "
        "take "
        "setHeldContacts(HeldContacts::All) to list such contacts, or HeldContacts::None to leave them "
        "out without this warning.");
}

TEST(HeldContacts, areLeftOutWithoutAWordWhereTheyAreNotWanted) {
    const Lines lines;
    FewGrains<Linear> scene(linear(), heldPair(), dt, {{{0, 0, -1}, {0, 0, -r + deep}}});
    scene.setHeldContacts(HeldContacts::None);
    scene.wallHandler.keepForces();
    ready(scene).setQuiet(false);
    scene.run(3);
    EXPECT_EQ(scene.contactForceOn(0), Vec3D::Zero());
    EXPECT_EQ(scene.wallHandler.getObject(0).getForce(), Vec3D::Zero());
    EXPECT_TRUE(lines.told.empty());
}

// Two that begin to touch because they are driven, and a grain at a wall.
TEST(HeldContacts, areToldOfOnceTheyTouch) {
    for (const bool atWall : {false, true}) {
        const Lines lines;
        FewGrains<Linear> scene(
            linear(),
            {{.radius = r, .fixed = true}, {.radius = r, .position = {2.1 * r, 0, 0}, .fixed = true}}, 1e-4,
            {{{-1, 0, 0}, {atWall ? -1.1 * r : -9 * r, 0, 0}}});
        ready(scene).setQuiet(false);
        scene.initialise();
        EXPECT_EQ(scene.contactForceOn(0), Vec3D::Zero());
        EXPECT_TRUE(lines.told.empty());
        scene.particleHandler.getObject(atWall ? 0 : 1).setVelocity({-0.1, 0, 0});
        for (int k = 0; k < 20; ++k) scene.step();  // 0.2 mm
        static_cast<void>(scene.contactForceOn(0));
        ASSERT_EQ(lines.told.size(), 1u) << atWall;
        EXPECT_NE(lines.told[0].find(atWall ? "particle 0 and wall 0 overlap"
                                            : "particle 0 and particle 1 overlap"),
                  std::string::npos);
    }
}

// --- Changes in a run

// A hook moves held grains from step to step: their contact begins and ends where they are, and what it
// stores is the driver's.
TEST(HeldContacts, followGrainsThatAHookMoves) {
    FewGrains<Linear> scene(
        linear(), {{.radius = r, .fixed = true}, {.radius = r, .position = {2.05 * r, 0, 0}, .fixed = true}},
        dt);
    scene.setHeldContacts(HeldContacts::All);
    ready(scene).initialise();
    const double there = 2 * r - deep;
    for (const double x : {2.02 * r, there, 2 * r - 2 * deep, there, 2.5 * r}) {
        scene.particleHandler.getObject(1).setPosition({x, 0, 0});
        scene.step();
        const double overlap = std::max(2 * r - x, 0.0), force = stiffness * overlap;
        EXPECT_NEAR(scene.contactForceOn(1).x(), force, roundOff * stiffness * deep);
        EXPECT_NEAR(scene.energyLedger().elastic, 0.5 * force * overlap, roundOff * stiffness * deep * deep);
        EXPECT_NEAR(scene.energyLedger().driver, 0.5 * force * overlap, roundOff * stiffness * deep * deep);
        EXPECT_NEAR(scene.energyLedger().stepError, 0, roundOff * stiffness * deep * deep);
    }
}

TEST(HeldContacts, beginWhenTheyAreAskedFor) {
    FewGrains<Linear> scene(linear(), heldPair(), dt, {{{0, 0, -1}, {0, 0, -r + deep}}});
    ready(scene).run(2);
    const double force = stiffness * deep;
    EXPECT_EQ(scene.contacts().counts().acting, 0u);
    scene.wallHandler.getObject(0).keepForces();
    scene.step();
    EXPECT_NEAR(scene.wallHandler.getObject(0).getForce().z(), -2 * force, 2 * roundOff * force);
    EXPECT_EQ(scene.contacts().counts().acting, 2u);
    scene.setHeldContacts(HeldContacts::All);
    scene.step();
    EXPECT_EQ(scene.contacts().counts().acting, 3u);
    EXPECT_NEAR(scene.energyLedger().driver, 1.5 * force * deep, 3 * roundOff * force * deep);
    EXPECT_NEAR(scene.energyLedger().stepError, 0, roundOff * force * deep);
    scene.setHeldContacts(HeldContacts::None);
    scene.step();
    EXPECT_EQ(scene.contacts().counts().acting, 0u);
    EXPECT_NEAR(scene.energyLedger().driver, 0, 3 * roundOff * force * deep);
}

// Free grains on a floor of held ones feel nothing of it.
TEST(HeldContacts, beginAndEndWithoutATraceInFreeGrains) {
    const auto bitsOf = [](bool isAsked) {
        FewGrains<Rough> scene(rough(), Driven::grainsOf(), dt, {{{0, 0, -1}, {0, 0, -r + deep}}});
        scene.setGravity({0, 0, -9.81});
        ready(scene).run(3);
        for (int k = 0; k < 60; ++k) {
            if (isAsked && k % 3 == 0)
                scene.setHeldContacts(k % 2 == 0 ? HeldContacts::All : HeldContacts::WhereAsked);
            if (isAsked && k == 31) scene.wallHandler.getObject(0).keepForces();
            scene.step();
        }
        EXPECT_GT(scene.getKineticEnergy(), 0);
        return stateHash(scene.particleHandler.store());
    };
    EXPECT_EQ(bitsOf(true), bitsOf(false));
}

// A grain that becomes held keeps its contact and what that remembers; one that is let go, too.
TEST(HeldContacts, goOnWhenAGrainIsHeldAndLetGo) {
    FewGrains<Rough> scene(rough(),
                           {{.radius = r, .fixed = true},
                            {.radius = r, .position = {2 * r - deep, 0, 0}, .velocity = {0, 0.02, 0}}},
                           dt);
    scene.setHeldContacts(HeldContacts::All);
    ready(scene).run(10);
    const auto friction = [&] { return std::abs(scene.contactForceOn(0).y()); };
    ASSERT_GT(friction(), 0);
    scene.particleHandler.getObject(1).fixParticle();
    scene.step();
    const double held = friction();  // the spring alone: nothing moves
    EXPECT_GT(held, 0);
    for (int k = 0; k < 5; ++k) scene.step();
    EXPECT_NEAR(friction(), held, 1e-12 * held);
    scene.particleHandler.getObject(1).fixParticle(false);
    scene.step();
    EXPECT_GT(scene.motion(1).velocity.x(), 0);  // it is pushed off
    EXPECT_NEAR(friction(), held, 0.2 * held);
}

// --- Threads, ranks, restarts

TEST(HeldContacts, areTheSameForAnyNumberOfThreads) {
    const auto bitsOf = [](int threads) {
        Driven scene(threads);
        scene.run(300);
        std::vector<double> all;
        for (const ObservedContact& seen : scene.interactions())
            all.insert(all.end(), {seen.force.x, seen.force.y, seen.force.z, seen.normalForce});
        for (const EnergyLedger::Entry& entry : EnergyLedger::entries())
            all.push_back(scene.energyLedger().*entry.member);
        return all;
    };
    const std::vector<double> one = bitsOf(1);
    EXPECT_GT(one.size(), 4 * 300u);
    for (const int threads : {2, 7}) EXPECT_EQ(bitsOf(threads), one);
}

TEST(HeldContacts, areTheSameOnRanks) {
    ranks::expectSameOnRanks(300, [](auto&& use) {
        Driven scene;
        use(scene);
    });
}

/// The floor of grains on a plane, whose contacts of held grains a hook asks for.
class Asking : public Driven {
public:
    explicit Asking(std::function<void(Asking&)> function) : hook(std::move(function)) {
        setHeldContacts(HeldContacts::WhereAsked);
        wallHandler.copyAndAddObject(
            InfiniteWall({0, 0, -1}, {0, 0, -r + deep}, speciesHandler.getObject(0)));
    }
    static constexpr std::size_t inStep = 20;

private:
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() == inStep) hook(*this);
    }
    std::function<void(Asking&)> hook;
};

// On several ranks each has its own grains only, of which perhaps none is held: all refuse, or all list anew.
TEST(HeldContacts, areAskedForOnRanksAfterGatherOnly) {
    const std::vector<std::function<void(Asking&)>> asks{
        [](Asking& scene) { scene.setHeldContacts(HeldContacts::All); },
        [](Asking& scene) { scene.wallHandler.getObject(1).keepForces(); }};
    for (const auto& ask : asks) {
        std::array<std::string, 3> told;
        VirtualRanks(told.size()).run([&](Exchange& exchange) {
            Asking scene(ask);
            scene.setRanks(exchange, {});
            scene.initialise();
            try {
                scene.step(Asking::inStep + 1);
            } catch (const RunError& refused) {
                told[exchange.rank()] = refused.what();
            }
        });
        for (const std::string& one : told) {
            EXPECT_TRUE(support::isOneSentence(one));
            for (const std::string_view part : {"setHeldContacts()", "keepForces()", "gather()"})
                EXPECT_TRUE(support::contains(one, part));
        }
        std::size_t before = 0, after = 0;
        const auto gathersFirst = [&](auto&& use) {
            Asking scene([&](Asking& of) {
                of.gather();
                before = of.contacts().counts().acting;
                ask(of);
            });
            use(scene);
            after = scene.contacts().counts().acting;
        };
        gathersFirst([](Scene& scene) {
            scene.initialise();
            scene.step(Asking::inStep + 1);
        });
        EXPECT_GE(after, before + 64u);  // the lower layer at the plane, and more
        const auto make = [&](auto&& use) {
            Asking scene([&](Asking& of) {
                of.gather();
                ask(of);
            });
            use(scene);
        };
        ranks::expectSameOnRanks(300, make, {2, 3});
    }
}

// All ranks know of a grain that is held on one of them, so that all reach the same calls: as they gather,
// and where a hook asks for its contacts.
TEST(HeldContacts, ofAGrainThatOneRankHas) {
    class Column : public HookedGrains<Linear> {
    public:
        explicit Column(std::function<void(Column&)> ask)
            : HookedGrains<Linear>(linear(), column(), dt), asks(std::move(ask)) {
            this->hook = [this](HookedGrains<Linear>&) {
                if (getNumberOfTimeSteps() != 20) return;
                gather();
                asks(*this);
            };
            setGravity({0, 0, -9.81});
        }

    private:
        static std::vector<GrainMotion> column() {
            std::vector<GrainMotion> grains;
            for (int n = 0; n < 40; ++n)
                grains.push_back({.radius = r, .position = {0, 0, n * (2 * r - deep)}, .fixed = n == 0});
            return grains;
        }
        std::function<void(Column&)> asks;
    };
    const std::vector<std::function<void(Column&)>> each{
        [](Column&) {}, [](Column& scene) { scene.setHeldContacts(HeldContacts::All); }};
    for (const auto& asks : each)
        ranks::expectSameOnRanks(100,
                                 [&](auto&& use) {
                                     Column scene(asks);
                                     use(scene);
                                 },
                                 {2, 3});
}

// Grains of different ranks are looked for when all are together, and the first rank tells of them.
TEST(HeldContacts, areToldOfOnRanksWhenGrainsAreTogether) {
    const Lines lines;
    VirtualRanks(3).run([&](Exchange& exchange) {
        Asking scene([](Asking& of) {
            if (of.particleHandler.contains(0)) static_cast<void>(of.contactForceOn(0));
        });
        scene.setQuiet(false);
        scene.setRanks(exchange, {});
        scene.initialise();
        scene.step(Asking::inStep + 5);
        if (exchange.rank() == 0) {
            EXPECT_TRUE(lines.told.empty());
        }
        scene.gather();
    });
    ASSERT_EQ(lines.told.size(), 1u);
    EXPECT_TRUE(support::contains(lines.told[0], "particle 0 and particle 1 overlap and are held"));
}

TEST(HeldContacts, goOnFromARestartFile) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "without HDF5 there are no restart files";
    const support::TestFolder folder;
    const auto half = folder.path() / "half.h5", whole = folder.path() / "whole.h5",
               again = folder.path() / "again.h5";
    const auto advance = [](Driven& scene, int steps) {
        for (int k = 0; k < steps; ++k) scene.step();
    };
    {
        Driven scene;
        scene.run(120);
        scene.writeRestart(half);
        advance(scene, 120);
        scene.writeRestart(whole);
    }
    Driven scene;
    scene.restartFrom(half);
    scene.initialise();
    advance(scene, 120);
    scene.writeRestart(again);
    support::expectSameState(whole, again);

    Driven other;
    other.setHeldContacts(HeldContacts::WhereAsked);
    other.restartFrom(half);
    EXPECT_THROW(other.initialise(), InputError);
}

}  // namespace
}  // namespace pendular::heldContactsTest
