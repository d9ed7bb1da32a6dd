#include <gtest/gtest.h>

#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Walls/WallScene.h"

namespace pendular::shapesTest {
namespace {

using namespace wallTests;
using support::contains;
using support::isOneSentence;
using support::Random;
using support::refusal;

constexpr double far = 1e3;  // m: everything is in reach

Vec3D eigen(const Vector<double>& v) { return toEigen(v); }

double nearestDistance(const std::vector<WallPoint>& points) {
    double least = infinity;
    for (const WallPoint& p : points) least = std::min(least, p.distance);
    return least;
}

TEST(InfiniteCylinder, isTheClosedForm) {
    Random draw(1);
    for (int k = 0; k < 1000; ++k) {
        const bool inside = k % 2 == 0;
        const Vector<double> axis = toVector(draw.direction()), origin = toVector(draw.inCube(2)),
                             centre = toVector(draw.inCube(2));
        const double size = draw.uniform(0.5, 4);
        InfiniteCylinder wall;
        wall.set(3 * eigen(axis), eigen(origin), size, inside ? CylinderSide::Inside : CylinderSide::Outside);
        const auto points = pointsFor(wall, centre, far);
        ASSERT_EQ(points.size(), 1u);
        const double r = norm(cross(centre - origin, axis));
        EXPECT_NEAR(points[0].distance, inside ? size - r : r - size, 1e-14);
        EXPECT_NEAR(norm(points[0].normal), 1, 1e-15);
        EXPECT_NEAR(dot(points[0].normal, axis), 0, 4e-15 / r);  // round-off of lengths of 4 m
        const Vector<double> surface = centre + points[0].distance * points[0].normal - origin;
        EXPECT_NEAR(norm(cross(surface, axis)), size, 1e-14);
    }
}

/// The least distance to points spread over the surface of revolution about z.
double sampledDistance(const std::vector<ProfilePoint>& profile, const Vector<double>& centre,
                       double spacing) {
    double least2 = infinity;
    for (std::size_t s = 0; s + 1 < profile.size(); ++s) {
        const double dr = profile[s + 1].radius - profile[s].radius,
                     dz = profile[s + 1].height - profile[s].height;
        const int along = static_cast<int>(std::hypot(dr, dz) / spacing) + 1;
        for (int i = 0; i <= along; ++i) {
            const double r = profile[s].radius + dr * i / along, z = profile[s].height + dz * i / along;
            const int around = static_cast<int>(2 * std::numbers::pi * r / spacing) + 1;
            for (int j = 0; j < around; ++j) {
                const double angle = 2 * std::numbers::pi * j / around;
                least2 =
                    std::min(least2, squaredNorm(at(r * std::cos(angle), r * std::sin(angle), z) - centre));
            }
        }
    }
    return std::sqrt(least2);
}

TEST(AxisymmetricWall, nearestPointIsThatOfADenseSampling) {
    const std::vector<ProfilePoint> hopper{{0.3, 0}, {0.3, 0.4}, {1, 1.2}, {1, 2}};
    const std::vector<ProfilePoint> vessel{{0, 0}, {0.8, -0.1}, {1, 1}, {0, 1.5}};
    constexpr double spacing = 0.01;
    Random draw(2);
    for (const auto& profile : {hopper, vessel})
        for (int k = 0; k < 60; ++k) {
            AxisymmetricWall wall;
            wall.set({0, 0, 2}, {0, 0, 0}, profile);
            const Vector<double> centre =
                at(draw.uniform(-1.5, 1.5), draw.uniform(-1.5, 1.5), draw.uniform(-0.5, 2.5));
            const auto points = pointsFor(wall, centre, far);
            const double exact = nearestDistance(points), sampled = sampledDistance(profile, centre, spacing);
            // A sample lies within 0.71 spacings of the nearest point: farther by at most that, and by its
            // square over 2 d.
            EXPECT_LE(exact, sampled + 1e-14);
            EXPECT_GE(exact, sampled - std::min(0.71 * spacing, spacing * spacing / exact));
            for (const WallPoint& p : points)  // each point lies on the surface
                EXPECT_LT(sampledDistance(profile, centre + p.distance * p.normal, spacing), 0.71 * spacing);
        }
}

TEST(AxisymmetricWall, isTheSameInEveryFrame) {
    const std::vector<ProfilePoint> profile{{0.3, 0}, {0.3, 0.4}, {1, 1.2}, {1, 2}};
    Random draw(3);
    for (int k = 0; k < 200; ++k) {
        const Vec3D axis = eigen(toVector(draw.direction())), origin = eigen(toVector(draw.inCube(1)));
        const Eigen::Matrix3d turn =
            Eigen::Quaterniond::FromTwoVectors(Vec3D::UnitZ(), axis).toRotationMatrix();
        AxisymmetricWall upright, inclined;
        upright.set({0, 0, 1}, {0, 0, 0}, profile);
        inclined.set(axis, origin, profile);
        const Vec3D centre = eigen(toVector(draw.inCube(1.5)));
        const auto a = pointsFor(upright, toVector(centre), 0.6),
                   b = pointsFor(inclined, toVector(Vec3D(turn * centre + origin)), 0.6);
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t p = 0; p < a.size(); ++p) {
            EXPECT_NEAR(a[p].distance, b[p].distance, 1e-14);
            EXPECT_LT((turn * eigen(a[p].normal) - eigen(b[p].normal)).norm(), 1e-13);
        }
    }
}

TEST(AxisymmetricWall, edgesBetweenSegmentsCountOnce) {
    AxisymmetricWall wall;  // a bend that is convex from outside
    wall.set({0, 0, 1}, {0, 0, 0}, {{1, 0}, {1, 1}, {0.4, 1.2}});
    EXPECT_EQ(pointsFor(wall, at(1.1, 0, 1.1), 0.3).size(), 1u);   // outside, nearest to the bend
    EXPECT_EQ(pointsFor(wall, at(1.1, 0, 0.95), 0.3).size(), 1u);  // outside, beside the lower segment
    EXPECT_EQ(pointsFor(wall, at(0.8, 0, 0.95), 0.3).size(), 2u);  // inside, in the concave corner
    EXPECT_EQ(pointsFor(wall, at(0.8, 0, 0.5), 0.3).size(), 1u);
}

TEST(AxisymmetricWall, smoothEdgesCountOnceFromBothSides) {
    // An arc of 60 segments in a circle: seen from inside, the neighbouring segments lie within reach as
    // well.
    std::vector<ProfilePoint> arc;
    for (int k = 0; k <= 20; ++k) {
        const double angle = std::numbers::pi * k / 30;
        arc.push_back({2 + std::sin(angle), -std::cos(angle)});
    }
    AxisymmetricWall wall;
    wall.set({0, 0, 1}, {0, 0, 0}, arc);
    for (double angle = 0.2; angle < 1.8; angle += 0.01)
        for (double r : {0.8, 1.2}) {
            const auto points = pointsFor(wall, at(2 + r * std::sin(angle), 0, -r * std::cos(angle)), 0.25);
            ASSERT_EQ(points.size(), 1u) << angle << " " << r;
            EXPECT_NEAR(points[0].distance, 0.2, 0.006);  // the arc's sagitta is 1 - cos(pi/60) = 0.0014
        }
}

TEST(AxisymmetricWall, aGrainInANarrowOutletRestsOnBothSides) {
    AxisymmetricWall wall;
    wall.set({0, 0, 1}, {0, 0, 0}, {{0.5, 0}, {1.5, 1}});
    const auto points = pointsFor(wall, at(0.01, 0, 0.7), 0.9);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NEAR(dot(points[0].normal, points[1].normal), 0, 1e-12);  // two walls at right angles
    // Outside the cone its far side is hidden.
    EXPECT_EQ(pointsFor(wall, at(1.2, 0, 0.1), 3).size(), 1u);
}

TEST(FiniteCylinder, hasRimsAndOpenEnds) {
    FiniteCylinder tube;
    tube.set({1, 0, 0}, {1, 0, 0}, 0.5, 2);  // x from 0 to 2
    const auto nearest = [&](double x, double y) {
        return nearestDistance(pointsFor(tube, at(x, y, 0), far));
    };
    EXPECT_NEAR(nearest(1, 0.2), 0.3, 1e-15);    // inside
    EXPECT_NEAR(nearest(1, 0.9), 0.4, 1e-15);    // outside
    EXPECT_NEAR(nearest(2.3, 0.9), 0.5, 1e-15);  // the rim, a 3-4-5 triangle
    EXPECT_NEAR(nearest(2.3, 0.1), 0.5, 1e-15);  // the rim from the open end
    EXPECT_EQ(pointsFor(tube, at(2.3, 0.0, 0), 0.6).size(),
              2u);  // a grain in front of the opening: both sides of the rim
}

TEST(TriangleWall, nearestPointIsThatOfADenseSampling) {
    Random draw(4);
    for (int k = 0; k < 200; ++k) {
        const Vector<double> a = toVector(draw.inCube(1)), b = toVector(draw.inCube(1)),
                             c = toVector(draw.inCube(1)), centre = toVector(draw.inCube(1.5));
        if (norm(cross(b - a, c - a)) < 0.1) continue;
        const auto points = pointsFor(mesh({{a, b, c}}), centre, far);
        ASSERT_EQ(points.size(), 1u);
        double sampled = infinity;
        constexpr int n = 200;
        for (int i = 0; i <= n; ++i)
            for (int j = 0; i + j <= n; ++j)
                sampled =
                    std::min(sampled, norm(a + (1.0 * i / n) * (b - a) + (1.0 * j / n) * (c - a) - centre));
        const double spacing = 3.0 / n;  // sides are up to 3.5 long; a sample lies within 0.6 sides / n
        EXPECT_LE(points[0].distance, sampled + 1e-14);
        EXPECT_GE(points[0].distance, sampled - std::min(spacing, spacing * spacing / points[0].distance));
    }
}

TEST(Shapes, refuseWhatTheyCannotBe) {
    InfiniteWall plane;
    InfiniteCylinder cylinder;
    FiniteCylinder tube;
    AxisymmetricWall wall;
    const Vec3D z{0, 0, 1}, zero{0, 0, 0}, nan{0, NAN, 0};
    const std::vector<std::string> refusals{
        refusal([&] { plane.set(zero, zero); }),
        refusal([&] { plane.set(z, nan); }),
        refusal([&] {
            plane.set({INFINITY, 0, 0}, zero);
        }),
        refusal([&] { cylinder.set(zero, zero, 1, CylinderSide::Inside); }),
        refusal([&] { cylinder.set(z, nan, 1, CylinderSide::Inside); }),
        refusal([&] { cylinder.set(z, zero, 0, CylinderSide::Outside); }),
        refusal([&] { cylinder.set(z, zero, -1, CylinderSide::Outside); }),
        refusal([&] { tube.set(z, zero, 1, 0); }),
        refusal([&] { tube.set(z, zero, NAN, 1); }),
        refusal([&] { wall.set(z, zero, {}); }),
        refusal([&] {
            wall.set(z, zero, {{1, 0}});
        }),
        refusal([&] {
            wall.set(z, zero, {{1, 0}, {1, 0}});
        }),
        refusal([&] {
            wall.set(z, zero, {{-1, 0}, {1, 0}});
        }),
        refusal([&] {
            wall.set(z, zero, {{0, 0}, {0, 1}});
        }),
        refusal([&] {
            wall.set(z, zero, {{1, 0}, {1, NAN}});
        }),
        refusal([&] { mesh({}); }),
        refusal([&] {
            mesh({{at(0, 0, 0), at(1, 0, 0), at(2, 0, 0)}});
        }),
        refusal([&] {
            mesh({{at(0, 0, 0), at(1, 0, 0), at(0, NAN, 0)}});
        }),
        refusal([&] {
            mesh({{at(0, 0, 0), at(1, 0, 0), at(0, 1e200, 0)}});
        }),
        refusal([&] { plane.setVelocity(nan); }),
        refusal([&] { plane.setAngularVelocity(nan, zero); }),
        refusal([&] { plane.setMotion({}); }),
        refusal([&] { plane.setSurfaceVelocity(nan); }),
        refusal([&] {
            plane.setMotion([](double) {
                Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
                pose.linear() *= 2;
                return pose;
            });
        })};
    for (std::size_t k = 0; k < refusals.size(); ++k) EXPECT_TRUE(isOneSentence(refusals[k])) << "case " << k;
}

TEST(Shapes, areRefusedBeforeTheyAreSet) {
    WallScene<Smooth> scene({});
    for (const std::string& text :
         {refusal([&] { scene.add(InfiniteWall{}); }), refusal([&] { scene.add(TriangleWall{}); }),
          refusal([&] { scene.add(FiniteCylinder{}); })}) {
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "place is not set"));
    }
}

}  // namespace
}  // namespace pendular::shapesTest
