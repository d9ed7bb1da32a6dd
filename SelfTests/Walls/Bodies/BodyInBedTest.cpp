// Walls that are bodies in beds of grains: what is conserved, threads and restarts.
#include <gtest/gtest.h>

#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"
#include "SelfTests/Walls/Bodies/BodyScene.h"

namespace pendular::bodyTests::bodyInBedTest {
namespace {

/// A stirrer with a torque, a slab that slides, and a box that moves freely, in a bed that settles.
class StirredBox : public scenes::SettlingBox<Rough> {
public:
    TriangleWall *stirrer = nullptr, *slab = nullptr, *box = nullptr;

    explicit StirredBox(const Integrator& scheme = integrators::predictedVelocityVerlet)
        : scenes::SettlingBox<Rough>(4) {
        // Between two rows of the grains: a sheet from below them to above.
        const Vector<double> a{0.002, between, 0.001}, b{0.0105, between, 0.001}, c{0.0105, between, 0.012},
            d{0.002, between, 0.012};
        stirrer = add({{a, b, c}, {a, c, d}});
        stirrer->setRotor({0, 0, 1}, axis, stirring);
        slab = add(closedBox({0.00625, 0.00625, 0.016}, {0.011, 0.011, 0.0002}));
        slab->setVelocity({0.01, 0.02, -0.1});
        slab->setSlider({0.1, 0, 1}, {.mass = 2e-4, .force = -0.02, .friction = 1e-4});
        box = add(closedBox({0.00625, 0.00625, 0.0135}, {0.003, 0.002, 0.001}));
        box->setVelocity({0, 0, -0.8});
        box->setAngularVelocity({30, 20, 10}, {0.00625, 0.00625, 0.0135});
        box->setSurfaceVelocity({0.05, 0, 0});
        box->setFreeBody(4000);
        this->setIntegrator(scheme);
        this->setQuiet();
    }
    static constexpr double between = 0x1.9p-9 * 2.05;  // m
    const Vec3D axis{0.00625, between, 0};
    RotorSettings stirring{.inertia = 2e-9, .torque = 2e-6, .friction = 1e-7, .largestSpin = 200};

    void stirMore() {
        stirring.torque = -3e-6;
        stirrer->setRotor({0, 0, 1}, axis, stirring);
    }
    [[nodiscard]] std::uint64_t hash() { return stateHash(this->particleHandler.store()); }

private:
    TriangleWall* add(const std::vector<Triangle>& triangles) {
        TriangleWall wall = bodyTests::mesh(triangles);
        wall.setSpecies(this->speciesHandler.getObject(0));
        return this->wallHandler.copyAndAddObject(wall);
    }
};

// The error is as in the beds of SelfTests/Energy: sqrt(N) 2^-53 of all that was turned over, five times.
TEST(WallBody, theLedgerCloses) {
    for (const Integrator& scheme : integrators::all) {
        StirredBox scene(scheme);
        scene.keepEnergyLedger();
        scene.initialise();
        const EnergyLedger& ledger = scene.energyLedger();
        const double start = ledger.closed();
        std::array<std::uint64_t, 3> touches{};
        const auto go = [&] {
            for (int n = 0; n < 30; ++n) {
                scene.step(100);
                touches[0] += scene.stirrer->body()->touches, touches[1] += scene.slab->body()->touches;
                touches[2] += scene.box->body()->touches;
            }
        };
        go();
        scene.stirMore();
        scene.setGravity({0, 0, -5});
        go();
        double all = 0;
        for (const auto& entry : EnergyLedger::entries()) all += std::abs(ledger.*entry.member);
        EXPECT_LT(std::abs(ledger.closed() - start), 5 * std::sqrt(6000) * 0x1p-53 * all) << scheme.name;
        EXPECT_NE(ledger.loads, 0);
        EXPECT_GT(ledger.bearings, 0);
        EXPECT_NE(ledger.walls, 0);  // the belt
        EXPECT_GT(ledger.sliding, 0);
        // What is not closed by construction: the error of the steps is a small share.
        EXPECT_LT(std::abs(ledger.stepError), 0.02 * ledger.lost()) << scheme.name;
        for (const std::uint64_t count : touches) EXPECT_GT(count, 5u);
    }
}

/// A wall that grains touch becomes a body, and turns about another axis, in the run: the ledger stays
/// closed.
TEST(WallBody, theLedgerClosesWhereItBeginsInTheRun) {
    StirredBox scene;
    scene.stirrer->setAngularVelocity({0, 0, 20}, scene.axis);
    scene.keepEnergyLedger();
    scene.initialise();
    const EnergyLedger& ledger = scene.energyLedger();
    const double start = ledger.closed();
    const auto isClosed = [&] {
        double all = 0;
        for (const auto& entry : EnergyLedger::entries()) all += std::abs(ledger.*entry.member);
        return std::abs(ledger.closed() - start) < 5 * std::sqrt(6000) * 0x1p-53 * all;
    };
    const auto goUntilTouched = [&] {
        scene.stirrer->keepForces();
        for (int n = 0; n < 4000 && scene.stirrer->getForce().norm() == 0; ++n) scene.step();
        EXPECT_GT(scene.stirrer->getForce().norm(), 0);
        EXPECT_TRUE(isClosed());
    };
    goUntilTouched();
    scene.stirrer->setRotor({0, 0, 1}, scene.axis, scene.stirring);
    scene.step(1);
    EXPECT_TRUE(isClosed());
    goUntilTouched();
    scene.stirrer->setRotor({0, 0, 1}, scene.axis + Vec3D(0.001, 0, 0), scene.stirring);
    scene.step(1);
    EXPECT_TRUE(isClosed());
}

/// The change of a stirrer's angular momentum is the sum of its torques, each with half a step on either
/// side.
TEST(WallBody, theTorquesOfAStirrerBalance) {
    StirredBox scene;
    scene.stirring.friction = 0, scene.stirring.largestSpin = infinity;
    scene.stirrer->setRotor({0, 0, 1}, scene.axis, scene.stirring);
    scene.stirrer->keepForces(true, scene.axis + Vec3D(0, 0, 0.01));
    scene.initialise();
    double sum = 0, turned = 0, work = 0, last = 0;
    for (int n = 0; n < 4000; ++n) {
        const double before = scene.stirrer->getTorque().z();
        scene.step();
        sum += 0.5 * scene.getTimeStep() * (before + scene.stirrer->getTorque().z()) +
               scene.getTimeStep() * scene.stirring.torque;
        turned += std::abs(before) * scene.getTimeStep();
        work += scene.getTimeStep() * before;
        last = scene.stirrer->getBodySpeed();
    }
    EXPECT_NEAR(scene.stirring.inertia * last, sum, 1e-12 * turned);
    EXPECT_LT(work, -0.3 * scene.stirring.torque * 4000 * scene.getTimeStep());  // grains resist
}

/// Grains that hit a free box in empty space: momentum and angular momentum are kept to round-off.
TEST(WallBody, momentumIsKeptInSpace) {
    for (const Integrator& scheme : integrators::all) {
        std::vector<GrainMotion> grains;
        for (int k = 0; k < 12; ++k) {
            const double angle = 2.4 * k, height = 2e-3 * (k % 5 - 2);
            const Vec3D from(std::cos(angle), std::sin(angle), 0.3 * (k % 3 - 1));
            grains.push_back({.radius = 1e-3,
                              .position = (0.01 + 0.003 * k) * from + Vec3D(0, 0, height),
                              .velocity = -0.5 * from,
                              .spin = {100, -50, 70. * k}});
        }
        BodyScene<Rough> scene(material<Rough>(1000, 0.01, 2500), grains, 5e-6);
        scene.setIntegrator(scheme);
        TriangleWall* const box = scene.add(mesh(closedBox({0, 0, 0}, {0.004, 0.006, 0.01})));
        box->setFreeBody(3000);
        scene.initialise();
        struct Momenta {
            Vec3D linear, angular;
        };
        const auto momenta = [&] {
            const RigidBody& free = box->body()->free;
            const Vec3D own = free.mass * toEigen(free.velocity),
                        ownAngular = toEigen(free.position).cross(own) + toEigen(free.angularMomentum);
            return Momenta{scene.linearMomentum() + own, scene.angularMomentum() + ownAngular};
        };
        const Momenta before = momenta();
        scene.step(20000);
        const Momenta after = momenta();
        const double ofGrain = 4e-9 * std::numbers::pi / 3 * 2500 * 0.5;  // kg m/s
        EXPECT_LT((after.linear - before.linear).norm(), 1e-11 * ofGrain) << scheme.name;
        // The positions of the third order scheme keep no angular momentum, of grains either.
        if (!scheme.remembersEarlier()) {
            EXPECT_LT((after.angular - before.angular).norm(), 1e-11 * ofGrain * 0.01) << scheme.name;
        }
        EXPECT_GT(norm(box->body()->free.velocity), 0.01);
        EXPECT_GT(norm(box->body()->free.spin()), 1);
    }
}

TEST(WallBody, hasTheSameBitsForAnyThreadsAndThroughRestarts) {
    const support::TestFolder folder;
    StirredBox whole;
    whole.initialise();
    whole.step(500);
    whole.stirMore();
    whole.step(700);
    const auto file = folder.path() / "half.h5";
    whole.writeRestart(file);
    whole.step(800);
    for (const int threads : {1, 3}) {
        StirredBox other;
        other.setNumberOfThreads(threads);
        other.initialise();
        other.step(500);
        other.stirMore();
        other.step(1500);
        StirredBox resumed;
        resumed.setNumberOfThreads(threads);
        resumed.restartFrom(file);
        resumed.initialise();
        resumed.step(800);
        for (StirredBox* scene : {&other, &resumed}) {
            EXPECT_EQ(scene->hash(), whole.hash());
            EXPECT_EQ(scene->stirrer->getBodyWay(), whole.stirrer->getBodyWay());
            EXPECT_EQ(scene->slab->getBodySpeed(), whole.slab->getBodySpeed());
            EXPECT_EQ(scene->box->getPose().shift, whole.box->getPose().shift);
            EXPECT_EQ(scene->box->body()->free.angularMomentum, whole.box->body()->free.angularMomentum);
        }
    }
    StirredBox different;
    different.stirring.torque = 1e-6;
    different.stirrer->setRotor({0, 0, 1}, different.axis, different.stirring);
    different.restartFrom(file);
    EXPECT_TRUE(support::contains(support::refusal([&] { different.initialise(); }), "firstLoad"));
}

}  // namespace
}  // namespace pendular::bodyTests::bodyInBedTest
