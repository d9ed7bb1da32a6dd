// Membranes in scenes that repeat themselves.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Foundation/State/Random.h"
#include "SelfTests/Membranes/MembraneScene.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::membranePeriodicTest {
namespace {

using namespace membraneTests;
using Point = Vector<double>;

constexpr int columns = 8, rows = 8;
const double height = 0.5 * std::sqrt(3.0) * edge, width = columns * edge, depth = rows * height;  // m

Point bent(const Point& p) {
    const double x = 2 * std::numbers::pi * p.x / width, y = 2 * std::numbers::pi * p.y / depth;
    return p +
           0.2 * edge *
               Point{std::sin(x + 0.3), std::cos(x - y), std::sin(2 * x + 0.7) * std::cos(y) + std::sin(y)};
}

std::vector<Point> bentVertices(const MembraneNet& net) {
    std::vector<Point> places;
    for (const Point& p : net.vertices()) places.push_back(bent(p));
    return places;
}

std::vector<Triangle> moved(std::vector<Triangle> triangles, const Point& by) {
    for (Triangle& triangle : triangles)
        for (Point& p : triangle) p += by;
    return triangles;
}

/// The force on the vertex that lies at a place of the net without force, and on all that move with it.
Point forceAt(const MembraneNet& net, std::span<const Point> forces, const Point& place) {
    const auto at = [&](const Point& p) { return norm(p - place) < 1e-6 * edge; };
    const std::size_t found =
        static_cast<std::size_t>(std::ranges::find_if(net.vertices(), at) - net.vertices().begin());
    std::size_t root = found;
    for (const MembraneNet::Copy& copy : net.copies())
        if (copy.vertex == found) root = copy.of;
    Point sum = forces[root];
    for (const MembraneNet::Copy& copy : net.copies())
        if (copy.of == root) sum += forces[copy.vertex];
    return sum;
}

/// Three by three sheets beside each other, as one net without any seam, know what the middle one feels.
TEST(PeriodicMembrane, hasTheForcesOfAnEndlessSheet) {
    const std::vector<Triangle> sheet = membranePeriodicSheet(columns, rows, edge);
    std::vector<Triangle> tiles;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (const Triangle& triangle : moved(sheet, {x * width, y * depth, 0}))
                tiles.push_back(triangle);
    const MembraneNet endless(tiles, rubber);
    MembraneNet joined(sheet, rubber);
    joined.joinAcross({width, depth, 0});
    EXPECT_TRUE(joined.isClosed());
    EXPECT_EQ(2 * joined.hinges().size(), 3 * sheet.size());
    const auto forcesOn = [](const MembraneNet& net) {
        std::vector<Point> forces(net.vertices().size(), Point{0, 0, 0});
        net.addElasticForces(bentVertices(net), forces);
        net.addPressureForces(bentVertices(net), 3000, forces);
        return forces;
    };
    const std::vector<Point> ofEndless = forcesOn(endless), ofJoined = forcesOn(joined);
    double largest = 0;
    for (const Point& force : ofEndless) largest = std::max(largest, norm(force));
    for (const Point& place : joined.vertices()) {
        const Point expected = forceAt(endless, ofEndless, place);
        EXPECT_LT(norm(forceAt(joined, ofJoined, place) - expected), 1e-12 * largest);
    }
}

/// Hinges bend a tube to a circle and would let go at a seam that they left out.
TEST(PeriodicMembrane, hasTheEnergyOfAnEndlessSheet) {
    const MembraneNet once = [] {
        MembraneNet net(membranePeriodicSheet(columns, rows, edge), rubber);
        net.joinAcross({width, depth, 0});
        return net;
    }();
    const MembraneNet twice = [] {
        MembraneNet net(membranePeriodicSheet(2 * columns, 2 * rows, edge), rubber);
        net.joinAcross({2 * width, 2 * depth, 0});
        return net;
    }();
    EXPECT_NEAR(4 * once.bendingEnergy(bentVertices(once)), twice.bendingEnergy(bentVertices(twice)),
                1e-12 * twice.bendingEnergy(bentVertices(twice)));
    EXPECT_NEAR(4 * once.stretchingEnergy(bentVertices(once)), twice.stretchingEnergy(bentVertices(twice)),
                1e-12 * twice.stretchingEnergy(bentVertices(twice)));
}

TEST(PeriodicMembrane, sidesThatRunInOppositeSensesAreRefused) {
    std::vector<Triangle> strips = membranePeriodicSheet(2, 2, edge);
    for (Triangle triangle : moved(strips, {6 * edge, 0, 0})) {
        std::swap(triangle[1], triangle[2]);
        strips.push_back(triangle);
    }
    MembraneNet net(strips, rubber);
    const std::string said = support::refusal([&] { net.joinAcross({8 * edge, 0, 0}); });
    EXPECT_TRUE(support::isOneSentence(said));
    EXPECT_TRUE(support::contains(said, "run in opposite senses"));
}

/// A scene of one period, its sheet held nowhere.
struct PeriodicScene : MembraneScene {
    explicit PeriodicScene(const std::vector<GrainMotion>& grains, double friction = 0.5)
        : MembraneScene(grains, 1e-5, material(2e-3, friction)) {
        setPeriodic(0, 0, width), setPeriodic(1, 0, depth);
        sheet = add(membranePeriodicSheet(columns, rows, edge));
        sheet->setPressure(20);
    }
    Membrane* sheet;
};

std::vector<GrainMotion> grainOver(double x, double y) {
    return {{.radius = radius,
             .position = {x + 0.3 * edge, y + 0.2 * edge, 1.02 * radius},
             .velocity = {0.31, 0.17, -0.4},
             .spin = {20, -10, 5}}};
}

/// Half a period is a vector of the lattice: a grain at the corner where both faces meet moves as one in the
/// middle, to the round-off of where it is.
TEST(PeriodicMembrane, aGrainAtItsFacesMovesAsInTheMiddle) {
    PeriodicScene atFaces(grainOver(-2e-3, -1e-3)),
        inMiddle(grainOver(0.5 * width - 2e-3, 0.5 * depth - 1e-3));
    atFaces.initialise(), inMiddle.initialise();
    for (int k = 0; k < 60; ++k) {
        atFaces.steps(50), inMiddle.steps(50);
        const GrainMotion a = atFaces.motion(0), b = inMiddle.motion(0);
        const Vec3D apart = a.position + Vec3D(0.5 * width, 0.5 * depth, 0) - b.position;
        EXPECT_LT(norm(atFaces.getPeriodicBox().nearest(toVector(apart))), 1e-9 * radius) << k;
        EXPECT_LT((a.velocity - b.velocity).norm(), 1e-9) << k;
        EXPECT_LT(radius * (a.spin - b.spin).norm(), 1e-9) << k;
    }
    EXPECT_GT(atFaces.motion(0).velocity.z(), 0.05);  // it has come off
    for (const MembraneNet::Copy& copy : atFaces.sheet->getNet().copies())
        EXPECT_EQ(atFaces.sheet->getPosition(copy.vertex),
                  Vec3D(atFaces.sheet->getPosition(copy.of) + toEigen(copy.shift)));
}

TEST(PeriodicMembrane, keepsMomentum) {
    std::vector<GrainMotion> grains = grainOver(-2e-3, -1e-3);
    grains.push_back(
        {.radius = radius, .position = {0.4 * width, depth, -1.02 * radius}, .velocity = {0, 0, 0.3}});
    PeriodicScene scene(grains);
    scene.sheet->setPressure(0);
    const auto momentum = [&] {
        Vec3D sum = scene.linearMomentum();
        for (std::size_t v = 0; v < scene.sheet->getHeld().size(); ++v)
            sum += scene.sheet->getNet().masses()[v] * scene.sheet->getVelocity(v);
        return sum;
    };
    const Vec3D before = momentum();
    scene.run(2000);
    EXPECT_GT(scene.motion(0).velocity.z(), 0);
    EXPECT_LT((momentum() - before).norm(), 1e-12 * grainMass);  // of a velocity of 1 m/s
}

/// Held along its free edges, not at its faces.
TEST(PeriodicMembrane, itsRimIsWhereItHasNoImage) {
    MembraneScene scene(grainOver(width / 2, depth / 2));
    scene.setPeriodic(0, 0, width);
    Membrane* const sheet = scene.add(membranePeriodicSheet(columns, rows, edge));
    sheet->holdRim();
    scene.initialise();
    for (std::size_t v = 0; v < sheet->getHeld().size(); ++v) {
        const double y = sheet->getPosition(v).y();
        EXPECT_EQ(sheet->getHeld()[v], y < 1e-9 || y > depth - 1e-9) << v;
    }
}

/// Edges that meet to round-off only, or to a part of the tolerance, are joined: a run goes on from its file.
/// Vertices at a side of the period, held as rim before they were joined, are held in the run by a call.
TEST(PeriodicMembrane, goesOnFromARestartFile) {
    for (const double slack : {0.0, 1e-7}) {
        SCOPED_TRACE(slack);
        const auto made = [&] {
            auto scene = std::make_unique<MembraneScene>(grainOver(width / 2, depth / 2));
            scene->setPeriodic(0, 1.2345e-3, 1.2345e-3 + width);
            const std::vector<Triangle> sheet = membranePeriodicSheet(columns, rows, (1 + slack) * edge);
            Membrane* const wall = scene->add(moved(sheet, {1.2345e-3, 0, 0}));
            wall->holdRim();
            wall->setPressure(20);
            return scene;
        };
        const auto sheetOf = [](MembraneScene& scene) {
            return static_cast<Membrane*>(&scene.wallHandler.getObject(0));
        };
        const auto holdASide = [&](MembraneScene& scene) {
            scene.steps(100);
            sheetOf(scene)->hold([](const Vec3D& p) { return p.x() < 1.2345e-3 + 0.6 * edge; });
            scene.steps(100);
        };
        const auto first = made(), resumed = made(), threaded = made();
        threaded->setNumberOfThreads(3);
        for (MembraneScene* scene : {first.get(), threaded.get()}) {
            scene->initialise();
            holdASide(*scene);
        }
        EXPECT_GT(sheetOf(*first)->getNet().copies().size(), 3u);
        const support::TestFolder folder;
        const auto fileOf = [&](MembraneScene& scene, const std::string& name) {
            scene.writeRestart(folder.path() / name);
            return folder.path() / name;
        };
        resumed->restartFrom(fileOf(*first, "half.h5"));
        resumed->run(300);
        first->steps(300), threaded->steps(300);
        const auto whole = fileOf(*first, "whole.h5");
        support::expectSameState(whole, fileOf(*resumed, "resumed.h5"));
        support::expectSameState(whole, fileOf(*threaded, "threaded.h5"));
        EXPECT_EQ(sheetOf(*first)->getHeld(), sheetOf(*resumed)->getHeld());
    }
}

/// The bound of the step is that of the joined net, also while a restart file is read, and when a grain comes
/// in the run.
TEST(PeriodicMembrane, bearsTheSameStepAfterARestart) {
    const support::TestFolder folder;
    const auto made = [&] {
        auto scene = std::make_unique<MembraneScene>(grainOver(width / 2, depth / 2));
        scene->setPeriodic(0, 0, width);
        static_cast<Membrane*>(scene->add(membranePeriodicSheet(columns, rows, edge)))->holdRim();
        scene->setTimeStep((1 - 1e-9) * scene->stabilityLimit());
        return scene;
    };
    const auto first = made(), resumed = made();
    first->run(20);
    first->writeRestart(folder.path() / "run.h5");
    resumed->restartFrom(folder.path() / "run.h5");
    resumed->run(20);
    SphericalParticle grain(resumed->speciesHandler.getObject(0));
    grain.setRadius(radius);
    grain.setPosition({width / 2, depth / 2, 20 * radius});
    resumed->particleHandler.copyAndAddObject(grain);
    EXPECT_NO_THROW(resumed->step());
}

/// Whichever of two sides that are joined is held, or held again with another velocity, both move so.
TEST(PeriodicMembrane, bothSidesMoveAsOneIsHeld) {
    PeriodicScene scene(grainOver(width / 2, depth / 2));
    scene.initialise();
    const auto holdAt = [&](double place, double speed) {
        scene.sheet->hold([&](const Vec3D& p) { return std::abs(p.x() - place) < 0.1 * edge; },
                          {0, 0, speed});
        scene.step();
        std::size_t held = 0;
        for (const MembraneNet::Copy& copy : scene.sheet->getNet().copies())
            for (const std::uint32_t v : {copy.vertex, copy.of})
                if (scene.sheet->getHeld()[v]) {
                    ++held;
                    EXPECT_EQ(scene.sheet->getVelocity(v), Vec3D(0, 0, speed)) << v;
                }
        EXPECT_GT(held, 4u);
    };
    holdAt(width, 0.1);
    holdAt(width, 0.2);
    holdAt(0, 0.3);
    holdAt(width, 0.4);
}

/// What was given is kept: without the period, or with another one, it is the same net again.
TEST(PeriodicMembrane, isAsItWasGivenWhenItIsJoinedNoMore) {
    const std::vector<Triangle> sheet = membranePeriodicSheet(columns, rows, (1 + 1e-6) * edge);
    const MembraneNet given(sheet, rubber);
    MembraneNet net = given;
    net.joinAcross({width, depth, 0});
    EXPECT_NE(net.vertices(), given.vertices());
    EXPECT_EQ(net.givenVertices(), given.vertices());
    for (const MembraneNet::Copy& copy : net.copies())
        EXPECT_EQ(net.vertices()[copy.vertex], net.vertices()[copy.of] + copy.shift);
    net.joinAcross({0, 0, 0});
    EXPECT_EQ(net.vertices(), given.vertices());
    EXPECT_EQ(net.springs().size(), given.springs().size());
}

/// A tube whose ends meet, under a pressure p: its length is kept by the period, so that it widens by
/// p R^2 (1 - nu^2) / (E t), and everywhere alike. The polygon of n sides is off by some (2 pi / n)^2.
TEST(PeriodicMembrane, aTubeWidensAlikeAtTheFaces) {
    constexpr int around = 40;
    constexpr double tubeRadius = 20e-3, pressure = 300;
    const double length = 12 * std::numbers::sqrt3 / 2 * 2 * tubeRadius * std::sin(std::numbers::pi / around);
    MembraneScene scene({{.radius = radius, .position = {0, 0, 0.3 * length}}});
    scene.setPeriodic(2, 0, length);
    Membrane* const tube = scene.add(membraneTube(tubeRadius, length, around));
    tube->setPressure(pressure);
    tube->setDamping(1500);
    scene.run(4000);
    const double expected =
        pressure * tubeRadius * tubeRadius * (1 - 1.0 / 9) / (rubber.youngsModulus * rubber.thickness);
    double least = infinity, most = 0;
    for (std::size_t v = 0; v < tube->getHeld().size(); ++v) {
        const Vec3D p = tube->getPosition(v);
        const double wider = std::hypot(p.x(), p.y()) - tubeRadius;
        least = std::min(least, wider), most = std::max(most, wider);
    }
    const double perSide = 2 * std::numbers::pi / around;
    EXPECT_NEAR(0.5 * (least + most), expected, expected * (perSide * perSide + expected / tubeRadius));
    EXPECT_LT(most - least, 1e-6 * expected);
}

}  // namespace
}  // namespace pendular::membranePeriodicTest
