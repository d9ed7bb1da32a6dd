// Membranes and grains in one scene.
#include <gtest/gtest.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Membranes/MembraneScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::sceneTest {
namespace {

using namespace membraneTests;
using Point = Vector<double>;

/// Force and torque of what the corners get are those of the force at the point and the couple.
TEST(Membrane, cornersGetTheForceAndTheTorqueOfAContact) {
    UniformRandom random(5);
    const auto any = [&](double size) {
        return Point{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    for (int trial = 0; trial < 1000; ++trial) {
        const std::array<Point, 3> x{any(1), any(1), any(1)};
        const double area = norm(cross(x[1] - x[0], x[2] - x[0]));
        if (area < 0.1) continue;
        const double s = random.uniform(0, 1), t = random.uniform(0, 1 - s);
        const Point point = x[0] + s * (x[1] - x[0]) + t * (x[2] - x[0]), force = any(1), couple = any(1);
        const auto shares = TriangleWeights(x[0], x[1], x[2], point).forces(force, couple);
        Point sum{0, 0, 0}, torque{0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k) sum += shares[k], torque += cross(x[k] - point, shares[k]);
        EXPECT_LT(norm(sum - force), 1e-14 / area);  // gradients are of the size 1 / height
        EXPECT_LT(norm(torque - couple), 1e-13 / area);
    }
}

/// Held everywhere, a membrane is a rigid wall of its triangles: the same bits.
TEST(Membrane, heldIsARigidWallBitForBit) {
    MembraneScene soft(fallingGrains()), rigid(fallingGrains());
    soft.add(wavySheet())->hold([](const Vec3D&) { return true; });
    TriangleWall wall;
    wall.set(wavySheet());
    ASSERT_EQ(wall.getNumberOfParts(), wavySheet().size());
    rigid.add(wall);
    for (MembraneScene* scene : {&soft, &rigid}) {
        scene->setGravity({0, 0, -9.81});
        scene->run(4000);
    }
    EXPECT_GT(rigid.contacts().store().buckets.size(), 0U);
    EXPECT_LT(rigid.motion(0).velocity.norm(), 1.0);
    EXPECT_EQ(stateHash(soft.particleHandler.store()), stateHash(rigid.particleHandler.store()));
}

/// And one that moves steadily: to the round-off of where it is, which grows with the steps and with each
/// touch.
TEST(Membrane, heldAndMovedIsARigidWallThatMoves) {
    MembraneScene soft(fallingGrains()), rigid(fallingGrains());
    soft.add(wavySheet())->hold([](const Vec3D&) { return true; }, {0.02, -0.01, 0.05});
    TriangleWall wall;
    wall.set(wavySheet());
    wall.setVelocity({0.02, -0.01, 0.05});
    rigid.add(wall);
    for (MembraneScene* scene : {&soft, &rigid}) {
        scene->setGravity({0, 0, -9.81});
        scene->run(2000);
    }
    for (std::size_t k = 0; k < 9; ++k)
        EXPECT_LT((soft.motion(k).position - rigid.motion(k).position).norm(), 1e-9 * radius) << k;
}

/// A grain lies on a sheet that hangs from its rim: in the mean over a time T the sheet bears its weight, but
/// for its change of momentum, (grain mass) x (change of velocity) / T.
TEST(Membrane, bearsTheWeightOfAGrain) {
    const double middle = 5 * edge, weight = 9.81 * grainMass;
    MembraneScene scene(
        {{.radius = radius, .position = {middle, std::sqrt(3.0) / 2 * 4 * edge, radius + 1e-5}}});
    Membrane* const sheet = scene.add(membraneSheet(10, 8, edge));
    sheet->holdRim();
    sheet->setDamping(300);
    scene.setGravity({0, 0, -9.81});
    scene.run(10000);
    EXPECT_LT(scene.motion(0).position.z(), 0.9 * radius);  // it hangs
    const double before = scene.motion(0).velocity.z();
    Point sum{0, 0, 0};
    constexpr int count = 5000;
    for (int k = 0; k < count; ++k) {
        scene.step();
        for (const Point& force : sheet->state().ofGrains) sum += (1.0 / count) * force;
    }
    const double change = grainMass * (scene.motion(0).velocity.z() - before) / (count * 1e-5);
    EXPECT_LT(std::abs(change), 0.05 * weight);
    // The sums of the integrator weigh the first and the last step by a half: 1/count of the force.
    EXPECT_NEAR(-sum.z, weight + change, 2.0 / count * weight);
}

/// Grains meet a sheet that nothing holds: what they lose of momentum and angular momentum it has.
TEST(Membrane, keepsMomentumAndAngularMomentum) {
    std::vector<GrainMotion> grains = fallingGrains();
    for (GrainMotion& grain : grains) grain.velocity.z() -= 0.2;
    MembraneScene scene(grains);
    const Membrane* const sheet = scene.add(wavySheet());
    const auto momentum = [&] {
        Vec3D sum = scene.linearMomentum();
        for (std::size_t v = 0; v < sheet->getHeld().size(); ++v)
            sum += sheet->getNet().masses()[v] * sheet->getVelocity(v);
        return sum;
    };
    const auto angular = [&] {
        Vec3D sum = scene.angularMomentum();
        for (std::size_t v = 0; v < sheet->getHeld().size(); ++v)
            sum += sheet->getNet().masses()[v] * sheet->getPosition(v).cross(sheet->getVelocity(v));
        return sum;
    };
    const Vec3D before = momentum(), turn = angular();
    scene.run(1500);
    double given = 0;
    for (std::size_t v = 0; v < sheet->getHeld().size(); ++v)
        given += sheet->getNet().masses()[v] * sheet->getVelocity(v).norm();
    ASSERT_GT(given, 0.01 * before.norm());
    EXPECT_LT((momentum() - before).norm(), 1e-12 * before.norm());
    EXPECT_LT((angular() - turn).norm(), 1e-12 * before.norm() * 24e-3);
}

/// With friction the error has a part that stays: the couple of a tangential force about the nearest point,
/// half the overlap away, works on the spin of a triangle, which contacts do not see.
TEST(Membrane, energyLedgerClosesToRoundOffAndItsErrorFallsWithTheStep) {
    const auto errorOf = [](double step, double friction, const Integrator& integrator) {
        Trampoline scene(step, friction);
        scene.setIntegrator(integrator);
        scene.keepEnergyLedger();
        scene.run(0);
        const double first = scene.energyLedger().closed();
        double largest = 0, size = 0;
        for (int k = 0; k < std::lround(0.012 / step); ++k) {
            scene.step();
            const EnergyLedger& ledger = scene.energyLedger();
            largest = std::max(largest, std::abs(scene.energyUnaccountedFor()));
            size = std::max({size, ledger.kinetic + ledger.membraneElastic, std::abs(ledger.pressures)});
            EXPECT_NEAR(ledger.closed(), first, 1e-12 * (size + std::abs(ledger.potential)));
        }
        const EnergyLedger& ledger = scene.energyLedger();
        EXPECT_GT(ledger.membranes, 1e-3 * size);
        EXPECT_GT(ledger.membraneElastic, 1e-2 * size);
        EXPECT_GT(ledger.membraneDamping, 1e-4 * size);
        EXPECT_GT(std::abs(ledger.pressures), 1e-2 * size);
        EXPECT_GT(std::abs(ledger.walls), 1e-3 * size);  // the rim
        return largest / size;
    };
    for (const Integrator& integrator : integrators::all) {
        const double coarse = errorOf(1e-5, 0, integrator), fine = errorOf(2.5e-6, 0, integrator);
        // 1/16 of second order; 1/4 where velocities are those of the middle of a step.
        EXPECT_LT(fine, 0.35 * coarse) << integrator.name;
        EXPECT_LT(fine, 1e-3) << integrator.name;
    }
    // The work of that couple is at most friction x overlap / 2 x the turn of a triangle: 1e-3 of a bounce
    // for overlaps of a hundredth of the radius and turns of 0.2.
    EXPECT_LT(errorOf(1e-5, 0.5, integrators::predictedVelocityVerlet), 1e-3);
}

TEST(Membrane, bitsDoNotDependOnThreadsAndRestarts) {
    const support::TestFolder folder;
    const std::string file = folder.name() + ".h5";
    Trampoline whole;
    whole.run(1200);
    whole.sheet->setPressure(-30);
    whole.particleHandler.removeObject(4);
    whole.writeRestart(file);
    whole.steps(800);
    for (const int threads : {1, 3}) {
        Trampoline resumed;
        resumed.setNumberOfThreads(threads);
        resumed.restartFrom(file);
        resumed.initialise();
        resumed.steps(800);
        EXPECT_EQ(wholeHash(resumed), wholeHash(whole)) << threads;
    }
    Trampoline threaded;
    threaded.setNumberOfThreads(3);
    threaded.run(1200);
    threaded.sheet->setPressure(-30);
    threaded.particleHandler.removeObject(4);
    threaded.steps(800);
    EXPECT_EQ(wholeHash(threaded), wholeHash(whole));
    MembraneScene other(fallingGrains());
    MembraneMaterial stiff = rubber;
    stiff.youngsModulus *= 2;
    other.add(wavySheet(), stiff);
    other.setGravity({0, 0, -9.81});
    other.restartFrom(file);
    EXPECT_TRUE(support::contains(support::refusal([&] { other.initialise(); }), "youngsModulus"));
}

/// Without grains the limit is 0.9 x 2 / omega, omega^2 = 6 k / m = 6 E / (rho edge^2): of that net, 0.816
/// edge sqrt(rho / E). At 0.99 of the limit a sheet keeps its energy; above the exact one it would not.
TEST(Membrane, stabilityLimitIsThatOfItsNet) {
    const auto sheetOf = [](double step, bool accept) {
        auto scene = std::make_unique<MembraneScene>(std::vector<GrainMotion>{}, step);
        scene->setIntegrator(integrators::velocityVerlet);
        scene->acceptUnstableTimeStep(accept);
        scene->add(membraneSheet(12, 12, edge))->hold([](const Vec3D& x) {
            return x.x() < 0.6 * edge || x.x() > 11.4 * edge || x.y() < 1e-9 || x.y() > 10.3 * edge;
        });
        return scene;
    };
    const double limit = sheetOf(1e-6, false)->stabilityLimit();
    const double closed = 0.9 * 2 / std::sqrt(6 * rubber.youngsModulus / rubber.density) * edge;
    EXPECT_NEAR(limit, closed, 0.03 * closed);  // the half triangles at the sides are held on one side
    const std::string refused = support::refusal([&] { sheetOf(1.05 * limit, false)->initialise(); });
    EXPECT_TRUE(support::isOneSentence(refused));
    EXPECT_TRUE(support::contains(refused, "a membrane: its springs and hinges"));
    const auto grows = [&](double step) {
        auto scene = sheetOf(step, true);
        auto* sheet = scene->wallHandler.getObject(0).membrane();
        sheet->setPressure(1e-3);
        scene->initialise();
        try {
            scene->steps(20000);
        } catch (const RunError&) {
            return true;
        }
        return false;
    };
    EXPECT_FALSE(grows(0.99 * limit));
    EXPECT_TRUE(grows(1.15 * limit));
}

/// Light vertices under grains need a shorter step than either alone.
TEST(Membrane, stabilityLimitKnowsTheGrainsOnIt) {
    MembraneScene grains(fallingGrains()), both(fallingGrains());
    MembraneMaterial thin = rubber;
    thin.thickness = 3e-6, thin.youngsModulus = 1e4;
    both.add(wavySheet(), thin)->holdRim();
    EXPECT_LT(both.stabilityLimit(), 0.3 * grains.stabilityLimit());
    // A grain on each side of a vertex that is much lighter than they: omega^2 is at least 2 k / M.
    MembraneScene elastic(fallingGrains(), 1e-5, material(0, 0));
    elastic.setIntegrator(integrators::velocityVerlet);
    Membrane* const sheet = elastic.add(wavySheet(), thin);
    sheet->holdRim();
    EXPECT_LT(elastic.stabilityLimit(), 0.9 * 2 / std::sqrt(2 * 200 / sheet->lightestVertex()));
}

TEST(Membrane, aTriangleThatCollapsesEndsTheRun) {
    MembraneScene scene({});
    Membrane* const sheet = scene.add(membraneSheet(6, 6, edge));
    sheet->hold([](const Vec3D& x) { return x.y() < 1e-9; });
    sheet->hold([](const Vec3D& x) { return x.y() > 5 * edge; }, {0, -1, 0});
    scene.initialise();
    try {
        scene.steps(2000);
        FAIL() << "it was pressed to nothing";
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what()));
        EXPECT_TRUE(support::contains(error.what(), "triangle "));
        EXPECT_TRUE(support::contains(error.what(), "wall 0, a membrane"));
    }
}

TEST(Membrane, refusesWhatItCannotDo) {
    const auto refusalOf = [](auto&& action) { return support::refusal(action); };
    Membrane unset;
    EXPECT_TRUE(support::contains(refusalOf([&] { unset.holdRim(); }), "free edges"));
    EXPECT_TRUE(support::contains(refusalOf([&] { unset.setPressure(std::nan("")); }), "pressure"));
    EXPECT_TRUE(support::contains(refusalOf([&] { unset.setDamping(-1); }), "damping"));
    EXPECT_TRUE(support::contains(refusalOf([&] { static_cast<void>(unset.getNet()); }), "call set()"));
    EXPECT_TRUE(support::contains(refusalOf([&] { static_cast<void>(unset.getVolume()); }), "call set()"));
    EXPECT_TRUE(
        support::contains(refusalOf([&] { static_cast<void>(unset.getElasticEnergy()); }), "call set()"));
    MembraneScene scene(fallingGrains());
    EXPECT_TRUE(support::contains(refusalOf([&] { scene.add(unset); }), "place is not set"));
    Membrane* const sheet = scene.add(wavySheet());
    EXPECT_TRUE(support::contains(refusalOf([&] { sheet->hold([](const Vec3D&) { return false; }); }),
                                  "none of its vertices"));
    scene.setAdaptiveTimeStep(0.5);
    EXPECT_TRUE(support::contains(refusalOf([&] { scene.initialise(); }), "membranes"));
    MembraneScene sheared(fallingGrains());
    sheared.add(wavySheet());
    for (int axis = 0; axis < 3; ++axis) sheared.setPeriodic(axis, -0.05, 0.05);
    sheared.setLeesEdwards(0, 2, 1);
    EXPECT_TRUE(support::contains(refusalOf([&] { sheared.initialise(); }), "and walls cannot be combined"));
}

TEST(Membrane, isDrawnAsItIs) {
    Trampoline scene;
    scene.run(500);
    const WallSurface drawn = surfacesOf(scene.wallHandler, {0, 0, 0}, {1e-2, 1e-2, 1e-2}).at(0);
    const auto& triangles = scene.sheet->getNet().triangles();
    ASSERT_EQ(drawn.polygons.size(), triangles.size());
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(drawn.polygons[t][k], scene.sheet->state().position[triangles[t][k]]);
    EXPECT_GT(drawn.polygons[0][0].z, 1e-4);  // the rim has moved up
}

}  // namespace
}  // namespace pendular::sceneTest
