#include <gtest/gtest.h>

#include "BuildFolders.h"
#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/SharedData.h"
#include "SelfTests/Walls/WallScene.h"

namespace pendular::meshTest {
namespace {

using namespace wallTests;
using scenes::GrainMotion;
using support::contains;
using support::Random;

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

InfiniteWall plane(const Vec3D& normal, const Vec3D& point) {
    InfiniteWall wall;
    wall.set(normal, point);
    return wall;
}

/// A plate of n x n squares (side a) in z = 0 with the square (i, j) = (1, 1) missing, so that it is not
/// convex.
std::vector<Triangle> plateWithHole(int n, double a) {
    std::vector<Triangle> result;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            if (i != 1 || j != 1)
                append(result, parallelogram(at(i * a, j * a, 0), at(a, 0, 0), at(0, a, 0)));
    return result;
}

/// The mantle of a prism of n sides about y, between y = 0 and y = length; its corners lie on a circle.
std::vector<Triangle> prism(int n, double size, double length) {
    std::vector<Triangle> result;
    for (int k = 0; k < n; ++k) {
        const double a = 2 * std::numbers::pi * k / n, b = 2 * std::numbers::pi * ((k + 1) % n) / n;
        const Vector<double> p = at(size * std::cos(a), 0, size * std::sin(a)),
                             q = at(size * std::cos(b), 0, size * std::sin(b));
        append(result, parallelogram(p, q - p, at(0, length, 0)));
    }
    return result;
}

double bruteDistance(const std::vector<Triangle>& triangles, const Vector<double>& centre) {
    double least = infinity;
    for (const Triangle& t : triangles)
        least = std::min(least, pointsFor(mesh({t}), centre, 1e3).at(0).distance);
    return least;
}

TEST(MeshParts, coplanarTrianglesMerge) {
    EXPECT_EQ(mesh(parallelogram(at(0, 0, 0), at(1, 0.2, 0), at(0, 1, 0.3), 30, 20)).getNumberOfParts(), 1u);
    EXPECT_EQ(mesh(box(at(0, 0, 0), at(1, 2, 3), 5)).getNumberOfParts(), 6u);
    EXPECT_EQ(mesh(prism(60, 1, 2)).getNumberOfParts(), 60u);
    const TriangleWall plate = mesh(plateWithHole(8, 0.1));
    EXPECT_EQ(plate.getNumberOfTriangles(), 126u);
    EXPECT_LE(plate.getNumberOfParts(), 20u);  // 4 would do
    EXPECT_GT(plate.getNumberOfParts(), 1u);
}

TEST(MeshParts, ofAPublishedDrumAreItsFacets) {
    if (!support::hasSharedData("drum38k-walls.txt"))
        GTEST_SKIP() << support::withoutSharedData("drum38k-walls.txt");
    const std::filesystem::path drum = support::sharedData("drum38k-walls.txt");
    TriangleWall wall;
    wall.read(drum);
    EXPECT_LT(wall.getNumberOfParts(), wall.getNumberOfTriangles() / 2);
}

TEST(MeshParts, trianglesWithoutAreaAndRepeatedOnesAreLeftOut) {
    auto triangles = box(at(0, 0, 0), at(1, 1, 1));
    triangles.push_back({at(0, 0, 0), at(1, 0, 0), at(0.5, 0, 0)});
    triangles.push_back({triangles[3][1], triangles[3][0], triangles[3][2]});
    const TriangleWall wall = mesh(triangles);
    EXPECT_EQ(wall.getNumberOfTriangles(), 12u);
    EXPECT_EQ(wall.getNumberLeftOut(), 2u);
    EXPECT_EQ(wall.getNumberOfParts(), 6u);
}

TEST(MeshParts, nearestPointsAreThoseOfTheSingleTriangles) {
    Random random(1);
    std::vector<Triangle> heap;
    for (int k = 0; k < 40; ++k) {
        const auto p = toVector(random.inCube(0.6));
        heap.push_back({p, p + toVector(random.inCube(0.3)), p + toVector(random.inCube(0.3))});
    }
    for (const auto& triangles :
         {plateWithHole(6, 0.2), box(at(0, 0, 0), at(1, 1, 1), 3), prism(20, 0.8, 1), heap}) {
        const TriangleWall wall = mesh(triangles);
        for (int k = 0; k < 300; ++k) {
            const auto centre = toVector(random.inCube(1.3));
            double least = infinity;
            for (const WallPoint& p : pointsFor(wall, centre, 2)) least = std::min(least, p.distance);
            const double expected = bruteDistance(triangles, centre);
            if (expected < 2) {
                EXPECT_NEAR(least, expected, 1e-14);
            }
        }
    }
}

TEST(MeshEdges, convexEdgesAndCornersCountOnce) {
    const TriangleWall wall = mesh(box(at(0, 0, 0), at(1, 1, 1), 3));
    Random random(2);
    for (int k = 0; k < 2000; ++k) {  // anywhere outside the box
        const auto centre = toVector(Vec3D(random.inCube(0.9) + Vec3D(0.5, 0.5, 0.5)));
        const bool inside =
            std::min({centre.x, centre.y, centre.z}) > 0 && std::max({centre.x, centre.y, centre.z}) < 1;
        if (inside) continue;
        const double distance = bruteDistance(box(at(0, 0, 0), at(1, 1, 1)), centre);
        const auto points = pointsFor(wall, centre, distance + 0.05);
        ASSERT_EQ(points.size(), 1u);
        EXPECT_NEAR(points[0].distance, distance, 1e-14);
    }
}

TEST(MeshEdges, aConcaveCornerOfThreeFacesHasThreeContacts) {
    const TriangleWall wall = mesh(box(at(0, 0, 0), at(1, 1, 1), 4));
    EXPECT_EQ(pointsFor(wall, at(0.1, 0.1, 0.1), 0.11).size(), 3u);
    EXPECT_EQ(pointsFor(wall, at(0.1, 0.5, 0.1), 0.11).size(), 2u);
    EXPECT_EQ(pointsFor(wall, at(0.3, 0.5, 0.1), 0.11).size(), 1u);
    for (const WallPoint& p : pointsFor(wall, at(0.1, 0.1, 0.1), 0.11)) EXPECT_NEAR(p.distance, 0.1, 1e-15);
}

TEST(MeshEdges, aGrainInAHoleRestsOnAllItsRims) {
    EXPECT_EQ(pointsFor(mesh(plateWithHole(5, 0.1)), at(0.15, 0.15, 0.02), 0.06).size(), 4u);
}

TEST(MeshEdges, edgesOfSmallAngleCountOnceFromBothSides) {
    const TriangleWall wall = mesh(prism(60, 1, 1));
    Random random(3);
    for (int k = 0; k < 2000; ++k) {
        const double angle = random.uniform(0, 2 * std::numbers::pi), r = k % 2 == 0 ? 0.9 : 1.1;
        const auto points = pointsFor(wall, at(r * std::cos(angle), 0.5, r * std::sin(angle)), 0.13);
        ASSERT_EQ(points.size(), 1u);
        EXPECT_NEAR(points[0].distance, 0.1, 0.0015);  // the sagitta is 1 - cos(pi/60) = 0.0014
    }
}

TEST(MeshEdges, aGrainInAShallowPrismThatTouchesTwoSidesHasTwoContacts) {
    // A sphere almost as large as a prism of 24 sides: neighbours are smooth, opposite sides are not.
    EXPECT_EQ(pointsFor(mesh(prism(24, 1, 4)), at(0, 2, 0), 1.0).size() > 1, true);
}

TEST(MeshEdges, theNormalForceDoesNotJumpOverSmallAngles) {
    // Rolling in a drum of 60 facets: the overlap is continuous, the direction turns by at most 6 degrees.
    const TriangleWall wall = mesh(prism(60, 1, 1));
    double last = -1;
    Vector<double> lastNormal{0, 0, 0};
    for (double angle = 0; angle < 1; angle += 1e-4) {
        const auto points = pointsFor(wall, at(0.95 * std::cos(angle), 0.5, 0.95 * std::sin(angle)), 0.06);
        ASSERT_EQ(points.size(), 1u);
        if (last > 0) {
            EXPECT_LT(std::abs(points[0].distance - last), 0.06 * 1e-4);  // sin(3 degrees) of the way
            EXPECT_GT(dot(points[0].normal, lastNormal), std::cos(0.1048));
        }
        last = points[0].distance;
        lastNormal = points[0].normal;
    }
}

GrainMotion bouncer() {
    return {.radius = radius,
            .position = {3.3e-3, 4.1e-3, 5.2e-3},
            .velocity = {0.31, -0.23, 0.17},
            .spin = {100, 50, -80}};
}

TEST(MeshBox, isSixPlanes) {
    // A closed box of right angles: also in its edges and corners only faces are met.
    const double a = 8e-3;
    WallScene<Dry> planes({bouncer()}, material<Dry>(0.95)), meshed({bouncer()}, material<Dry>(0.95));
    for (int axis = 0; axis < 3; ++axis)
        for (double side : {-1.0, 1.0})
            planes.add(plane(side * Vec3D::Unit(axis), side > 0 ? Vec3D(a, a, a) : Vec3D::Zero()));
    meshed.add(mesh(box(at(0, 0, 0), at(a, a, a), 3)));
    planes.initialise();
    meshed.initialise();
    int touches = 0;
    for (int k = 0; k < 40000; ++k) {
        planes.step();
        meshed.step();
        touches += planes.touching();
    }
    EXPECT_GT(touches, 300);
    // Overlaps of 1e-5 m are rounded to 1e-18 m: 1e-13 of each impulse, some tens of collisions, and their
    // growth.
    EXPECT_LT((planes.motion(0).velocity - meshed.motion(0).velocity).norm(), 1e-10);
    EXPECT_LT((planes.motion(0).position - meshed.motion(0).position).norm(), 1e-11);
    EXPECT_LT((planes.motion(0).spin - meshed.motion(0).spin).norm(), 1e-7);
}

template <class S>
S wetOrDry() {
    S species = material<S>();
    if constexpr (S::Adhesion::acts) {
        species.setLiquidBridgeVolume(1e-11);
        species.setContactAngle(0.2);
        species.setSurfaceTension(0.07);
    }
    return species;
}

/// A grain that slides, then rolls, over a coplanar mesh and over a plane; the largest difference of their
/// velocities.
template <class S>
void expectRollsAsOnAPlane(const std::vector<Triangle>& triangles, const Vec3D& start, const Vec3D& velocity,
                           double tolerance) {
    const GrainMotion grain{.radius = radius, .position = start, .velocity = velocity, .spin = {0, 100, 30}};
    const Vec3D gravity{0, 0, -9.81};
    WallScene<S> smooth({grain}, wetOrDry<S>(), gravity), meshed({grain}, wetOrDry<S>(), gravity);
    smooth.add(plane({0, 0, -1}, {0, 0, 0}));
    meshed.add(mesh(triangles));
    smooth.initialise();
    meshed.initialise();
    double worst = 0;
    for (int k = 0; k < 20000; ++k) {
        smooth.step();
        meshed.step();
        ASSERT_EQ(smooth.touching(), meshed.touching()) << "step " << k;
        worst = std::max(worst, (smooth.motion(0).velocity - meshed.motion(0).velocity).norm());
    }
    EXPECT_GT((smooth.motion(0).position - start).norm(), 10 * radius);
    EXPECT_LT(worst, tolerance);
}

template <class S>
class RollingOverEdges : public testing::Test {};
using BothSpecies = testing::Types<Dry, Wet>;
TYPED_TEST_SUITE(RollingOverEdges, BothSpecies);

// Heights are rounded to 1e-19 m, the overlap at rest is 3e-7 m; a velocity of 0.3 m/s is told to 1e-12 of
// it.
constexpr double rollingTolerance = 3e-13;  // m/s
const Vec3D rollingStart{2.05e-3, 2.2e-3, radius - 2e-7}, rollingVelocity{0.3, 0.07, 0};

TYPED_TEST(RollingOverEdges, feelsNoneWhereTrianglesMerge) {
    expectRollsAsOnAPlane<TypeParam>(parallelogram(at(0, 0, 0), at(0.05, 0, 0), at(0, 0.02, 0), 100, 40),
                                     rollingStart, rollingVelocity, rollingTolerance);
}

TYPED_TEST(RollingOverEdges, feelsNoneWhereTheyDoNot) {
    // The missing square lies behind; the plate falls into many convex parts, and the contact passes from one
    // to the next.
    std::vector<Triangle> plate = plateWithHole(80, 0.6e-3);
    ASSERT_GT(mesh(plate).getNumberOfParts(), 1u);
    expectRollsAsOnAPlane<TypeParam>(plate, rollingStart, rollingVelocity, rollingTolerance);
    // Rows of bricks: corners lie within the edges of the next row, no two rows share an edge.
    std::vector<Triangle> bricks;
    for (int row = 0; row < 20; ++row)
        append(bricks, parallelogram(at(-1e-3 * (row % 3 + 1), 1e-3 * row, 0), at(0.06, 0, 0), at(0, 1e-3, 0),
                                     20, 1));
    ASSERT_EQ(mesh(bricks).getNumberOfParts(), 20u);
    expectRollsAsOnAPlane<TypeParam>(bricks, rollingStart, rollingVelocity, rollingTolerance);
}

TEST(RollingOverEdges, historyGoesOnOverAConvexEdgeOfSmallAngle) {
    // On top of a rod of 90 facets that does not turn, a grain held by friction would slip off if it lost its
    // spring; here it rolls: the spring's force keeps its sign and the slip stays small throughout.
    const double facet = 2 * std::numbers::pi / 90, apothem = 20e-3 * std::cos(0.5 * facet);
    const double height = apothem + radius - 2e-7;  // over the middle of the facet next to the top one
    WallScene<Dry> scene(
        {{.radius = radius, .position = {height * std::sin(facet), 5e-3, height * std::cos(facet)}}},
        material<Dry>(0.3, 0.5), {0, 0, -9.81});
    scene.add(mesh(prism(90, 20e-3, 10e-3)));
    scene.initialise();
    double worst = 0;
    for (int k = 0; k < 18000; ++k) {
        scene.step();
        if (k < 1000) continue;
        const GrainMotion g = scene.motion(0);
        ASSERT_EQ(scene.touching(), 1) << k;
        const Vec3D normal = -Vec3D(g.position.x(), 0, g.position.z()).normalized();
        worst = std::max(worst, (g.velocity + g.spin.cross(radius * normal)).norm() / g.velocity.norm());
    }
    EXPECT_GT(scene.motion(0).velocity.norm(), 0.02);
    EXPECT_LT(worst, 0.1);  // normals differ from the circle's by up to 2 degrees
}

TEST(MeshDrum, aGrainRollsAsInACylinder) {
    const double size = 30e-3;
    const GrainMotion grain{.radius = radius,
                            .position = {0.6 * (size - radius), 5e-3, -0.8 * (size - radius)}};
    const Vec3D gravity{0, 0, -9.81};
    WallScene<Dry> round({grain}, material<Dry>(), gravity), faceted({grain}, material<Dry>(), gravity);
    InfiniteCylinder cylinder;
    cylinder.set({0, 1, 0}, {0, 0, 0}, size, CylinderSide::Inside);
    round.add(cylinder);
    faceted.add(mesh(prism(240, size, 10e-3)));
    round.initialise();
    faceted.initialise();
    for (int k = 0; k < 20000; ++k) {
        round.step();
        faceted.step();
    }
    // Facets of 1.5 degrees: each lets the grain fall by 1e-4 of the size and hits it with sin(1.5 degrees)
    // of its speed.
    EXPECT_NEAR(round.motion(0).velocity.norm() / faceted.motion(0).velocity.norm(), 1, 0.05);
    EXPECT_GT(round.motion(0).velocity.norm(), 0.1);
}

TEST(MeshCorner, aGrainRestsOnThreeFacesWithAThirdOfItsWeightEach) {
    const Vec3D gravity = -9.81 / std::sqrt(3.0) * Vec3D(1, 1, 1);
    WallScene<Smooth> scene({{.radius = radius, .position = {radius, radius, radius}}}, material<Smooth>(0.3),
                            gravity);
    scene.add(mesh(box(at(0, 0, 0), at(0.01, 0.01, 0.01),
                       3)));  // with friction the shares would depend on the way there
    scene.initialise();
    scene.steps(20000);
    ASSERT_EQ(scene.touching(), 3);
    scene.contacts().forEachListed([&](const Bucket&, std::uint32_t c) {
        const double normalForce = scene.contacts().normalForceOf(c);
        if (normalForce != 0) {
            EXPECT_NEAR(normalForce / (mass() * 9.81 / std::sqrt(3.0)), 1, 1e-9);
        }
    });
}

/// A grain at rest in a corner of a mesh stays there: no energy comes in, it does not creep.
void expectRest(int steps) {
    const Vec3D gravity{-1, -2, -9};
    WallScene<Dry> scene({{.radius = radius,
                           .position = {1.02 * radius, 1.03 * radius, 1.01 * radius},
                           .velocity = {0.01, 0.02, 0}}},
                         material<Dry>(0.5, 0.3), gravity);
    scene.add(mesh(box(at(0, 0, 0), at(0.01, 0.01, 0.01), 7)));
    scene.initialise();
    scene.steps(40000);
    const GrainMotion settled = scene.motion(0);
    EXPECT_LT(scene.kineticEnergy(), 1e-12 * mass() * 9.3 * radius);
    scene.steps(steps);
    EXPECT_LT(scene.kineticEnergy(), 1e-12 * mass() * 9.3 * radius);
    EXPECT_LT((scene.motion(0).position - settled.position).norm(), 1e-9 * radius);
}
TEST(MeshCorner, aGrainAtRestStaysForAHundredThousandSteps) { expectRest(100000); }
TEST(LongMeshCorner, aGrainAtRestStaysForAMillionSteps) { expectRest(1000000); }

TEST(Tunnel, aGrainShotThroughAMeshIsReported) {
    // At 400 m/s a step is 0.8 radii: no force of this soft grain stops it.
    for (const Vec3D& direction : {Vec3D(0, 0, -1), Vec3D(0.3, 0.2, -0.9)}) {
        WallScene<Smooth> scene(
            {{.radius = radius, .position = -12.3e-3 * direction, .velocity = 200 * direction}});
        scene.add(mesh(parallelogram(at(-0.1, -0.1, 0), at(0.2, 0, 0), at(0, 0.2, 0), 3, 3)));
        scene.initialise();
        std::string message;
        int last = 0;
        for (; last < 60 && message.empty(); ++last) try {
                scene.step();
            } catch (const std::runtime_error& error) {
                message = error.what();
            }
        EXPECT_TRUE(contains(message, "Particle 0 went through wall 0"));
        EXPECT_GT(last, 10);  // not before it is there
        EXPECT_LT(last, 22);
    }
}

TEST(Tunnel, aGrainThatIsThrownBackIsNot) {
    WallScene<Smooth> scene({{.radius = radius, .position = {0, 0, 3e-3}, .velocity = {0, 0, -3}}});
    scene.add(mesh(parallelogram(at(-0.1, -0.1, 0), at(0.2, 0, 0), at(0, 0.2, 0), 3, 3)));
    scene.initialise();
    EXPECT_NO_THROW(scene.steps(1000));
    EXPECT_GT(scene.motion(0).velocity.z(), 1);
}

}  // namespace
}  // namespace pendular::meshTest
