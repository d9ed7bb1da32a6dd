// Walls whose vertices another program moves.
#include "Kernel/Features/Membranes/HostWall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "SelfTests/Membranes/MembraneScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::hostWallTest {
namespace {

using namespace membraneTests;
using Corners = HostWall::Corners;

/// The wavy sheet as a host has it: by vertices and their numbers.
HostWall wavyHostWall() {
    const MembraneNet net(wavySheet(), rubber);
    std::vector<Vec3D> vertices;
    for (const Vector<double>& vertex : net.vertices()) vertices.push_back(toEigen(vertex));
    HostWall wall;
    wall.set(vertices, net.triangles());
    return wall;
}

std::vector<GrainMotion> fastGrains() {
    std::vector<GrainMotion> grains = fallingGrains();
    for (GrainMotion& grain : grains) grain.velocity.z() -= 0.3;
    return grains;
}

double sizeOfForces(const HostWall& wall) {
    double sum = 0;
    for (const Vec3D& force : wall.getForces()) sum += force.norm();
    return sum;
}

/// A host that knows what it wants: the sheet bends in time, along all axes.
std::vector<Vec3D> bentVelocities(const HostWall& wall, double time) {
    std::vector<Vec3D> velocities;
    for (const Vec3D& place : wall.getPositions())
        velocities.emplace_back(0.03 * std::sin(400 * time + 200 * place.y()),
                                0.02 * std::cos(300 * time) + 2 * place.x(),
                                0.15 * std::sin(300 * place.x() + 500 * time) - 0.05);
    return velocities;
}

/// At rest it is a rigid wall of its triangles: the same bits.
TEST(HostWall, atRestIsARigidWallBitForBit) {
    MembraneScene hosted(fallingGrains()), rigid(fallingGrains());
    const HostWall* const sheet = hosted.add(wavyHostWall());
    TriangleWall wall;
    wall.set(wavySheet());
    rigid.add(wall);
    double force = 0;
    for (MembraneScene* scene : {&hosted, &rigid}) {
        scene->setGravity({0, 0, -9.81});
        scene->initialise();
        for (int k = 0; k < 4000; ++k) {
            scene->step();
            force = std::max(force, sizeOfForces(*sheet));
        }
    }
    EXPECT_GT(force, 1e-3);
    EXPECT_EQ(stateHash(hosted.particleHandler.store()), stateHash(rigid.particleHandler.store()));
}

/// What the vertices get the grains lose, and what the host gives is what the ledger has: over each interval
/// of seven steps the sum of impulse . velocity, and in each step that of the mean force over the way.
TEST(HostWall, worksAsMuchAsTheLedgerHas) {
    MembraneScene scene(fastGrains(), 5e-6);
    HostWall* const wall = scene.add(wavyHostWall());
    scene.keepEnergyLedger();
    scene.initialise();
    const double closed = scene.energyLedger().closed();
    const std::size_t count = wall->getNumberOfVertices();
    double work = 0, ofImpulses = 0, moved = 0;
    Vec3D given = Vec3D::Zero();
    const Vec3D before = scene.linearMomentum();
    for (int interval = 0; interval < 300; ++interval) {
        wall->setVelocities(bentVelocities(*wall, scene.getTime()));
        for (int k = 0; k < 7; ++k) {
            const std::vector<Vec3D> force = wall->getForces(), place = wall->getPositions();
            scene.step();
            for (std::size_t v = 0; v < count; ++v) {
                const double one =
                    0.5 * (force[v] + wall->getForces()[v]).dot(wall->getPositions()[v] - place[v]);
                work += one;
                moved += std::abs(one);
            }
        }
        const std::vector<Vec3D> impulses = wall->getImpulses(), velocities = wall->getVelocities();
        for (std::size_t v = 0; v < count; ++v)
            ofImpulses += impulses[v].dot(velocities[v]), given += impulses[v];
        ASSERT_NEAR(scene.energyLedger().walls, -work, 1e-12 * moved) << interval;
        ASSERT_NEAR(ofImpulses, work, 1e-12 * moved) << interval;
    }
    EXPECT_GT(moved, 1e-6);
    const double sizeOfMomentum = given.norm() + before.norm();
    EXPECT_GT(given.norm(), 0.1 * before.norm());
    EXPECT_LT((scene.linearMomentum() - before + given).norm(), 1e-12 * sizeOfMomentum);
    EXPECT_NEAR(scene.energyLedger().closed(), closed, 1e-12 * moved);
    // With friction the couple of a tangential force half the overlap away works on the turn of a triangle.
    EXPECT_LT(std::abs(scene.energyUnaccountedFor()), 2e-3 * moved);
}

/// A plate that slides along z without friction, of this mass (kg), as a host computes it from the impulses
/// of `stride` steps. It gives its velocity for the next ones.
struct PlateHost {
    double mass, speed = 0, work = 0;  // kg, m/s, J

    void exchange(HostWall& wall) {
        double impulse = 0;
        for (const Vec3D& each : wall.getImpulses()) impulse += each.z();
        speed += impulse / mass;
        wall.setVelocities(std::vector<Vec3D>(wall.getNumberOfVertices(), {0, 0, speed}));
    }
};

/// An elastic ball and a plate at rest: (m - M)/(m + M) and 2 m/(m + M) of its speed. The plate follows by
/// an interval late, so that energy is off in proportion to it.
TEST(HostWall, collidesAsAPlateOfItsHost) {
    const auto collide = [](int stride) {
        const double speed = 0.2, mass = 0.7 * grainMass;
        MembraneScene scene(
            {{.radius = radius, .position = {0.011, 0.009, radius + 1e-5}, .velocity = {0, 0, -speed}}}, 1e-6,
            material(0, 0));
        HostWall flat;
        const MembraneNet net(membraneSheet(10, 10, edge), rubber);
        std::vector<Vec3D> vertices;
        for (const Vector<double>& vertex : net.vertices()) vertices.push_back(toEigen(vertex));
        flat.set(vertices, net.triangles());
        HostWall* const wall = scene.add(flat);
        PlateHost host{mass};
        scene.initialise();
        for (int k = 0; k < 20000; ++k) {
            scene.step();
            if (k % stride == stride - 1) host.exchange(*wall);
        }
        const double ball = scene.motion(0).velocity.z();
        EXPECT_NEAR(grainMass * ball + mass * host.speed, -grainMass * speed, 1e-12 * grainMass * speed);
        EXPECT_NEAR(ball / -speed, (grainMass - mass) / (grainMass + mass), 0.02 * stride / 16);
        const double before = grainMass * speed * speed,
                     after = grainMass * ball * ball + mass * host.speed * host.speed;
        return std::abs(after - before) / before;
    };
    const double once = collide(4), twice = collide(8), four = collide(16);
    EXPECT_LT(once, 1e-2);
    EXPECT_GT(once, 1e-6);
    EXPECT_NEAR(twice / once, 2, 0.1);
    EXPECT_NEAR(four / once, 4, 0.4);
}

/// A scene with a host whose own state is in the restart file.
struct Coupled : MembraneScene {
    Coupled() : MembraneScene(fastGrains()) {
        wall = add(wavyHostWall());
        setGravity({0, 0, -9.81});
    }
    HostWall* wall;
    PlateHost host{20 * grainMass};
    std::size_t exchanges = 0;

    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 5 != 0) return;
        host.exchange(*wall);
        ++exchanges;
    }
    void visitState(StateArchive& archive) override {
        archive.value("speed", host.speed);
        archive.value("exchanges", exchanges);
    }
    std::uint64_t hash() {
        std::uint64_t value = stateHash(particleHandler.store());
        for (const auto& column : {wall->getPositions(), wall->getVelocities(), wall->getImpulses()})
            for (const Vec3D& p : column)
                for (const double number : {p.x(), p.y(), p.z()})
                    value = (value ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001b3u;
        return (value ^ std::bit_cast<std::uint64_t>(host.speed)) * 0x100000001b3u;
    }
};

/// Both sides, written in the middle of contacts and of an interval, and for any number of threads.
TEST(HostWall, goesOnBitForBitWithItsHost) {
    const support::TestFolder folder;
    const std::string file = folder.name() + ".h5";
    Coupled whole;
    whole.initialise();
    while (sizeOfForces(*whole.wall) == 0 && whole.getNumberOfTimeSteps() < 3000) whole.step();
    whole.steps(4);
    if (whole.getNumberOfTimeSteps() % 5 == 0) whole.step();
    ASSERT_GT(sizeOfForces(*whole.wall), 0);
    whole.writeRestart(file);
    whole.steps(800);
    for (const int threads : {1, 3}) {
        Coupled resumed;
        resumed.setNumberOfThreads(threads);
        resumed.restartFrom(file);
        resumed.initialise();
        resumed.steps(800);
        EXPECT_EQ(resumed.exchanges, whole.exchanges);
        EXPECT_EQ(resumed.hash(), whole.hash()) << threads;
    }
}

TEST(HostWall, isThereAtTheTimeThatWasAsked) {
    MembraneScene scene({});
    HostWall* const wall = scene.add(wavyHostWall());
    scene.initialise();
    std::vector<Vec3D> places = wall->getPositions();
    for (std::size_t v = 0; v < places.size(); ++v)
        places[v] += Vec3D(1e-4, -2e-4, 1e-4 * std::sin(double(v)));
    wall->setTargets(places, 40 * scene.getTimeStep());
    scene.steps(40);
    for (std::size_t v = 0; v < places.size(); ++v)
        EXPECT_LT((wall->getPositions()[v] - places[v]).norm(), 1e-15);
}

TEST(HostWall, readsAFileAndSpeaksOfItself) {
    const support::TestFolder folder;
    const auto path = folder.path() / "sheet.csv";
    {
        std::ofstream file(path);
        file.precision(17);
        for (const Triangle& t : membraneSheet(3, 3, 2.0)) {
            for (const Vector<double>& p : t) file << p.x << ' ' << p.y << ' ' << p.z << ' ';
            file << '\n';
        }
    }
    HostWall wall;
    wall.read(path, 1e-3);
    EXPECT_EQ(wall.getNet().triangles().size(), membraneSheet(3, 3, 2e-3).size());
    EXPECT_EQ(wall.getNumberOfVertices(), MembraneNet(membraneSheet(3, 3, 2e-3), rubber).vertices().size());
}

std::string refusalOf(const std::vector<Vec3D>& vertices, const std::vector<Corners>& triangles) {
    HostWall wall;
    const std::string text = support::refusal([&] { wall.set(vertices, triangles); });
    EXPECT_TRUE(support::isOneSentence(text));
    EXPECT_TRUE(support::contains(text, "HostWall: "));
    return text;
}

TEST(HostWall, refusesWhatCannotBe) {
    const std::vector<Vec3D> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_TRUE(support::contains(refusalOf(square, {{0, 1, 2}}), "vertex 3 is a corner of no triangle"));
    EXPECT_TRUE(support::contains(refusalOf(square, {{0, 1, 2}, {0, 2, 4}}), "has the corner 4"));
    EXPECT_TRUE(support::contains(refusalOf(square, {{0, 1, 2}, {2, 0, 3}, {0, 2, 1}}), "share an edge"));
    EXPECT_TRUE(support::contains(refusalOf(square, {{0, 1, 2}, {0, 3, 2}}), "opposite senses"));
    EXPECT_TRUE(support::contains(refusalOf(square, {{0, 1, 1}, {0, 2, 3}}), "has no area"));
    EXPECT_TRUE(support::contains(refusalOf({}, {}), "no triangles"));
    std::vector<Vec3D> broken = square;
    broken[2].y() = std::nan("");
    EXPECT_TRUE(support::contains(refusalOf(broken, {{0, 1, 2}, {0, 2, 3}}), "coordinate"));

    HostWall wall;
    EXPECT_TRUE(support::contains(support::refusal([&] { wall.setVelocities(square); }), "call set()"));
    wall.set(square, std::vector<Corners>{{0, 1, 2}, {0, 2, 3}});
    const auto refusedMove = [&](const std::vector<Vec3D>& places, double time) {
        const std::string text = support::refusal([&] { wall.setTargets(places, time); });
        EXPECT_TRUE(support::isOneSentence(text));
        return text;
    };
    EXPECT_TRUE(support::contains(refusedMove({{0, 0, 0}}, 1), "1 places for 4 vertices"));
    EXPECT_TRUE(support::contains(refusedMove(square, 0), "time"));
    EXPECT_TRUE(support::contains(refusedMove(broken, 1), "place of vertex 2"));
    EXPECT_FALSE(wall.getVelocities()[2].norm() > 0);  // as it was
}

TEST(HostWall, endsTheRunWhereItsHostFoldsIt) {
    MembraneScene scene({});
    HostWall* const wall = scene.add(wavyHostWall());
    scene.initialise();
    std::vector<Vec3D> places = wall->getPositions();
    for (Vec3D& place : places) place.y() *= 1e-3;
    wall->setTargets(places, 0.02);
    try {
        scene.steps(2000);
        FAIL() << "it was pressed to nothing";
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what()));
        EXPECT_TRUE(support::contains(error.what(), "the host must keep its triangles open"));
    }
}

}  // namespace
}  // namespace pendular::hostWallTest
