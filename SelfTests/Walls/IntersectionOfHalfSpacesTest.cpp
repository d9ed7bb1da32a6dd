#include "Kernel/Features/Meshes/IntersectionOfHalfSpaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::intersectionOfHalfSpacesTest {
namespace {

const Vec3D origin(0, 0, 0);

const std::vector<SolidFace> unitCube{{{1, 0, 0}, {0, 0, 0}}, {{-1, 0, 0}, {1, 0, 0}},
                                      {{0, 2, 0}, {0, 0, 0}}, {{0, -1, 0}, {0, 1, 0}},
                                      {{0, 0, 1}, {0, 0, 0}}, {{0, 0, -3}, {0, 0, 1}}};

/// m, of a point from the nearest of all parts.
double distanceFrom(const TriangleWall& wall, const Vec3D& point) {
    std::vector<std::uint32_t> parts;
    wall.listParts(toVector(point), 100, parts);
    std::vector<WallPoint> points(parts.size());
    wall.findPoints(toVector(point), 100, parts, points);
    double nearest = std::numeric_limits<double>::infinity();
    for (const WallPoint& each : points) nearest = std::min(nearest, each.distance);
    return nearest;
}

TriangleWall wallOf(std::span<const SolidFace> faces, double radius) {
    TriangleWall wall;
    wall.set(intersectionOfHalfSpaces(faces, origin, radius));
    return wall;
}

TEST(IntersectionOfHalfSpaces, aCubeHasItsAreaAndItsVolume) {
    double area = 0, volume = 0;
    for (const auto& [a, b, c] : intersectionOfHalfSpaces(unitCube, {0.5, 0.5, 0.5}, 5)) {
        area += 0.5 * norm(cross(b - a, c - a));
        volume += dot(a, cross(b, c)) / 6;  // positive: normals of triangles point out of the solid
    }
    EXPECT_NEAR(area, 6, 1e-14);
    EXPECT_NEAR(volume, 1, 1e-14);
    EXPECT_EQ(wallOf(unitCube, 5).getNumberOfParts(), 6u);
    EXPECT_TRUE(wallOf(unitCube, 5).openEdges().empty());
}

/// The nearest point of a convex set that is an intersection of half-spaces, from outside. Source: Boyle and
/// Dykstra, Lecture Notes in Statistics 37 (1986) 28.
Vec3D projected(const std::vector<SolidFace>& faces, const Vec3D& point) {
    std::vector<Vec3D> corrections(faces.size(), Vec3D::Zero());
    Vec3D x = point;
    for (int sweep = 0; sweep < 20000; ++sweep)
        for (std::size_t k = 0; k < faces.size(); ++k) {
            const Vec3D y = x + corrections[k], n = faces[k].normal.normalized();
            x = y - std::min(n.dot(y - faces[k].point), 0.0) * n;
            corrections[k] = y - x;
        }
    return x;
}

/// Tetrahedra, and solids with up to seven planes: faces, edges and corners.
TEST(IntersectionOfHalfSpaces, distancesAreThoseToTheConvexSolid) {
    support::Random random(7);
    for (int solid = 0; solid < 8; ++solid) {
        std::vector<SolidFace> faces{{{1, 0.1, 0}, {-1, 0, 0}},
                                     {{-0.4, 1, 0.2}, {0, -1, 0}},
                                     {{-0.3, -0.5, 1}, {0, 0, -1}},
                                     {{-0.2, -0.4, -0.8}, {0.5, 0.6, 0.7}}};
        for (int more = 0; more < solid % 4; ++more) {
            const Vec3D out = random.direction();
            faces.push_back({-out, 0.8 * out});
        }
        const TriangleWall wall = wallOf(faces, 50);
        int outside = 0;
        for (int k = 0; k < 40; ++k) {
            const Vec3D point = random.inCube(4);
            const double expected = (projected(faces, point) - point).norm();
            if (expected < 1e-3) continue;  // inside
            ++outside;
            EXPECT_NEAR(distanceFrom(wall, point), expected, 1e-7) << solid << ": " << point.transpose();
        }
        EXPECT_GT(outside, 20);
    }
}

TEST(IntersectionOfHalfSpaces, aGrainInsideMeetsThePlanes) {
    support::Random random(3);
    const TriangleWall wall = wallOf(unitCube, 5);
    for (int k = 0; k < 50; ++k) {
        const Vec3D point = Vec3D(0.5, 0.5, 0.5) + random.inCube(0.5);
        double expected = 1;
        for (const SolidFace& face : unitCube)
            expected = std::min(expected, face.normal.normalized().dot(point - face.point));
        EXPECT_NEAR(distanceFrom(wall, point), expected, 1e-15);
    }
}

/// A wedge without ends along its edge: the edge is straight, and goes on to the border of the sphere.
TEST(IntersectionOfHalfSpaces, anEdgeWithoutEnds) {
    const double half = std::numbers::pi / 6;
    const std::vector<SolidFace> wedge{{{-std::sin(half), 0, -std::cos(half)}, origin},
                                       {{std::sin(half), 0, -std::cos(half)}, origin}};
    const TriangleWall wall = wallOf(wedge, 2);
    for (const double y : {-1.9, 0.0, 1.3}) {
        EXPECT_NEAR(distanceFrom(wall, {0, y, 0.3}), 0.3, 1e-15);
        EXPECT_NEAR(distanceFrom(wall, {0.1, y, 0.4}), std::hypot(0.1, 0.4), 1e-15);
        EXPECT_NEAR(distanceFrom(wall, {1, y, 0}), std::sin(half), 1e-15);  // 1 m from the edge, along x
    }
}

TEST(IntersectionOfHalfSpaces, wrongPlanesAreRefused) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refusal = [](const std::vector<SolidFace>& faces, double radius) {
        const std::string text =
            support::refusal([&] { static_cast<void>(intersectionOfHalfSpaces(faces, origin, radius)); });
        EXPECT_TRUE(support::isOneSentence(text)) << text;
        return text;
    };
    EXPECT_TRUE(support::contains(refusal({{{0, 0, 0}, origin}}, 1), "normal"));
    EXPECT_TRUE(support::contains(refusal({{{0, 0, 1}, {0, nan, 0}}}, 1), "point"));
    for (const double radius : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
        EXPECT_TRUE(support::contains(refusal({{{0, 0, 1}, origin}}, radius), "radius"));
    EXPECT_TRUE(support::contains(refusal({}, 1), "no solid"));
    EXPECT_TRUE(support::contains(refusal({{{0, 0, 1}, {0, 0, 3}}}, 1), "no solid"));
    // What lies above one and below the other: nothing.
    EXPECT_TRUE(
        support::contains(refusal({{{0, 0, 1}, {0, 0, 0.1}}, {{0, 0, -1}, {0, 0, -0.1}}}, 1), "no solid"));
}

}  // namespace
}  // namespace pendular::intersectionOfHalfSpacesTest
