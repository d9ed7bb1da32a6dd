#include <gtest/gtest.h>

#include <memory>

#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/BridgeLaws.h"
#include "SelfTests/Periodic/ThroughFaces.h"
#include "SelfTests/Support/Refusal.h"

// Which walls a periodic scene takes as they are, those that grains which go through a face see alike on both
// sides; which meshes it repeats; and which walls it refuses.

namespace pendular::periodic::wallEndsTest {
namespace {

using scenes::GrainMotion;

using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

constexpr double needed = r;  // m, from a face: so far a grain on it meets a wall

template <class S = Dry>
std::unique_ptr<ThroughFaces<S>> sceneWith(std::initializer_list<int> axes = {0},
                                           const S& species = scenes::boxMaterial<S>(0)) {
    return std::make_unique<ThroughFaces<S>>(
        std::vector<GrainMotion>{{.radius = r, .position = {0.5 * length, 0.5 * length, 0.4 * length}}}, axes,
        species);
}

/// What a scene with a wall is refused with.
template <class Shape>
std::string refusalOf(const Shape& wall, std::initializer_list<int> axes = {0}) {
    auto scene = sceneWith<>(axes);
    scene->add(wall);
    return support::refusal([&] { scene->initialise(); });
}

/// Whether the scene repeats a mesh, because it is not alike at both faces.
bool isRepeated(const TriangleWall& wall, std::initializer_list<int> axes = {0}) {
    auto scene = sceneWith<>(axes);
    const TriangleWall* const added = scene->add(wall);
    scene->initialise();
    return added->isRepeated();
}

/// Whether it repeats a floor in 12 strips.
bool isFloorRepeated(
    double lowest, double highest, const std::function<double(double)>& z = [](double) { return 0.0; }) {
    return isRepeated(meshOf(strips(lowest, highest, 12, z)));
}

TEST(WallEnds, aMeshThatGoesOnBeyondBothFacesAsFarAsGrainsMeetItIsTakenAsItIs) {
    for (const double beyond : {needed * 1.002, 1.5 * r, 2 * r, 0.4 * length, 3 * length})
        EXPECT_FALSE(isFloorRepeated(-beyond, length + beyond)) << beyond / r;
    // Exactly at the faces, and a little beyond, where the former code let grains fall in silence.
    for (const double beyond : {0.0, 1e-9 * r, 0.5 * r, 0.9 * r, 0.999 * needed}) {
        EXPECT_TRUE(isFloorRepeated(-beyond, length + 2 * r));
        EXPECT_TRUE(isFloorRepeated(-2 * r, length + beyond));
    }
}

TEST(WallEnds, aMeshWithinTheSceneMayEndWhereNoGrainMeetsItThroughAFace) {
    EXPECT_FALSE(isFloorRepeated(1.01 * needed, length - 1.01 * needed));
    EXPECT_FALSE(isFloorRepeated(0.4 * length, 0.6 * length));
    EXPECT_TRUE(isFloorRepeated(length + 1.01 * needed, 1.5 * length)) << "it is within, a period away";
    EXPECT_TRUE(isFloorRepeated(-0.5 * length, -1.01 * needed)) << "it is within, a period away";
    for (const auto& [lowest, highest] : {std::pair{0.99 * needed, 0.5 * length},
                                          {0.5 * length, length - 0.5 * r},
                                          {0.5 * length, length + 2 * r},
                                          {-2 * r, 0.5 * length},
                                          {-2 * r, -0.5 * r}})
        EXPECT_TRUE(isFloorRepeated(lowest, highest)) << lowest / r << " to " << highest / r;
}

TEST(WallEnds, aMeshIsTakenAsItIsWhereItIsAlikeAtBothFaces) {
    const auto wave = [](double length) {
        return [length](double x) { return 0.3 * r * std::cos(2 * std::numbers::pi * x / length); };
    };
    // 22 strips of a sixteenth of the period: three go on beyond each face.
    const auto isWaveRepeated = [&](double waveLength) {
        return isRepeated(meshOf(strips(-0.1875 * length, 1.1875 * length, 22, wave(waveLength))));
    };
    EXPECT_FALSE(isWaveRepeated(length));
    EXPECT_FALSE(isWaveRepeated(length / 4));
    for (const auto& z : std::initializer_list<std::function<double(double)>>{
             wave(1.1 * length), [](double x) { return 0.1 * x; },
             [](double x) { return x < 0.5 * length ? 0 : 1e-3 * r; }})
        EXPECT_TRUE(isFloorRepeated(-2 * r, length + 2 * r, z));
    // Rounded to single precision it still is alike.
    EXPECT_FALSE(
        isFloorRepeated(-2 * r, length + 2 * r, [](double x) { return 6e-8 * std::sin(1e9 * x) * length; }));
    // A hole of half a radius at one of the faces.
    std::vector<Triangle> floor = strips(-2 * r, length - 0.75 * r, 5, [](double) { return 0.0; });
    const std::vector<Triangle> rest =
        strips(length - 0.25 * r, length + 2 * r, 1, [](double) { return 0.0; });
    floor.insert(floor.end(), rest.begin(), rest.end());
    EXPECT_TRUE(isRepeated(meshOf(floor)));
}

/// In a corner of two faces, too.
TEST(WallEnds, alongEachPeriodOfTwo) {
    const auto isPavingRepeated = [](double lowest, double highest, std::initializer_list<int> axes) {
        return isRepeated(meshOf(paving(lowest, highest)), axes);
    };
    EXPECT_FALSE(isPavingRepeated(-2 * r, length + 2 * r, {0, 1}));
    EXPECT_FALSE(isPavingRepeated(3 * r, length - 3 * r, {0, 1}));
    EXPECT_TRUE(isPavingRepeated(-2 * r, length + 0.9 * r, {0, 1}));
    // The floor is as wide as the scene along y, which is enough unless it repeats itself along y.
    std::vector<Triangle> narrow = strips(
        -2 * r, length + 2 * r, 12, [](double) { return 0.0; }, 1.5 * length);
    EXPECT_FALSE(isRepeated(meshOf(narrow), {0, 1}));
    narrow = strips(
        -2 * r, length + 2 * r, 12, [](double) { return 0.0; }, length + 0.5 * r);
    EXPECT_FALSE(isRepeated(meshOf(narrow), {0}));
    EXPECT_TRUE(isRepeated(meshOf(narrow), {0, 1}));
}

TEST(WallEnds, surfacesOfRevolution) {
    const auto tube = [](const Vec3D& axis, double lowest, double highest, bool isStraight = true) {
        AxisymmetricWall wall;
        std::vector<ProfilePoint> profile;
        for (int k = 0; k <= 12; ++k)
            profile.push_back({isStraight || k < 6 ? 4 * r : 3.9 * r, lowest + k * (highest - lowest) / 12});
        wall.set(axis, {0, 0.5 * length, 0.4 * length}, profile);
        return wall;
    };
    for (const double sign : {1.0, -1.0}) {
        const auto along = [&](double lowest, double highest, bool isStraight = true) {
            return refusalOf(
                tube({sign, 0, 0}, sign > 0 ? lowest : -highest, sign > 0 ? highest : -lowest, isStraight));
        };
        EXPECT_EQ(along(-2 * r, length + 2 * r), "");
        EXPECT_EQ(along(3 * r, length - 3 * r), "");
        EXPECT_TRUE(
            support::contains(along(-2 * r, length + 0.9 * r), "wall 0 ends at x = 0.016525 m, 0.0009 m"));
        EXPECT_TRUE(support::contains(along(0, length), "wall 0 ends at x"));
        EXPECT_TRUE(support::contains(along(-2 * r, length + 2 * r, false), "is not the same"));
    }
    // Across, and inclined: within the scene only.
    const auto across = [](const Vec3D& axis, double x) {
        AxisymmetricWall wall;
        wall.set(axis, {x, 0.5 * length, 0.4 * length}, {{4 * r, -r}, {3 * r, r}});
        return refusalOf(wall);
    };
    EXPECT_EQ(across({0, 0, 1}, 0.5 * length), "");
    EXPECT_EQ(across({1, 0, 1}, 0.5 * length), "");
    for (const Vec3D& axis : {Vec3D(0, 0, 1), Vec3D(1, 0, 1)})
        EXPECT_TRUE(support::contains(across(axis, 0), "wall 0 is not the same after a period"));
    EXPECT_TRUE(
        support::contains(across({0, 0, 1}, 4.5 * r), "wall 0 begins at x = 0.0005 m, 0.0005 m before"));
}

TEST(WallEnds, bridgesAreMetFromFarther) {
    Wet species = scenes::boxMaterial<Wet>(0);
    species.setLiquidBridgeVolume(0.01 * r * r * r);
    species.setContactAngle(0.2);
    species.setSurfaceTension(0.07);
    const double range = species.range({r, infinity});
    ASSERT_GT(range, 0.2 * r);
    for (const double spare : {-0.01 * r, 0.01 * r}) {
        auto scene = sceneWith<Wet>({0}, species);
        scene->add(meshOf(strips(-needed - range - spare, length + needed + range + spare, 12,
                                 [](double) { return 0.0; })));
        scene->initialise();
        EXPECT_EQ(scene->wallHandler.getObject(0).isRepeated(), spare < 0);
    }
}

TEST(WallEnds, planesAndCylindersWithoutEnds) {
    const auto plane = [](const Vec3D& normal, const Vec3D& point) {
        InfiniteWall wall;
        wall.set(normal, point);
        return wall;
    };
    const auto cylinder = [](const Vec3D& axis, double radius, CylinderSide side) {
        InfiniteCylinder wall;
        wall.set(axis, {0.5 * length, 0.5 * length, 0.4 * length}, radius, side);
        return wall;
    };
    EXPECT_EQ(refusalOf(plane({0, 0, -1}, {0, 0, 0})), "");
    EXPECT_EQ(refusalOf(cylinder({1, 0, 0}, 3 * r, CylinderSide::Inside)), "");
    EXPECT_EQ(refusalOf(cylinder({0, 1, 0}, 3 * r, CylinderSide::Inside)), "");
    // Across the period: between grains that are neighbours through the face.
    EXPECT_EQ(refusalOf(plane({1, 0, 0}, {length - 2 * r, 0, 0})), "");
    EXPECT_TRUE(support::contains(refusalOf(plane({1, 0, 0}, {length, 0, 0})), "wall 0 ends at x"));
    EXPECT_TRUE(support::contains(refusalOf(plane({-1, 0, 0}, {0, 0, 0})), "wall 0 begins at x"));
    EXPECT_TRUE(support::contains(refusalOf(cylinder({0, 1, 0}, 0.45 * length, CylinderSide::Inside)),
                                  "wall 0 ends at x"));
}

/// The error of a run.
template <class S>
std::string endOf(ThroughFaces<S>& scene, int steps) {
    scene.initialise();
    try {
        scene.steps(steps);
    } catch (const RunError& error) {
        return error.what();
    }
    return {};
}

/// It falls off the plane where it goes out uphill, and comes to lie below it the other way.
TEST(WallEnds, aGrainThatComesToWhereAnInclinedPlaneDoesNotFitEndsTheRun) {
    for (const double way : {1.0, -1.0}) {
        const double x = (0.5 + 0.45 * way) * length, slope = 0.1;
        auto scene = std::make_unique<ThroughFaces<Dry>>(
            std::vector<GrainMotion>{{.radius = r,
                                      .position = {x, 0.5 * length, slope * x + 1.004 * r},
                                      .velocity = {way, 0, slope * way}}},
            std::initializer_list<int>{0});
        InfiniteWall plane;
        plane.set({slope, 0, -1}, {0, 0, 0});
        scene->add(plane);
        const std::string text = endOf(*scene, 1000);
        EXPECT_TRUE(support::isOneSentence(text));
        EXPECT_TRUE(support::contains(text, "particle 0 goes through a face"));
        EXPECT_TRUE(support::contains(text, "wall 0"));
    }
}

/// The time (s) at which the scene begins to repeat its wall; 0 if it does not.
double timeOfRepetition(ThroughFaces<Dry>& scene, int steps) {
    scene.initialise();
    for (int k = 0; k < steps; ++k) {
        scene.steps(1);
        if (scene.wallHandler.getObject(0).isRepeated()) return scene.getTime();
    }
    return 0;
}

TEST(WallEnds, wallsThatMoveAreFollowed) {
    const auto flat = [](double) { return 0.0; };
    {  // along the period, until it ends too near
        auto scene = sceneWith<>();
        TriangleWall floor = meshOf(strips(-2 * r, length + 2 * r, 12, flat));
        floor.setVelocity({0.1, 0, 0});
        scene->add(floor);
        EXPECT_NEAR(timeOfRepetition(*scene, 3000), 0.8 * r / 0.1, 2 * timeStep);
    }
    {  // to and fro
        auto scene = sceneWith<>();
        TriangleWall floor = meshOf(strips(-2 * r, length + 2 * r, 12, flat));
        floor.setMotion([](double t) {
            return Eigen::Isometry3d(Eigen::Translation3d(0.7 * r * std::sin(500 * t), 0, 0));
        });
        scene->add(floor);
        EXPECT_EQ(timeOfRepetition(*scene, 4000), 0);
    }
    {  // about the axis of the period, and across it
        auto scene = sceneWith<>();
        TriangleWall floor = meshOf(strips(-2 * r, length + 2 * r, 12, flat));
        floor.setAngularVelocity({50, 0, 0}, {0, 0.5 * length, -4 * r});
        scene->add(floor);
        EXPECT_EQ(timeOfRepetition(*scene, 1000), 0);
        auto tilting = sceneWith<>();
        TriangleWall tilted = meshOf(strips(-2 * r, length + 2 * r, 12, flat));
        tilted.setAngularVelocity({0, 1, 0}, {0, 0, 0});
        tilting->add(tilted);
        EXPECT_GT(timeOfRepetition(*tilting, 1000), 0);
    }
    {  // a paddle that comes to a face
        auto scene = sceneWith<>();
        TriangleWall paddle = meshOf(strips(3 * r, 5 * r, 2, flat));
        paddle.setVelocity({-0.5, 0, 0});
        scene->add(paddle);
        EXPECT_NEAR(timeOfRepetition(*scene, 3000), 1.8 * r / 0.5, 2 * timeStep);
    }
    {  // another shape cannot be repeated: the run ends
        auto scene = sceneWith<>();
        AxisymmetricWall tube;
        tube.set({1, 0, 0}, {0, 0.5 * length, 0.4 * length}, {{4 * r, -2 * r}, {4 * r, length + 2 * r}});
        tube.setVelocity({0.1, 0, 0});
        scene->add(tube);
        const std::string text = endOf(*scene, 3000);
        EXPECT_TRUE(support::isOneSentence(text)) << text;
        EXPECT_TRUE(support::contains(text, "wall 0 begins at x = -0.00119"));
        EXPECT_NEAR(scene->getTime(), 0.8 * r / 0.1, 2 * timeStep);
    }
}

TEST(WallEnds, whatComesInTheRunIsLookedAt) {
    const auto flat = [](double) { return 0.0; };
    for (const double beyond : {0.9 * r, 2 * r}) {  // a wall
        auto scene = sceneWith<>();
        scene->hook = [&](auto& s) {
            if (s.getNumberOfTimeSteps() == 10)
                static_cast<ThroughFaces<Dry>&>(s).add(meshOf(strips(-beyond, length + beyond, 12, flat)));
        };
        EXPECT_EQ(endOf(*scene, 20), "");
        EXPECT_EQ(scene->wallHandler.getObject(0).isRepeated(), beyond < needed);
    }
    for (const double radius : {r, 1.7 * r}) {  // a grain that reaches farther
        auto scene = sceneWith<>();
        scene->add(meshOf(strips(-1.5 * r, length + 1.5 * r, 12, flat)));
        scene->hook = [&](auto& s) {
            if (s.getNumberOfTimeSteps() == 10)
                s.particleHandler.copyAndAddObject(s.grain(radius, {0.5 * length, 0.1 * length, 3 * r}));
        };
        EXPECT_EQ(endOf(*scene, 20), "");
        EXPECT_EQ(scene->wallHandler.getObject(0).isRepeated(), radius > r);
    }
    // A grain that is put outside is brought back at once, and may not overlap what is there.
    for (const double height : {0.5 * r, r}) {
        auto scene = sceneWith<>();
        scene->add(meshOf(strips(-2 * r, length + 2 * r, 12, flat)));
        scene->hook = [&](auto& s) {
            if (s.getNumberOfTimeSteps() == 10)
                s.particleHandler.copyAndAddObject(s.grain(r, {3.25 * length, 0.1 * length, height}));
        };
        const std::string text = endOf(*scene, 20);
        if (height < r) EXPECT_TRUE(support::contains(text, "initial overlap"));
        else EXPECT_NEAR(scene->motion(1).position.x(), 0.25 * length, 1e-12);
    }
}

TEST(WallEnds, aMeshWhoseVerticesMoveAtAFaceIsRepeated) {
    for (const double beyond : {2 * r, -3 * r}) {
        TriangleWall floor = meshOf(strips(-beyond, length + beyond, 12, [](double) { return 0.0; }));
        floor.keepWear(WearLaw::archard(1e-3, 1e9), {.interval = 0.01, .acceleration = 1});
        EXPECT_EQ(isRepeated(floor), beyond > 0);
    }
}

}  // namespace
}  // namespace pendular::periodic::wallEndsTest
