#include <gtest/gtest.h>

#include <functional>
#include <memory>

#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "SelfTests/Walls/WallScene.h"

// A belt, whose surface runs while its shape stays, drags grains along and never pushes them: it cannot, as
// nothing of it comes nearer. So its velocity along the normal is left out, of each wall at each point.

namespace pendular::wallTests::beltTest {
namespace {

using scenes::GrainMotion;

const Vec3D beltVelocity{0.3, -0.2, 0.5};  // m/s

/// A wall, and places (m) of grains that touch it.
struct Belt {
    const char* name;
    std::function<std::unique_ptr<RigidWall>()> make;
    std::vector<Vector<double>> places;
};

template <class Shape, class Set>
std::function<std::unique_ptr<RigidWall>()> made(Set set) {
    return [set] {
        auto wall = std::make_unique<Shape>();
        set(*wall);
        return wall;
    };
}

std::vector<Belt> belts() {
    const double d = 0.99 * radius;
    return {
        {"plane",
         made<InfiniteWall>([](auto& w) {
             w.set({0, 0, -1}, {0, 0, 0});
         }),
         {at(0, 0, d)}},
        {"inclined plane",
         made<InfiniteWall>([](auto& w) {
             w.set({0.6, 0, -0.8}, {0, 0, 0});
         }),
         {at(-0.6 * d, 0, 0.8 * d)}},
        {"cylinder from inside",
         made<InfiniteCylinder>([](auto& w) {
             w.set({0, 1, 0}, {0, 0, 0}, 5e-3, CylinderSide::Inside);
         }),
         {at(5e-3 - d, 0, 0), at(0, 0, d - 5e-3), at(0.6 * (5e-3 - d), 1e-3, 0.8 * (5e-3 - d))}},
        {"rod",
         made<InfiniteCylinder>([](auto& w) {
             w.set({0, 1, 0}, {0, 0, 0}, 5e-3, CylinderSide::Outside);
         }),
         {at(5e-3 + d, 0, 0), at(0.6 * (5e-3 + d), 1e-3, 0.8 * (5e-3 + d))}},
        {"cone",
         made<AxisymmetricWall>([](auto& w) {
             w.set({0, 0, 1}, {0, 0, 0}, {{2e-3, 0}, {6e-3, 3e-3}});
         }),
         // On its upper side, and on its rim.
         {at(4e-3 - 0.6 * d, 0, 1.5e-3 + 0.8 * d), at(6e-3 + 0.8 * d, 0, 3e-3 + 0.6 * d)}},
        {"mesh",
         made<TriangleWall>([](auto& w) { w.set(box(at(-4e-3, -3e-3, -5e-3), at(4e-3, 3e-3, 0))); }),
         // On a face, an edge and a corner.
         {at(1e-3, 1e-3, d), at(4e-3 + 0.6 * d, 0, 0.8 * d), at(4e-3 + 0.48 * d, 3e-3 + 0.64 * d, 0.6 * d)}}};
}

std::vector<WallPoint> pointsOf(const Wall& wall, const Vector<double>& centre) {
    return pointsFor(wall, centre, radius);
}

// The former code gave the whole velocity.
TEST(Belt, runsAlongItsSurfaceAtEachPoint) {
    for (const Belt& belt : belts()) {
        SCOPED_TRACE(belt.name);
        for (const Vector<double>& place : belt.places) {
            const auto wall = belt.make();
            wall->setSurfaceVelocity(beltVelocity);
            const std::vector<WallPoint> points = pointsOf(*wall, place);
            ASSERT_EQ(points.size(), 1u);
            const Vec3D normal = toEigen(points[0].normal),
                        expected = beltVelocity - beltVelocity.dot(normal) * normal;
            EXPECT_GT(std::abs(beltVelocity.dot(normal)), 0.01);
            EXPECT_LT((toEigen(points[0].velocity) - expected).norm(), 1e-15);
            if (const auto plane = wall->planeAtRest()) {
                EXPECT_EQ(plane->surfaceVelocity, points[0].velocity);
            }
        }
    }
}

/// A wall that moves has its own velocity, normal part and all, and the part of the belt's that is along it.
TEST(Belt, onAWallThatMovesAndTurns) {
    for (const Belt& belt : belts()) {
        SCOPED_TRACE(belt.name);
        const auto moved = belt.make(), running = belt.make();
        running->setSurfaceVelocity(beltVelocity);
        for (RigidWall* wall : {moved.get(), running.get()}) {
            wall->setVelocity({0.1, 0.2, 0.3});
            wall->setAngularVelocity({3, -4, 12}, {1e-3, 2e-3, 0});
            wall->moveTo(0.02);
        }
        for (const Vector<double>& place : belt.places) {
            const Vector<double> there = moved->getPose().place(place);
            const WallPoint without = pointsOf(*moved, there).at(0), with = pointsOf(*running, there).at(0);
            EXPECT_EQ(without.normal, with.normal);
            const Vec3D normal = toEigen(with.normal),
                        turned = toEigen(moved->getPose().turn(toVector(beltVelocity)));
            EXPECT_LT(
                (toEigen(with.velocity - without.velocity) - (turned - turned.dot(normal) * normal)).norm(),
                1e-14);
        }
    }
}

template <class Scene>
void addBelt(Scene& scene, const Belt& belt, const Vec3D& velocity) {
    const auto wall = belt.make();
    const auto add = [&](auto shape) {
        shape.setSurfaceVelocity(velocity);
        scene.add(shape);
    };
    if (const auto* plane = dynamic_cast<const InfiniteWall*>(wall.get())) add(*plane);
    if (const auto* cylinder = dynamic_cast<const InfiniteCylinder*>(wall.get())) add(*cylinder);
    if (const auto* turned = dynamic_cast<const AxisymmetricWall*>(wall.get())) add(*turned);
    if (const auto* triangles = dynamic_cast<const TriangleWall*>(wall.get())) add(*triangles);
}

/// A grain at a place, pressed against the wall by gravity, so that it touches it for long.
template <class S>
std::unique_ptr<WallScene<S>> pressed(const Belt& belt, const Vector<double>& place, const Vec3D& velocity,
                                      const S& species) {
    const auto wall = belt.make();
    const Vec3D normal = toEigen(pointsOf(*wall, place).at(0).normal);
    auto scene = std::make_unique<WallScene<S>>(
        std::vector<GrainMotion>{{.radius = radius, .position = toEigen(place), .velocity = -0.02 * normal}},
        species, 9.81 * normal);
    addBelt(*scene, belt, velocity);
    scene->keepEnergyLedger();
    scene->setQuiet();
    scene->initialise();
    return scene;
}

// The former belt gave and took energy as the dashpot pushed or held a grain that did not come nearer to it.
TEST(Belt, doesNothingToAGrainWithoutFriction) {
    for (const Belt& belt : belts())
        for (const Vector<double>& place : belt.places)
            for (const double restitution : {1.0, 0.6}) {
                SCOPED_TRACE(belt.name);
                const Smooth species = material<Smooth>(restitution);
                auto still = pressed<Smooth>(belt, place, {0, 0, 0}, species),
                     running = pressed<Smooth>(belt, place, beltVelocity, species);
                still->steps(2000);
                running->steps(2000);
                EXPECT_LT((running->motion(0).position - still->motion(0).position).norm(), 1e-12);
                const EnergyLedger& ledger = running->energyLedger();
                EXPECT_NEAR(ledger.walls, 0, 1e-12 * ledger.kinetic);
                EXPECT_NEAR(ledger.total(), still->energyLedger().total(), 1e-9 * mass() * 9.81 * radius);
            }
}

/// With friction the belt gives what its force along the surface does, and what grains get comes from there.
TEST(Belt, givesByFrictionWhatTheLedgerSays) {
    for (const Belt& belt : belts())
        for (const Vector<double>& place : belt.places) {
            SCOPED_TRACE(belt.name);
            auto scene = pressed<Dry>(belt, place, beltVelocity, material<Dry>());
            const double before = scene->energyLedger().closed(), scale = mass() * beltVelocity.squaredNorm();
            scene->steps(2000);
            const EnergyLedger& ledger = scene->energyLedger();
            EXPECT_NEAR(ledger.closed(), before, 1e-12 * scale);
            EXPECT_GT(ledger.walls, 0);
            EXPECT_GT(ledger.sliding, 0);
            EXPECT_NEAR(ledger.stepError, 0, 0.01 * ledger.walls);
        }
}

}  // namespace
}  // namespace pendular::wallTests::beltTest
