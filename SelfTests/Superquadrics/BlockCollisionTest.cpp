#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Analysis/Output/ShapeFields.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "SelfTests/Restart/SameBits.h"
#include "SelfTests/Superquadrics/FewBlocks.h"
#include "SelfTests/Support/LedgerError.h"
#include "SelfTests/Support/Refusal.h"

// Blocks that collide: what is conserved, bits, restart, and what is refused.

namespace pendular::blockCollisionTest {
namespace {

using scenes::blockSpecies;
using scenes::FewBlocks;
using scenes::turnedBy;
using support::contains;
using support::refusal;

/// Two blocks that fly at each other, an edge of one across an edge of the other.
struct EdgeOnEdge : FewBlocks {
    explicit EdgeOnEdge(double dissipation, double friction = 0.4, double step = 1e-6)
        : FewBlocks(blockSpecies(1e4, dissipation, friction)) {
        const Vec3D half(2e-3, 1.5e-3, 1e-3);
        const double quarter = 0.25 * std::numbers::pi;
        add({half, 3e-4, {0, 0, 0}, {0.02, 0, 0.2}, {5, 3, -4}, turnedBy(quarter, {1, 0, 0})});
        add({half,
             3e-4,
             {3e-4, 2e-4, 3.8e-3},
             {0, 0.01, -0.3},
             {-3, 6, 2},
             turnedBy(0.5 * std::numbers::pi + 0.1, {0, 0, 1}) * turnedBy(quarter, {1, 0, 0})});
        setTimeStep(step);
    }
};

// Round-off of 10 000 steps; angular momentum also has that of turning, of third order in a step's turn of
// some 1e-5 rad.
TEST(BlockCollision, keepsMomentumAngularMomentumAndTheLedger) {
    EdgeOnEdge scene(0.1);
    scene.keepEnergyLedger();
    scene.initialise();
    const Vec3D momentum = scene.linearMomentum(), angular = scene.angularMomentum();
    const double start = scene.energyLedger().closed();
    bool byEdges = false;
    for (int k = 0; k < 10000; ++k) {
        scene.step();
        for (const ObservedContact& contact : scene.interactions())
            byEdges |= contact.particle1 % 21 > 8 && contact.particle2 % 21 > 8;
    }
    EXPECT_TRUE(byEdges);
    EXPECT_LT((scene.linearMomentum() - momentum).norm(), 1e-12 * scene.body(0).getMass() * 0.3);
    EXPECT_LT((scene.angularMomentum() - angular).norm(), 1e-9 * angular.norm());
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(ledger.normalDashpots, 0.02 * ledger.kinetic);
    EXPECT_NEAR(ledger.closed(), start, 1e-11 * start);
    EXPECT_LT(std::abs(ledger.stepError), 1e-3 * ledger.kinetic);
}

// Springs without dashpots and friction have a potential: the energy after the collision is that before, to
// the second order of the step.
TEST(BlockCollision, keepsTheEnergyOfElasticOnes) {
    const auto error = [](double step) {
        EdgeOnEdge scene(0, 0, step);
        scene.initialise();
        const double before = scene.kinetic();
        scene.stepUntil(0.01);
        EXPECT_TRUE(scene.interactions().empty());
        return std::abs(scene.kinetic() / before - 1);
    };
    const double coarse = error(4e-6), fine = error(1e-6);
    EXPECT_LT(fine, 1e-5);
    EXPECT_LT(fine, 0.25 * coarse + 1e-9);
}

/// Blocks, spheres and a dumbbell that fall into a box.
struct Mixture : FewBlocks {
    Mixture() : FewBlocks(blockSpecies(5e3, 0.05, 0.5)) {
        for (int k = 0; k < 12; ++k) {
            const Vec3D place(2.5e-3 * (k % 2 * 2 - 1), 2.5e-3 * (k / 2 % 2 * 2 - 1),
                              3e-3 + 4.5e-3 * (k / 4));
            add({{2e-3, 1.4e-3, 1e-3},
                 3e-4,
                 place,
                 {0.1, -0.01 * k, -0.6},
                 {30, 10.0 * k, -20},
                 turnedBy(k, {1, 2, 3})});
        }
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(1e-3);
        for (int k = 0; k < 4; ++k) {
            grain.setPosition({2e-3 * (k % 2), 2e-3 * (k / 2), 18e-3});
            grain.setVelocity({0.05, 0.02 * k, -0.4});
            particleHandler.copyAndAddObject(grain);
        }
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0})
                if (axis < 2 || sign < 0)
                    addPlane(sign * Vec3D::Unit(axis), (axis < 2 ? sign * 5.2e-3 : 0) * Vec3D::Unit(axis));
        setGravity({0, 0, -9.81});
        setTimeStep(0.3 * stabilityLimit());
    }
};

TEST(BlockCollision, givesTheSameBitsForAnyThreadsAndRestarts) {
    Mixture half, resumed, threaded;
    half.run(3000);
    support::expectSameBits(half, resumed, threaded, 3000, 3000);
    EXPECT_GT(half.contacts().store().blocks.size(), 10u);
}

TEST(BlockCollision, closesTheEnergyLedgerOfAMixture) {
    Mixture scene;
    scene.keepEnergyLedger();
    scene.initialise();
    const double start = scene.energyLedger().closed();
    scene.step(6000);
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_LT(std::abs(ledger.closed() - start), support::roundOff(ledger, 6000));
    EXPECT_GT(ledger.normalDashpots, 0.1 * ledger.kinetic);
    EXPECT_GT(ledger.sliding, 0.01 * ledger.kinetic);
    EXPECT_LT(std::abs(ledger.stepError), 0.01 * ledger.lost());
}

// Of cubes with half lengths H, and h from the centre to where corners begin, all of whose faces lie on those
// of others: about an axis normal forces have arms h on four faces with eight contacts each, friction arms of
// 2 h^2 on two and H on four. A cube and another one each have these, and velocity Verlet stands w h = 2.
TEST(BlockCollision, theStabilityLimitIsThatOfCubesOnCubes) {
    constexpr double k = 1e4, outer = 2e-3, radius = 1e-4, h = outer - radius;
    FewBlocks scene(blockSpecies(k, 0, 0.4));
    for (int n = 0; n < 8; ++n) scene.add({{outer, outer, outer}, radius, {0.01 * n, 0, 0}});
    scene.setIntegrator(integrators::velocityVerlet);
    const double normal = 32 * h * h * k, friction = 32 * (h * h + outer * outer) * 0.5 * k,
                 squared = (normal + friction) / scene.body(0).getInertia()[0];
    EXPECT_NEAR(scene.stabilityLimit() / (0.9 * 2 / std::sqrt(2 * squared)), 1, 2e-3);
}

// A block that lies on a floor, on that of its faces whose corners have the longest arms. The limit was
// 10 to 72 times too short: it is 0.9 of what these four allow; of one on another one, which may have more on
// them, half of that.
TEST(BlockCollision, theStabilityLimitIsNearTheStepOfItsContacts) {
    for (const Vec3D& half : {Vec3D(2e-3, 2e-3, 2e-3), Vec3D(4e-3, 4e-3, 1e-3), Vec3D(6e-3, 2e-3, 1e-3)})
        for (const int count : {1, 2}) {
            FewBlocks scene(blockSpecies(1e4, 0, 0));
            const double overlap = 1e-7;
            for (int k = 0; k < count; ++k)
                scene.add({half, 2e-4, {0, 0, (2 * k + 1) * (half.z() - overlap)}});
            scene.addPlane({0, 0, -1}, {0, 0, 0});
            scene.setIntegrator(integrators::velocityVerlet);
            scene.setQuiet();
            const double limit = scene.stabilityLimit();
            scene.setTimeStep(0.5 * limit);
            scene.initialise();
            const double bound = scene.stableStepOfContacts();
            EXPECT_LE(limit, bound) << half.transpose() << " " << count;
            EXPECT_GE(limit, (count == 1 ? 0.89 : 0.2) * bound) << half.transpose() << " " << count;
        }
}

// A cube that six planes press: about each axis 16 corners on four faces have arms h.
TEST(BlockCollision, theStabilityLimitIsThatOfACubeInABox) {
    constexpr double k = 1e4, outer = 2e-3, radius = 1e-4, h = outer - radius;
    FewBlocks scene(blockSpecies(k, 0, 0));
    scene.add({{outer, outer, outer}, radius, {0, 0, 0}});
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0})
            scene.addPlane(sign * Vec3D::Unit(axis), sign * outer * Vec3D::Unit(axis));
    scene.setIntegrator(integrators::velocityVerlet);
    const double squared = 16 * h * h * k / scene.body(0).getInertia()[0];
    EXPECT_NEAR(scene.stabilityLimit() / (0.9 * 2 / std::sqrt(squared)), 1, 2e-3);
}

// All corners of the polygons are on the surface: at the radius of the edges from the cuboid.
TEST(BlockCollision, isDrawnAsABox) {
    FewBlocks scene(blockSpecies(1e3, 0, 0.4));
    const Vector<double> half{1e-3, 2e-3, 3e-3}, at{4e-3, 0, 1e-3};
    scene.add({{1.2e-3, 2.2e-3, 3.2e-3}, 2e-4, toEigen(at), {0, 0, 0}, {0, 0, 0}, turnedBy(0.4, {1, 2, 2})});
    const auto& store = scene.particleHandler.store();
    const PolyData surface = shapeSurfaces(store, scene.superquadricHandler);
    const Axes<double> axes(store.bodies[0].orientation);
    EXPECT_EQ(surface.points.size(), 2u + 12 * 20);
    for (const Vector<double>& point : surface.points) {
        const Vector<double> p = axes.turnBack(point - at);
        const auto beyond = [](double x, double h) { return std::max(std::abs(x) - h, 0.0); };
        EXPECT_NEAR(norm(Vector<double>{beyond(p.x, half.x), beyond(p.y, half.y), beyond(p.z, half.z)}), 2e-4,
                    1e-12);
    }
}

TEST(BlockCollision, refusesWhatItDoesNotKnow) {
    const auto sentence = [](auto&& change) {
        FewBlocks scene(blockSpecies(1e3, 0, 0.4));
        scene.add({{1e-3, 1e-3, 2e-3}, 2e-4, {0, 0, 0}});
        return refusal([&] { change(scene), scene.initialise(); });
    };
    EXPECT_EQ(sentence([](FewBlocks&) {}), "");
    EXPECT_TRUE(contains(sentence([](FewBlocks& scene) {
                             scene.FewSuperquadrics::add({{1e-3, 1e-3, 1e-3, 4, 4}, {0.01, 0, 0}});
                         }),
                         "superquadrics cannot be in a scene with blocks"));
    const auto withCylinder = [&](CylinderSide side, double radius) {
        return sentence([&](FewBlocks& scene) {
            InfiniteCylinder wall;
            wall.set({0, 0, 1}, {side == CylinderSide::Inside ? 0 : 0.01, 0, 0}, radius, side);
            wall.setSpecies(scene.speciesHandler.getObject(0));
            scene.wallHandler.copyAndAddObject(wall);
        });
    };
    EXPECT_EQ(withCylinder(CylinderSide::Inside, 5e-3), "");
    EXPECT_TRUE(contains(withCylinder(CylinderSide::Outside, 5e-3), "blocks touch walls by their corners"));
    // A beam across the block: their cuboids, 1.8 and 0.8 mm high from the middle, meet at 2.6 mm.
    const auto crossed = [&](double height) {
        return sentence([&](FewBlocks& scene) {
            scene.add({{4e-3, 1e-3, 1e-3}, 2e-4, {0, 0.5e-3, height}});
        });
    };
    EXPECT_TRUE(contains(crossed(2.5e-3),
                         "rigid bodies 0 and 1, two blocks: they go through each other by "
                         "0.0001 m more"));
    EXPECT_EQ(crossed(2.995e-3), "");
    // A corner of one is in the other by half its radius.
    EXPECT_TRUE(contains(sentence([](FewBlocks& scene) {
                             scene.add({{1e-3, 1e-3, 1e-3}, 2e-4, {0.5e-3, 0, 2.9e-3}});
                         }),
                         "initial overlap"));
    EXPECT_EQ(sentence([](FewBlocks& scene) {
                  scene.add({{1e-3, 1e-3, 1e-3}, 2e-4, {0.5e-3, 0, 3e-3}});
              }),
              "");
    // The block is named, of whose grains nobody need know.
    const std::string atWall = sentence([](FewBlocks& scene) {
        scene.add({{1e-3, 1e-3, 1e-3}, 2e-4, {0.02, 0, -1.1e-3}});
        scene.addPlane({0, 0, -1}, {0, 0, -2e-3});
    });
    EXPECT_TRUE(contains(atWall, "rigid body 1 (its particle ")) << atWall;
    EXPECT_TRUE(contains(atWall, "and wall 0: initial overlap = 0.0001 m is 50 %")) << atWall;
}

}  // namespace
}  // namespace pendular::blockCollisionTest
