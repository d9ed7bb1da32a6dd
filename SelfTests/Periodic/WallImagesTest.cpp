#include "Kernel/Core/Walls/WallImages.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Periodic/PavedFloor.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// A mesh that ends anywhere in a periodic scene stands there again after each period.

namespace pendular::periodic::floors::wallImagesTest {
namespace {

/// Meshes of one period that begin somewhere, and one of two periods; none of them goes on beyond both faces.
const std::vector<Floor>& floors() {
    static const std::vector<Floor> all{{true, 0, length},
                                        {true, 0.37 * length, 1.37 * length},
                                        {true, -0.81 * length, 0.19 * length},
                                        {true, 3 * length, 4 * length},
                                        {true, -5.5 * length, -4.5 * length},
                                        {true, 0.25 * length, 2.25 * length}};
    return all;
}

template <class S>
class WallImages : public testing::Test {};
using SpeciesOfAllKinds = testing::Types<Smooth, Dry, Wet, Migrating>;
TYPED_TEST_SUITE(WallImages, SpeciesOfAllKinds);

TYPED_TEST(WallImages, aFloorOfOnePeriodIsThePlane) {
    for (const Floor& floor : floors()) {
        SCOPED_TRACE(floor.lowest / length);
        auto found = onFloor<TypeParam>(floor), expected = onFloor<TypeParam>({false});
        found->initialise();
        expected->initialise();
        EXPECT_TRUE(found->wallHandler.getObject(0).isRepeated());
        const double closedBefore = found->energyLedger().closed(),
                     kineticBefore = found->energyLedger().kinetic;
        for (int k = 0; k < 15; ++k) {
            found->steps(500);
            expected->steps(500);
            EXPECT_NEAR(found->wallHandler.getObject(0).getForce().z(),
                        expected->wallHandler.getObject(0).getForce().z(), 1e-6);
        }
        EXPECT_GT(found->crossings, 5);
        expectSameMotion(*found, *expected, roundOff);
        EXPECT_EQ(found->heard.size(), expected->heard.size());
        EXPECT_NEAR(found->energyLedger().closed(), closedBefore, 1e-11 * kineticBefore);
        if constexpr (requires(TypeParam s) { s.setLiquidBridgeVolumeMax(1.0); }) {
            EXPECT_EQ(found->liquidLedger().unaccounted(), 0);
            EXPECT_EQ(found->liquidLedger().bridges, expected->liquidLedger().bridges);
        }
    }
}

/// The mesh goes three periods away, and its images with it.
TYPED_TEST(WallImages, aFloorThatMovesIsThePlaneThatMoves) {
    constexpr int steps = 8000;
    const Vec3D velocity(-3 * length / (steps * timeStep), 0.2, 0.003);
    auto found = onFloor<TypeParam>({true, 0, length, velocity}),
         expected = onFloor<TypeParam>({false, 0, 0, velocity});
    found->initialise();
    expected->initialise();
    found->steps(steps);
    expected->steps(steps);
    EXPECT_GT(found->crossings, 5);
    expectSameMotion(*found, *expected, roundOff);
}

TYPED_TEST(WallImages, restartsAtAFaceHaveTheSameBits) {
    const support::TestFolder folder;
    const Floor floor{true, 0.37 * length, 1.37 * length};
    auto first = onFloor<TypeParam>(floor);
    first->initialise();
    while (first->crossings < 3) first->steps(1);
    const std::size_t at = first->getNumberOfTimeSteps();
    auto whole = onFloor<TypeParam>(floor);
    whole->initialise();
    while (whole->getNumberOfTimeSteps() < at + 1) {
        whole->steps(1);
        const std::size_t step = whole->getNumberOfTimeSteps();
        if (step + 2 >= at) whole->writeRestart(folder.path() / (std::to_string(step) + ".h5"));
    }
    whole->steps(1000);
    for (std::size_t step = at - 2; step <= at + 1; ++step) {
        auto half = onFloor<TypeParam>(floor, step % 2 == 0 ? 3 : 1);
        half->restartFrom(folder.path() / (std::to_string(step) + ".h5"));
        half->initialise();
        while (half->getNumberOfTimeSteps() < whole->getNumberOfTimeSteps()) half->step();
        EXPECT_EQ(stateHash(half->particleHandler.store()), stateHash(whole->particleHandler.store()))
            << "from " << step;
    }
}

/// It becomes one that is repeated in the run, and so it is after a restart, though it is alike at both faces
/// again.
TEST(WallImages, aFloorThatShakesGoesOnAfterARestart) {
    const support::TestFolder folder;
    const auto file = folder.path() / "shaking.h5";
    const auto make = [] {
        auto scene = std::make_unique<ThroughFaces<Dry>>(rollingGrains(), std::initializer_list<int>{0, 1});
        TriangleWall floor = meshOf(paving(-1.3 * r, length + 1.3 * r));
        floor.setMotion(
            [](double t) { return Eigen::Isometry3d(Eigen::Translation3d(r * std::sin(2000 * t), 0, 0)); });
        scene->add(floor);
        return scene;
    };
    auto whole = make();
    whole->initialise();
    EXPECT_FALSE(whole->wallHandler.getObject(0).isRepeated());
    const auto half = static_cast<int>(std::numbers::pi / 2000 / timeStep);
    whole->steps(half);
    EXPECT_TRUE(whole->wallHandler.getObject(0).isRepeated());
    whole->writeRestart(file);
    whole->steps(3000);
    EXPECT_GT(whole->crossings, 1);
    auto second = make();
    second->restartFrom(file);
    second->initialise();
    second->steps(3000);
    EXPECT_EQ(stateHash(second->particleHandler.store()), stateHash(whole->particleHandler.store()));
}

TEST(WallImages, clumpsRollOnThem) {
    auto found = clumpsOnFloor({true, 0, length}), expected = clumpsOnFloor({false});
    EXPECT_GT(found->crossings, 4);
    expectSameMotion(*found, *expected, roundOff);
}

/// A floor with a hole of a few grains at the faces, from whose edges grains fall: in a long scene there are
/// as many floors as grains come to.
TYPED_TEST(WallImages, anEdgeIsAnEdge) {
    const auto make = [&](bool isPeriodic) {
        const std::vector<GrainMotion> grains{
            {.radius = r, .position = {0.6 * length, 0.5 * length, 1.02 * r}, .velocity = {0.8, 0, 0}},
            {.radius = r, .position = {0.5 * length, 0.1 * length, 1.3 * r}, .velocity = {2.5, 0.1, 0}}};
        auto scene = filmedGrains<TypeParam>(grains, {});
        if (isPeriodic) scene->setPeriodic(0, 0, length);
        std::vector<Triangle> floor;
        for (int k = 0; k < (isPeriodic ? 1 : 9); ++k) {
            const auto one = strips((k + 0.07) * length, (k + 0.97) * length, 7, [](double) { return 0.0; });
            floor.insert(floor.end(), one.begin(), one.end());
        }
        scene->add(meshOf(floor));
        scene->initialise();
        scene->steps(6000);
        return scene;
    };
    auto found = make(true), expected = make(false);
    EXPECT_GT(found->crossings, 2);
    expectSameMotion(*found, *expected, 100 * roundOff);
}

/// A wave of half a period beyond the box.
TYPED_TEST(WallImages, aWaveThatBeginsAnywhereIsALongOne) {
    auto found = overWaves<TypeParam>(waves(0.5 * length, 1.5 * length, 16), true, 12000),
         expected = overWaves<TypeParam>(waves(-length, 8 * length, 144), false, 12000);
    EXPECT_GT(found->crossings, 2);
    expectSameMotion(*found, *expected, 100 * roundOff);
}

/// A grain that lies on an image: the torque is that of a grain on the wall itself, a period farther.
TEST(WallImages, torqueIsAboutThePointOfTheImage) {
    ThroughFaces<Dry> scene({{.radius = r, .position = {0.25 * length, 0.4 * length, 0.999 * r}}}, {0, 1});
    TriangleWall* const floor = scene.add(meshOf(paving(0.5 * length, 1.5 * length)));
    const Vec3D about(0.75 * length, 0.75 * length, 0.2 * r);
    floor->keepForces(true, about);
    scene.initialise();
    scene.steps(10);
    const double force = floor->getForce().z();
    ASSERT_LT(force, 0);
    // It lies at x = 1.25 and y = 1.4 periods of the wall.
    EXPECT_NEAR(floor->getTorque().x(), (1.4 - 0.75) * length * force, 1e-12 * length * std::abs(force));
    EXPECT_NEAR(floor->getTorque().y(), -(1.25 - 0.75) * length * force, 1e-12 * length * std::abs(force));
}

/// Wear is that of the triangle, whichever of its images is worn.
TEST(WallImages, wearIsThatOfTheTriangles) {
    const auto worn = [](double lowest) {
        ThroughFaces<Dry> scene(
            {{.radius = r, .position = {0.5 * length, 0, 0.999 * r}, .velocity = {2, 0.3, 0}}}, {0, 1});
        TriangleWall floor = meshOf(strips(
            lowest, lowest + length, 4, [](double) { return 0.0; }, length / 2));
        floor.keepWear(WearLaw::archard(1e-3, 1e9));
        TriangleWall* const added = scene.add(floor);
        scene.keepEnergyLedger();
        scene.initialise();
        scene.steps(6000);
        EXPECT_GT(scene.crossings, 2);
        std::vector<double> work;
        for (std::size_t t = 0; t < 8; ++t) work.push_back(added->getWear().of(t).slidingWork);
        return work;
    };
    // A quarter of the period farther, its triangles lie a strip (two triangles) farther.
    const std::vector<double> here = worn(0), there = worn(0.25 * length), twice = worn(2 * length);
    double sum = 0;
    for (const double work : here) sum += work;
    ASSERT_GT(sum, 0);
    for (std::size_t t = 0; t < 8; ++t) {
        EXPECT_NEAR(here[(t + 2) % 8], there[t], 1e-6 * sum) << t;
        EXPECT_NEAR(here[t], twice[t], 1e-6 * sum) << t;
    }
}

TEST(WallImages, tooLongAMeshIsRefused) {
    for (const double periods : {3.9, 4.1}) {
        ThroughFaces<Dry> scene({{.radius = r, .position = {0.5 * length, 0, 2 * r}}}, {0});
        scene.add(meshOf(strips(0.5 * length, (0.5 + periods) * length, 4,
                                [](double x) { return x < length ? 0.0 : -0.1 * r; })));
        const std::string text = support::refusal([&] { scene.initialise(); });
        EXPECT_EQ(text.empty(), periods < 4) << text;
        if (text.empty()) continue;
        EXPECT_TRUE(support::isOneSentence(text)) << text;
        EXPECT_TRUE(support::contains(text, "m long along x"));
    }
}

/// A wall that is taken from one scene to another one is repeated with that one.
TEST(WallImages, areThoseOfTheScene) {
    TriangleWall floor;
    {
        ThroughFaces<Dry> scene(rollingGrains(), {0, 1});
        const TriangleWall* const added = scene.add(meshOf(paving(0, length)));
        scene.initialise();
        ASSERT_TRUE(added->isRepeated());
        floor = *added;
    }
    ThroughFaces<Dry> open({{.radius = r, .position = {0.5 * length, 0, 2 * r}}}, {});
    const TriangleWall* const added = open.add(floor);
    open.initialise();
    EXPECT_FALSE(added->isRepeated());
}

/// Every number of an image that a grain can meet comes back from the bits of its parts.
TEST(WallImages, partsTellTheirImages) {
    pendular::WallImages images;
    const Vector<double> periods{2, 3, 0};
    images.repeat(periods);
    const SurroundingBox box{.middle = {100, -50, 1}, .half = {4, 6, 1}};  // four periods long
    for (const double x : {-7.3, 0.0, 1.99, 55.5})
        for (const double y : {-30.2, 0.1, 2.9}) {
            const Vector<double> point{x, y, 1.5};
            int count = 0;
            images.forEachWithin(point, 0.9, box, [&](const Vector<double>& shift, std::uint32_t image) {
                ++count;
                EXPECT_EQ(images.shiftOf(image | 77u, point, box), shift);
                EXPECT_EQ(pendular::WallImages::partOf(image | 77u), 77u);
                const Vector<double> way{-2 * periods.x, periods.y, 0};
                const std::uint32_t after = images.partAfter(way, image | 77u);
                EXPECT_EQ(images.shiftOf(after, point + way, box), shift + way);
            });
            EXPECT_GE(count, 16);
        }
}

}  // namespace
}  // namespace pendular::periodic::floors::wallImagesTest
