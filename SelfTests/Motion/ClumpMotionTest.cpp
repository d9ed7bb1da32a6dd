#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/LedgerError.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Clumps in scenes: the energy ledger, shear, strain, steps that end where nobody looks, and long runs.

namespace pendular::clumpMotionTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using scenes::SettlingBox;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;
using Hertzian = Species<HertzianViscoelastic, Mindlin>;

constexpr double density = 2500;  // kg/m^3

template <class S = Smooth>
S elastic(double stiffness) {
    S s;
    s.setDensity(density);
    s.setStiffness(stiffness);
    s.setDissipation(0);
    return s;
}
Rough rough() {
    Rough s = elastic<Rough>(1000);
    s.setDissipation(0.002);
    s.setSlidingStiffness(300);
    s.setSlidingDissipation(0.001);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}

/// Two fused spheres, three in a bend, and a rod, of one size of sphere.
std::vector<ClumpTemplate> shapes(double r) {
    return {ClumpTemplate({{{0, 0, -0.5 * r}, r}, {{0, 0, 0.5 * r}, r}}),
            ClumpTemplate({{{0, 0, 0}, r}, {{r, 0, 0}, r}, {{0, r, 0}, r}}),
            ClumpTemplate({{{0, 0, -r}, 0.7 * r}, {{0, 0, 0}, r}, {{0, 0, r}, 0.7 * r}})};
}

/// Clumps of all shapes and single grains on a lattice in a cube, with random velocities.
template <class S>
struct CubeOfClumps : FewGrains<S> {
    static constexpr double r = 1e-3, spacing = 4.2e-3;  // m
    double edge;

    CubeOfClumps(const S& species, int perSide, double step, bool hasWalls)
        : FewGrains<S>(species, {}, step), edge(perSide * spacing) {
        const auto* own = this->speciesHandler.getObject(0);
        const CountedRandom random(5);
        const std::vector<ClumpTemplate> all = shapes(r);
        std::uint32_t k = 0;
        for (int a = 0; a < perSide; ++a)
            for (int b = 0; b < perSide; ++b)
                for (int c = 0; c < perSide; ++c, ++k) {
                    const auto even = [&](std::uint32_t n) { return random.uniform(-1, 1, k, n); };
                    const Vec3D place = spacing * Vec3D(a + 0.5, b + 0.5, c + 0.5);
                    const Vec3D velocity = 0.3 * Vec3D(even(0), even(1), even(2));
                    if (k % 4 == 3) {
                        SphericalParticle grain;
                        grain.setSpecies(own), grain.setRadius(r);
                        grain.setPosition(place), grain.setVelocity(velocity);
                        this->particleHandler.copyAndAddObject(grain);
                        continue;
                    }
                    Clump clump(all[k % 4]);
                    clump.setSpecies(own);
                    clump.setPosition(place);
                    clump.setOrientation({even(3), even(4), even(5), even(6)});
                    clump.setVelocity(velocity);
                    clump.setAngularVelocity(100 * Vec3D(even(7), even(8), even(9)));
                    this->bodyHandler.copyAndAddObject(clump);
                }
        if (!hasWalls) return;
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                InfiniteWall wall;
                wall.setSpecies(own);
                wall.set(sign * Vec3D::Unit(axis), (sign > 0 ? edge : 0) * Vec3D::Unit(axis));
                this->wallHandler.copyAndAddObject(wall);
            }
    }
};

/// Over N steps, each of which rounds each entry by up to 2^-53 with signs at random: five times sqrt(N)
/// 2^-53 of all that was turned over, as for beds of spheres (SelfTests/Energy/BedTest.cpp).
void expectCloses(Scene& scene, int steps) {
    const double start = scene.energyLedger().closed();
    double largest = 0;
    for (int n = 1; n <= steps; ++n) {
        scene.step();
        if (n % 500 == 0)
            largest =
                std::max(largest, std::abs(scene.energyLedger().closed() - start) /
                                      (std::sqrt(n) * 0x1p-53 * support::turnedOver(scene.energyLedger())));
    }
    EXPECT_LT(largest, 5);
}

// Bodies that collide with each other, with grains and with walls, in gravity.
TEST(ClumpMotion, closesTheEnergyLedgerToRoundOff) {
    CubeOfClumps<Rough> scene(rough(), 4, 5e-6, true);
    scene.setGravity({0, 0, -9.81});
    scene.keepEnergyLedger();
    scene.initialise();
    expectCloses(scene, 4000);
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(ledger.normalDashpots, 0.01 * ledger.kinetic);  // collisions there were
    EXPECT_GT(ledger.sliding, 0.001 * ledger.kinetic);
    EXPECT_LT(std::abs(ledger.stepError), 0.01 * ledger.lost());
    EXPECT_NEAR(ledger.kinetic / (scene.getKineticEnergy() + scene.getRotationalEnergy()), 1, 1e-14);
}

// What elastic smooth bodies do but is not found again is the error of the steps: of second order.
TEST(ClumpMotion, stepErrorOfElasticClumpsIsOfSecondOrder) {
    const auto error = [](double step) {
        CubeOfClumps<Smooth> scene(elastic(1000), 3, step, true);
        scene.keepEnergyLedger();
        scene.initialise();
        const double energy = scene.energyLedger().total();
        double largest = 0;
        while (scene.getTime() < 0.01) {
            scene.step();
            largest = std::max(largest, std::abs(scene.energyUnaccountedFor()));
        }
        return largest / energy;
    };
    const double coarse = error(4e-6), fine = error(2e-6);
    EXPECT_LT(coarse, 1e-3);
    EXPECT_GT(coarse / fine, 2.5);  // 4, but for the times at which touches begin within a step
}

// Bits: one thread, three threads, steps one by one (each is finished where it ends) or many at once, with
// and without the ledger, and through a restart.
TEST(ClumpMotion, givesTheSameBitsHoweverItIsRun) {
    const auto made = [](int threads, bool ledger) {
        auto scene = std::make_unique<CubeOfClumps<Rough>>(rough(), 4, 5e-6, true);
        scene->setGravity({0, 0, -9.81});
        scene->setNumberOfThreads(threads);
        scene->keepEnergyLedger(ledger);
        return scene;
    };
    const auto hashOf = [](Scene& scene) { return stateHash(scene.particleHandler.store()); };
    const auto one = made(1, false), three = made(3, false), counted = made(1, true);
    for (Scene* scene : {static_cast<Scene*>(one.get()), static_cast<Scene*>(three.get()),
                         static_cast<Scene*>(counted.get())})
        scene->initialise();
    one->step(3000);
    for (int k = 0; k < 3000; ++k) three->step(), counted->step();
    EXPECT_GT(one->interactions().size(), 0u);
    EXPECT_EQ(hashOf(*one), hashOf(*three));
    EXPECT_EQ(hashOf(*one), hashOf(*counted));
    for (std::size_t k = 0; k < one->bodyHandler.getSize(); ++k) {
        EXPECT_EQ(one->bodyHandler.getObject(k).getAngularMomentum(),
                  three->bodyHandler.getObject(k).getAngularMomentum());
        EXPECT_EQ(one->bodyHandler.getObject(k).getOrientation().coeffs(),
                  counted->bodyHandler.getObject(k).getOrientation().coeffs());
    }
    const support::TestFolder folder;
    const auto half = made(2, true), resumed = made(1, true);
    half->initialise();
    half->step(1000);
    half->writeRestart(folder.path() / "half.h5");
    half->step(1000);
    half->writeRestart(folder.path() / "whole.h5");
    resumed->restartFrom(folder.path() / "half.h5");
    resumed->initialise();
    resumed->step(1000);
    resumed->writeRestart(folder.path() / "resumed.h5");
    support::expectSameState(folder.path() / "whole.h5", folder.path() / "resumed.h5");
}

/// What a hook after each step sees of a body through a reference that it has kept.
struct WatchedClumps : CubeOfClumps<Rough> {
    BodyReference kept;
    std::vector<Vec3D> seen;
    std::size_t touches = 0;

    explicit WatchedClumps(bool ledger)
        : CubeOfClumps<Rough>(rough(), 2, 5e-6, true), kept(bodyHandler.getObject(0)) {
        setGravity({0, 0, -9.81});
        keepEnergyLedger(ledger);
        initialise();
    }
    void actionsAfterTimeStep() override {
        seen.insert(seen.end(), {kept.getVelocity(), kept.getAngularMomentum(), kept.getForce()});
        EXPECT_EQ(seen.back(), bodyHandler.getObject(0).getForce());
        if (seen.size() == 300) kept.setVelocity({0, 0, -0.5});
        touches += interactionsOf(0).size();
    }
};

// A reference that is kept finishes a step that ends where nobody looks, as a new one does.
TEST(ClumpMotion, aKeptReferenceSeesFinishedSteps) {
    WatchedClumps one(false), many(false), counted(true);
    for (int k = 0; k < 2000; ++k) one.step();
    many.step(2000), counted.step(2000);
    EXPECT_EQ(one.seen.size(), 6000u);
    EXPECT_GT(one.touches, 10u);
    EXPECT_EQ(one.seen, many.seen);
    EXPECT_EQ(one.seen, counted.seen);
}

// A hollow sphere, 2/3 m r^2, that slides with the speed v keeps m v r about a line of the floor, and rolls
// with v / (1 + 2/3). (A solid one with 5/7 v.) The arm to the contact is shorter than r by up to the
// overlap, 1e-4 of it; the swing against the spring of friction has died away by exp(-15).
TEST(ClumpMotion, aHollowSphereRollsAsAHollowSphere) {
    constexpr double r = 1e-3, mass = 1e-5;
    Rough material = rough();
    material.setSlidingDissipation(0.005);
    const ClumpTemplate hollow(
        {{{0, 0, 0}, r}}, BodyMass{mass, {0, 0, 0}, 2.0 / 3 * mass * r * r * Eigen::Matrix3d::Identity()});
    for (const Eigen::Quaterniond& turn :
         {Eigen::Quaterniond(1, 0, 0, 0), Eigen::Quaterniond(0.3, 0.5, -0.2, 0.7)}) {
        FewGrains<Rough> scene(material, {}, 5e-6, {{{0, 0, -1}, {0, 0, 0}}});
        scene.setGravity({0, 0, -9.81});
        Clump clump(hollow);
        clump.setSpecies(scene.speciesHandler.getObject(0));
        clump.setPosition({0, 0, r - mass * 9.81 / material.getStiffness()});
        clump.setOrientation(turn);
        clump.setVelocity({0.1, 0, 0});
        const BodyReference body = scene.bodyHandler.copyAndAddObject(clump);
        scene.initialise();
        scene.step(10000);
        EXPECT_NEAR(body.getVelocity().x(), 0.06, 0.06 * 2e-4);
        EXPECT_NEAR(body.getAngularVelocity().y(), 60, 60 * 2e-4);
    }
}

// A clump of one sphere is that grain: the same bits of place, velocity and spin, with friction, walls,
// collisions, across the faces of a periodic scene, and when they are set in the run.
void expectOneSphereIsTheSphere(bool isPeriodic) {
    const auto made = [&](bool asClumps) {
        auto scene = std::make_unique<FewGrains<Rough>>(
            rough(), std::vector<GrainMotion>{}, 5e-6, std::vector<scenes::PlaneAt>{{{0, 0, -1}, {0, 0, 0}}});
        scene->setGravity({0, 0, -9.81});
        if (isPeriodic) scene->setPeriodic(0, 0, 5e-3);
        for (int k = 0; k < 12; ++k) {
            const Vec3D place(2.1e-3 * (k % 2), 2.1e-3 * (k / 2 % 2), 1.1e-3 + 2.2e-3 * (k / 4));
            const Vec3D velocity(0.1 * (k % 3), -0.05 * (k % 5), -0.2), spin(10 * k, -50, 5 * k);
            const double radius = 1e-3 * (1 - 0.02 * (k % 4));
            if (!asClumps) {
                SphericalParticle grain;
                grain.setSpecies(scene->speciesHandler.getObject(0));
                grain.setRadius(radius);
                grain.setPosition(place), grain.setVelocity(velocity), grain.setAngularVelocity(spin);
                scene->particleHandler.copyAndAddObject(grain);
                continue;
            }
            Clump clump(ClumpTemplate({{{0, 0, 0}, radius}}));
            clump.setSpecies(scene->speciesHandler.getObject(0));
            clump.setPosition(place), clump.setVelocity(velocity), clump.setAngularVelocity(spin);
            scene->bodyHandler.copyAndAddObject(clump);
        }
        scene->initialise();
        return scene;
    };
    const auto grains = made(false), clumps = made(true);
    std::size_t most = 0;
    for (int k = 0; k < 100; ++k) {
        grains->step(100), clumps->step(100);
        most = std::max(most, grains->interactions().size());
        if (k != 50) continue;
        const Vec3D velocity(0.3, 0.1, -0.07), spin(7.1, 0.3, -5.7);
        grains->particleHandler.getObject(3).setVelocity(velocity);
        grains->particleHandler.getObject(5).setAngularVelocity(spin);
        clumps->bodyHandler.getObject(3).setVelocity(velocity);
        clumps->bodyHandler.getObject(5).setAngularVelocity(spin);
    }
    EXPECT_GT(most, 3u);
    EXPECT_EQ(clumps->bodyHandler.getSize(), 12u);
    for (std::size_t k = 0; k < 12; ++k) {
        const GrainMotion a = grains->motion(k), b = clumps->motion(k);
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.velocity, b.velocity);
        EXPECT_EQ(a.spin, b.spin);
        const BodyReference body = clumps->bodyHandler.getObject(k);
        EXPECT_EQ(body.getPosition(), b.position);
        EXPECT_NEAR((body.getAngularVelocity() - b.spin).norm(), 0, 1e-12 * b.spin.norm());
    }
}

TEST(ClumpMotion, aClumpOfOneSphereIsTheSphereToTheBit) { expectOneSphereIsTheSphere(false); }
TEST(ClumpMotion, aClumpOfOneSphereIsTheSphereAcrossFacesToo) { expectOneSphereIsTheSphere(true); }

/// Two dimers that collide in shear, about a place: the frame of the flow there.
struct ShearedPair : FewGrains<Rough> {
    static constexpr double rate = 20, edge = 0.03;  // 1/s, m

    /// @param moved m, by which the upper one starts elsewhere
    explicit ShearedPair(double height, const Vec3D& moved = Vec3D::Zero())
        : FewGrains<Rough>(rough(), {}, 2e-6) {
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, edge);
        setLeesEdwards(0, 1, rate);
        const std::vector<ClumpTemplate> all = shapes(1e-3);
        for (const double side : {-1.0, 1.0}) {
            Clump clump(all[side < 0 ? 0 : 1]);
            clump.setSpecies(speciesHandler.getObject(0));
            const Vec3D place(0.015 + side * 4e-4, height + side * 2.2e-3, 0.015 + side * 3e-4);
            clump.setPosition(side > 0 ? Vec3D(place + moved) : place);
            clump.setVelocity(shearFlowAt(place) - side * Vec3D(0, 0.3, 0));
            clump.setAngularVelocity({30 * side, 10, -20});
            bodyHandler.copyAndAddObject(clump);
        }
    }
};

/// Velocity against the flow at its place, and spin.
struct MotionInFlow {
    Vec3D velocity, spin;
};
MotionInFlow motionInFlow(ShearedPair& pair, std::size_t k) {
    const BodyReference body = pair.bodyHandler.getObject(k);
    return {body.getVelocity() - pair.shearFlowAt(body.getPosition()), body.getAngularVelocity()};
}

/// How much velocities (m/s) and spins (rad/s) after so many steps differ for each m by which the start does.
struct Sensitivity {
    double velocity = 0, spin = 0;
};
Sensitivity sensitivityOfPair(double height, int steps) {
    constexpr double shift = 1e-12;  // m: far above round-off, and far below the overlaps of 1e-5 m
    ShearedPair start(height);
    start.initialise(), start.step(steps);
    Sensitivity most;
    for (int axis = 0; axis < 3; ++axis) {
        ShearedPair moved(height, shift * Vec3D::Unit(axis));
        moved.initialise(), moved.step(steps);
        for (std::size_t k = 0; k < 2; ++k) {
            const MotionInFlow a = motionInFlow(start, k), b = motionInFlow(moved, k);
            most.velocity = std::max(most.velocity, (a.velocity - b.velocity).norm() / shift);
            most.spin = std::max(most.spin, (a.spin - b.spin).norm() / shift);
        }
    }
    return most;
}

// Shear is the same at any height, but for the velocity of the frame. So a collision across the sliding faces
// is that in the middle; and the ledger closes, with what the images give.
TEST(ClumpMotion, collidesAcrossSlidingImagesAsInTheMiddle) {
    ShearedPair middle(0.015), across(0.0295);
    across.keepEnergyLedger();
    middle.initialise(), across.initialise();
    const double start = across.energyLedger().closed();
    bool touched = false;
    constexpr int steps = 6000;
    for (int k = 0; k < steps; ++k) {
        middle.step(), across.step();
        touched |= !across.interactions().empty();
    }
    EXPECT_TRUE(touched);
    EXPECT_TRUE(across.interactions().empty());
    const Sensitivity sensitivity = sensitivityOfPair(0.015, steps);
    for (std::size_t k = 0; k < 2; ++k) {
        const MotionInFlow inMiddle = motionInFlow(middle, k), beyond = motionInFlow(across, k);
        // Each step rounds places of the size of the box, and velocities of its size times the rate, in both
        // scenes; what the places make of a contact the sensitivity tells.
        const double rounded = 2 * steps * 0x1p-53 * ShearedPair::edge;  // m
        EXPECT_LT((inMiddle.velocity - beyond.velocity).norm(),
                  (sensitivity.velocity + ShearedPair::rate) * rounded);
        EXPECT_LT((inMiddle.spin - beyond.spin).norm(), sensitivity.spin * rounded);
        EXPECT_GT(std::abs(inMiddle.velocity.y() + (k == 0 ? -0.3 : 0.3)), 0.1);  // it has bounced
        const double height = across.bodyHandler.getObject(k).getPosition().y();
        EXPECT_GT(height, -1e-3);  // and is in the box
        EXPECT_LT(height, ShearedPair::edge + 1e-3);
    }
    EXPECT_NE(across.energyLedger().images, 0);
    EXPECT_LT(std::abs(across.energyLedger().closed() - start),
              support::roundOff(across.energyLedger(), steps));
}

// In strain a body goes with the flow at its centre: alone, it stays at its place of the box, and keeps its
// shape and spin.
TEST(ClumpMotion, goesWithAStrainAsAWhole) {
    FewGrains<Smooth> scene(elastic(1000), {}, 1e-5);
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, 0.02);
    scene.setStrainRate(2, -1);
    Clump clump(shapes(1e-3)[1]);
    clump.setSpecies(scene.speciesHandler.getObject(0));
    clump.setPosition({0.01, 0.01, 0.016});
    clump.setAngularVelocity({0, 0, 50});
    BodyReference body = scene.bodyHandler.copyAndAddObject(clump);
    scene.initialise();
    const Vec3D momentum = body.getAngularMomentum();
    scene.step(10000);
    const double height = scene.getPeriodicBox().length.z;
    EXPECT_NEAR(height, 0.02 * std::exp(-0.1), 1e-9);
    EXPECT_NEAR((body.getPosition().z() - 0.01) / (0.5 * height), 0.6, 1e-4);  // first order in the step
    EXPECT_EQ(body.getAngularMomentum(), momentum);
    EXPECT_NEAR((scene.motion(1).position - scene.motion(0).position).norm(), 1e-3, 1e-15);
}

// A strain that makes the period shorter than twice a body's width ends the run before the body can meet
// itself; a body that has been removed does not.
TEST(ClumpMotion, endsAStrainThatIsTooShortForABody) {
    const auto endOf = [](bool removed) {
        FewGrains<Smooth> scene(elastic(1000), {{.radius = 1e-3, .position = {0.004, 0.004, 0.004}}}, 1e-5);
        for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, 0.01);
        scene.setStrainRate(2, -20);
        Clump clump(shapes(1e-3)[2]);  // 2 * 1.7 mm wide
        clump.setSpecies(scene.speciesHandler.getObject(0));
        clump.setPosition({0.008, 0.008, 0.008});
        scene.bodyHandler.copyAndAddObject(clump);
        scene.initialise();
        if (removed) scene.bodyHandler.removeObject(0);
        try {
            scene.step(3000);  // to 10 mm * exp(-0.6) = 5.5 mm
        } catch (const RunError& error) {
            EXPECT_NEAR(scene.getPeriodicBox().length.z, 4 * 1.7e-3, 1e-5);
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_TRUE(support::contains(endOf(false), "s rigid body 0 reaches 0.0017 m from its centre"));
    EXPECT_EQ(endOf(true), "");
}

// A rod of n equal grains on a plane: its ends swing with k sum(a^2) / I against c sum(a^2) / I, and it goes
// up and down with n k / M. The limit must not be above what velocity Verlet stands for these, h^2 w^2/4 + h
// g/2 = 1, however strong the dashpots are. A plane touches all of the rod at once, and there is nothing else
// to touch: the limit is 0.9 of the exact one, but for the digits of the sums (ContactsAround.h).
TEST(ClumpMotion, stabilityLimitIsBelowThatOfARodWithAnyDashpot) {
    constexpr double r = 1e-3, stiffness = 1000;
    for (const double dissipation : {0.0, 0.05, 0.5, 5.0}) {
        Smooth material = elastic(stiffness);
        material.setDissipation(dissipation);
        std::vector<GrainMotion> grains;
        std::vector<std::uint32_t> all;
        for (std::uint32_t k = 0; k < 8; ++k) {
            grains.push_back({.radius = r, .position = {2 * r * k, 0, r}});
            all.push_back(k);
        }
        FewGrains<Smooth> scene(material, grains, 1e-7, {{{0, 0, -1}, {0, 0, 0}}});
        scene.setIntegrator(integrators::velocityVerlet);
        const BodyReference rod = scene.bodyHandler.join(all);
        double arms = 0;
        for (int k = 0; k < 8; ++k) arms += square(2 * r * (k - 3.5));
        const double share = std::max(8 / rod.getMass(), arms / rod.getInertia()[2]);  // 1/kg
        const double spring = 0.25 * share * stiffness, slope = 0.5 * share * dissipation;
        const double critical = 2 / (slope + std::sqrt(slope * slope + 4 * spring));
        EXPECT_LT(scene.stabilityLimit(), critical) << dissipation;
        EXPECT_GT(scene.stabilityLimit(), 0.89 * critical) << dissipation;
    }
}

// A rod of Hertzian grains that stick between two plates, pressed by nearly the 5 % that the limit is made
// for, with dashpots of a restitution: it shifts, turns and swings against their springs in the longest step
// that is allowed. It starts where its springs have least energy, so its kinetic energy is never more than at
// first, and dies away.
TEST(ClumpMotion, aPressedRodIsStableAtTheLimitOfTheDefaultScheme) {
    constexpr double r = 1e-3, overlap = 0.049 * r;
    Hertzian material;
    material.setDensity(density);
    material.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.7);
    material.setEffectiveShearModulus(2e6);
    material.setSpringFactor(1);

    material.setSlidingFrictionCoefficient(10);
    std::vector<GrainMotion> grains;
    std::vector<std::uint32_t> all;
    for (std::uint32_t k = 0; k < 8; ++k) {
        grains.push_back({.radius = r, .position = {2 * r * (k - 3.5), 0, 0}});
        all.push_back(k);
    }
    const double gap = r - overlap;
    FewGrains<Hertzian> scene(material, grains, 1e-7, {{{0, 0, -1}, {0, 0, -gap}}, {{0, 0, 1}, {0, 0, gap}}});
    BodyReference rod = scene.bodyHandler.join(all);
    rod.setVelocity({1e-3, -2e-3, 1e-3});
    rod.setAngularVelocity({0.5, 0.3, -0.2});
    scene.setTimeStep(scene.stabilityLimit());
    scene.initialise();
    const auto kinetic = [&] { return scene.getKineticEnergy() + scene.getRotationalEnergy(); };
    const double start = kinetic();
    double largest = 0;
    for (int k = 0; k < 2000; ++k) {
        scene.step();
        largest = std::max(largest, kinetic());
    }
    EXPECT_LE(largest, start);
    EXPECT_LT(kinetic(), 1e-3 * start);
}

// Between two plates, without dashpots, a rod of n grains shifts with 2 n k / M = 2 k/m, its fastest motion.
// Velocity Verlet stands w h = 2, and the limit is 0.9 of that, but for a digit of the sums. At 0.9 of the
// limit no motion is more than at the start; at 1.25 of it, w h = 2.25, it grows by exp(2 acosh(1.125)) = 2.7
// in each step, from 1e-10 m to less than the overlap of 4e-5 m in 12 of them.
TEST(ClumpMotion, aRodBetweenPlatesIsStableBelowItsLimitAndNotFarAbove) {
    constexpr double r = 1e-3, stiffness = 1000, gap = 0.96 * r, speed = 1e-6;
    const auto growth = [&](double share, int steps) {
        std::vector<GrainMotion> grains;
        std::vector<std::uint32_t> all;
        for (std::uint32_t k = 0; k < 8; ++k) {
            grains.push_back({.radius = r, .position = {2 * r * (k - 3.5), 0, 0}});
            all.push_back(k);
        }
        FewGrains<Smooth> scene(elastic(stiffness), grains, 1e-7,
                                {{{0, 0, -1}, {0, 0, -gap}}, {{0, 0, 1}, {0, 0, gap}}});
        scene.setIntegrator(integrators::velocityVerlet);
        BodyReference rod = scene.bodyHandler.join(all);
        rod.setVelocity({0, 0, speed});
        const double limit = scene.stabilityLimit(), exact = 2 / std::sqrt(16 * stiffness / rod.getMass());
        EXPECT_NEAR(limit / exact, 0.9, 1e-3);
        scene.setTimeStep(share * limit);
        scene.acceptUnstableTimeStep();
        scene.initialise();
        double most = 0;
        for (int k = 0; k < steps; ++k) {
            scene.step();
            most = std::max(most, std::abs(rod.getVelocity().z()));
        }
        return most / speed;
    };
    EXPECT_LT(growth(0.9, 2000), 1 + 1e-6);
    EXPECT_GT(growth(1.25, 12), 1e3);
}

// A wheel of 180 spheres on grains of their size, with dashpots of a restitution. It moves at each contact
// with its own mass, and its springs are those of as many spheres. A plane at its side touches 60 at once,
// with dashpots for 180 masses: sqrt(180) 60 / 180 = 4.5 times what the four contacts along a direction have
// of a grain, on both sides of the sum. It was less than a tenth of the limit of the grains, as each sphere
// of the wheel counted with these dashpots by itself.
TEST(ClumpMotion, aWheelOfManySpheresDoesNotBindTheStepOfTheGrains) {
    constexpr double r = 1e-3;
    Hertzian material;
    material.setDensity(density);
    material.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.5);
    material.setEffectiveShearModulus(2e6);
    material.setSlidingFrictionCoefficient(0.5);
    std::vector<GrainMotion> grains;
    std::vector<std::uint32_t> wheel;
    for (std::uint32_t k = 0; k < 180; ++k) {
        const double angle = 2 * std::numbers::pi * (k % 60) / 60, rim = 19.2 * r;
        grains.push_back(
            {.radius = r, .position = {rim * std::cos(angle), rim * std::sin(angle), 2.01 * r * (k / 60)}});
        wheel.push_back(k);
    }
    for (int k = 0; k < 30; ++k) grains.push_back({.radius = r, .position = {0.1 + 3 * r * k, 0, 0}});
    const std::vector<scenes::PlaneAt> floor{{{0, 0, -1}, {0, 0, -0.1}}};
    FewGrains<Hertzian> free(material, grains, 1e-7, floor), joined(material, grains, 1e-7, floor);
    joined.bodyHandler.join(wheel);
    EXPECT_GT(joined.stabilityLimit(), 0.15 * free.stabilityLimit());
    EXPECT_LT(joined.stabilityLimit(), 1.01 * free.stabilityLimit());
}

// The step of a body is that of its own mass, also where a small sphere of it is 1/64 of the large one's: it
// was a fifth of that, because the small one's mass counted. Two of them, so that they may meet.
TEST(ClumpMotion, aSmallSphereOnALargeOneDoesNotBindTheStep) {
    constexpr double r = 1e-3;
    Smooth material = elastic(1000);
    const auto limitOf = [&](bool hasKnob) {
        FewGrains<Smooth> scene(material, {}, 1e-7);
        std::vector<Ball> balls{{{0, 0, 0}, r}, {{0, 0, 0.3 * r}, 0.9 * r}};
        if (hasKnob) balls.push_back({{0, 0, 1.3 * r}, 0.25 * r});
        Clump clump{ClumpTemplate(balls)};
        clump.setSpecies(scene.speciesHandler.getObject(0));
        for (int k = 0; k < 14; ++k) {
            clump.setPosition({4 * r * k, 0, 0});
            scene.bodyHandler.copyAndAddObject(clump);
        }
        return scene.stabilityLimit();
    };
    // With the knob contacts have an arm of 1.3 r, a squared frequency of up to 1 + 5/2 x 1.7 times as much.
    EXPECT_GT(limitOf(true), limitOf(false) / std::sqrt(5.25));
    EXPECT_LT(limitOf(true), limitOf(false));
}

// A rod of dense spheres on one that is held, in step with it: each sphere touches five of the other one
// where the deepest overlap is 5 %. All of these springs shift the rod, which must be stable at the limit.
TEST(ClumpMotion, theLimitKnowsHowManySpheresOfAHeldBodyOneTouches) {
    constexpr double r = 1e-3, stiffness = 1000, spacing = 0.2 * r, apart = 1.95 * r;
    constexpr std::uint32_t count = 10;
    std::vector<GrainMotion> grains;
    std::vector<std::uint32_t> below, above;
    for (std::uint32_t k = 0; k < 2 * count; ++k) {
        grains.push_back({.radius = r, .position = {spacing * (k % count), 0, k < count ? 0 : apart}});
        (k < count ? below : above).push_back(k);
    }
    FewGrains<Smooth> scene(elastic(stiffness), grains, 1e-7);
    scene.setIntegrator(integrators::velocityVerlet);
    // A capsule, nearly: overlapping spheres count once.
    constexpr double length = spacing * (count - 1);  // m
    const double mass = density * std::numbers::pi * r * r * (length + 4 * r / 3),
                 across = mass * (0.4 * r * r + length * length / 12);
    const Eigen::Matrix3d inertia = Eigen::Vector3d(0.4 * mass * r * r, across, across).asDiagonal();
    const auto join = [&](const std::vector<std::uint32_t>& spheres, double height) {
        return scene.bodyHandler.join(spheres, BodyMass{mass, {0.5 * length, 0, height}, inertia});
    };
    join(below, 0).fixBody();
    const BodyReference rod = join(above, apart);
    double share = 0;  // of k, along the line between the rods
    for (const std::uint32_t a : below)
        for (const std::uint32_t b : above) {
            const Vec3D way = grains[b].position - grains[a].position;
            if (way.norm() < 2 * r) share += way.z() * way.z() / way.squaredNorm();
        }
    const double exact = 2 / std::sqrt(share * stiffness / rod.getMass());
    EXPECT_LT(scene.stabilityLimit(), exact);
    EXPECT_GT(scene.stabilityLimit(), 0.2 * exact);
}

/// Two fused spheres that turn in a box of smooth elastic walls: for 10^6 steps.
TEST(LongClumpMotion, fusedSpheresDoNotDriftInABoxFor1e6Steps) {
    FewGrains<Smooth> scene(elastic(1000), {}, 4e-6);
    constexpr double edge = 0.012;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            InfiniteWall wall;
            wall.setSpecies(scene.speciesHandler.getObject(0));
            wall.set(sign * Vec3D::Unit(axis), (sign > 0 ? edge : 0) * Vec3D::Unit(axis));
            scene.wallHandler.copyAndAddObject(wall);
        }
    Clump clump(shapes(1e-3)[0]);
    clump.setSpecies(scene.speciesHandler.getObject(0));
    clump.setPosition({0.005, 0.006, 0.007});
    clump.setVelocity({0.2, 0.13, -0.17});
    clump.setAngularVelocity({30, 40, 20});
    BodyReference body = scene.bodyHandler.copyAndAddObject(clump);
    scene.initialise();
    const double energy = scene.getKineticEnergy() + scene.getRotationalEnergy();
    // Smooth contacts never turn a body of revolution about its axis.
    const auto axisSpin = [&] {
        return body.getAngularVelocity().dot(body.getPrincipalAxes() * Vec3D::UnitX());
    };
    const double spin = axisSpin();
    double largest = 0;
    for (int block = 0; block < 100; ++block) {
        scene.step(10000);
        if (!scene.interactions().empty()) continue;
        largest = std::max(largest,
                           std::abs((scene.getKineticEnergy() + scene.getRotationalEnergy()) / energy - 1));
    }
    // Velocity Verlet errs by (w h)^2 / 4 in a touch, w h = 0.04, either way, and each of some 500 touches by
    // itself: sqrt(500) of it.
    EXPECT_LT(largest, std::sqrt(500) * 0.04 * 0.04 / 4);
    // The splitting lets the spin about the axis swing by some (w h)^2 / 12 of the largest spin, which a
    // touch meets at any phase.
    const double fastest = std::sqrt(2 * energy / body.getInertia()[2]),
                 angle = fastest * scene.getTimeStep();
    EXPECT_LT(std::abs(axisSpin() - spin), std::sqrt(500) * angle * angle / 12 * fastest);
    EXPECT_NEAR((scene.motion(0).position - scene.motion(1).position).norm(), 1e-3, 1e-16 * 1e3);
}

}  // namespace
}  // namespace pendular::clumpMotionTest
