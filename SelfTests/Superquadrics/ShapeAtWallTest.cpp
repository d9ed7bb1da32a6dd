#include "Kernel/Features/Superquadrics/ShapeAtWall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/Superquadrics/ExtremeContact.h"
#include "SelfTests/Support/Random.h"

// Where superquadrics touch walls: against poses that were computed independently, and against the least of
// F(n) over many normals.

namespace pendular::shapeAtWallTest {
namespace {

enum class Kind { Face, Edge, Corner, Rod, Tube };

/// A pose, and where it touches: found as the least of the support form, and compared with 10^6 points of the
/// surface, by a program that shares nothing with this one.
struct Pose {
    Kind kind;
    std::array<double, 5> shape;     // m, m, m, exponents
    Vec3D position, rotationVector;  // m, rad
    std::vector<double> wall;        // m, three corners; or the radius, about z
    double depth;                    // m
    Vec3D fromWall, wallPoint;       // unit; m
};

const std::vector<Pose> poses{
    {Kind::Face,
     {1.0, 0.681127600966649, 0.591979680622031, 2, 2},
     {-0.283201400728802, -0.111927465513034, 0.861531121409594},
     {-0.166352208994787, 1.04572692390766, 0.326957050959571},
     {-3, -3, 0, 3, -2, 0, 0, 4, 0},
     0.0555146727285545,
     {0.0, 0.0, 1.0},
     {0, 0, 1.11022302e-16}},
    {Kind::Edge,
     {1.0, 1.18956792217455, 1.09220906337781, 4, 4},
     {-0.141733177070398, 0.916582251403801, 0.956505681109803},
     {-0.245841860708998, -1.89098921342033, -0.666728850065289},
     {-3, 0, 0, 3, 0, 0, 0, -4, -1},
     0.0236292049798168,
     {2.46655706341887e-17, 0.507020115956184, 0.861934221397304},
     {-1.45808382e-08, 1.40559087e-08, -8.26818193e-09}},
    {Kind::Corner,
     {1.0, 0.695567481216118, 0.62686736555247, 8, 8},
     {-0.0199203087302626, 0.226253242178471, 1.12626778274819},
     {0.429030509566059, 0.955093384308498, -0.0136678364899606},
     {0, 0, 0, 2, -3, -3, -2, -3, -2},
     0.0491291848953039,
     {0.0995037196057016, 0.597022314290134, 0.796029751971798},
     {-1.20780519e-10, -1.44666813e-11, 2.59467794e-11}},
    {Kind::Rod,
     {1.0, 0.613282322570258, 1.04318961655104, 3, 2},
     {0.409812843015309, -2.34741471212229, 0.3},
     {-1.90922086938052, 0.651552565281613, -0.410736228763863},
     {1.3},
     0.0307833784487777,
     {0.183360501797328, -0.983045739719486, -0.0},
     {0.238368649, -1.27795946, 0.0823192939}},
    {Kind::Tube,
     {1.0, 0.697544567782741, 1.24132061135372, 6, 4},
     {0.170427703156568, 1.60684571570574, 0.3},
     {0.722531402793703, 0.404166721679524, -1.5623189551706},
     {3},
     0.0225125282571947,
     {-0.0452288498210078, -0.99897665195132, -0.0},
     {0.135686505, 2.99692996, 0.0149126909}},
    {Kind::Face,
     {1.0, 0.82571935423787, 0.579217408190461, 8, 8},
     {-0.0770509069168445, -0.589060818444288, 1.03818391767746},
     {-1.67863219399026, -2.57588277301671, 1.02888111662345},
     {-3, -3, 0, 3, -2, 0, 0, 4, 0},
     0.0431754869818899,
     {0.0, 0.0, 1.0},
     {0, 0, 0}},
    {Kind::Edge,
     {1.0, 1.1712184680388, 0.780539327929103, 3, 2},
     {-0.166806811727849, 0.584109446698343, 0.930312018692649},
     {1.14985460367553, -1.07576465901252, 0.3843734404279},
     {-3, 0, 0, 3, 0, 0, 0, -4, -1},
     0.0210589616451267,
     {-6.92162539447419e-18, 0.507020133266729, 0.861934211214631},
     {1.90965799e-09, -4.17270354e-09, 2.45453092e-09}},
    {Kind::Corner,
     {1.0, 1.06192390795, 1.20763117018755, 6, 4},
     {0.561609280217048, 1.10138942692486, 0.557981431841189},
     {-2.34417930677638, -0.563498046757136, -1.85005920233238},
     {0, 0, 0, 2, -3, -3, -2, -3, -2},
     0.0353540847280407,
     {0.0995037105999634, 0.597022313194744, 0.796029753919058},
     {1.54979865e-08, 3.41236659e-09, -4.49652388e-09}},
    {Kind::Rod,
     {1.0, 1.18180674337868, 1.36049004921273, 5, 5},
     {-1.3233894083773, -2.56571883433356, 0.3},
     {-0.980737243131387, 0.105078535369113, -0.820423289997014},
     {1.3},
     0.0526336734963597,
     {-0.533867119808168, -0.845568387765136, -0.0},
     {-0.694027256, -1.0992389, 0.133337853}},
    {Kind::Tube,
     {1.0, 0.940541131186875, 1.49363556161625, 2, 2},
     {-1.57557426203573, 1.17947797296914, 0.3},
     {0.0467074754969532, 1.37109693488546, 1.03229267349349},
     {3},
     0.0486838994424419,
     {0.92506518635413, -0.379808374046174, -0.0},
     {-2.77519555, 1.13942514, 0.0974498227}},
    {Kind::Face,
     {1.0, 0.754991250328017, 0.942809704897664, 6, 4},
     {0.481281644782627, 0.369226507363723, 0.976884973093743},
     {-1.45354680082474, -0.174712949702298, -0.643706312351258},
     {-3, -3, 0, 3, -2, 0, 0, 4, 0},
     0.0550695722768064,
     {0.0, 0.0, 1.0},
     {0, 0, -2.22044605e-16}},
    {Kind::Edge,
     {1.0, 0.702179991992804, 1.12561982089182, 5, 5},
     {0.132423391929562, 1.02196243953378, 0.722033452415488},
     {0.839693972735167, -0.951642990850042, 0.823326909362218},
     {-3, 0, 0, 3, 0, 0, 0, -4, -1},
     0.0155920144304591,
     {-4.24312313300406e-18, 0.507020123494714, 0.861934216962875},
     {9.10263836e-10, 2.89216655e-09, -1.70127526e-09}},
    {Kind::Corner,
     {1.0, 0.763533893347983, 1.07624964894731, 2, 2},
     {0.0613781261291879, 0.370095681334788, 0.857024079862474},
     {-0.565964699725053, -2.31502421664022, -0.0812377369450664},
     {0, 0, 0, 2, -3, -3, -2, -3, -2},
     0.0597052870000058,
     {0.0995037197127989, 0.597022314588317, 0.796029751734774},
     {-5.50745084e-10, -2.22089659e-10, 2.3541015e-10}},
    {Kind::Rod,
     {1.0, 0.74841822582025, 1.46811455874022, 4, 4},
     {1.02259140262445, 1.95448455095415, 0.3},
     {0.0807271922766182, -0.890575457267295, -0.497548717551577},
     {1.3},
     0.0443313608120377,
     {0.342131529362723, 0.939652072107503, 0.0},
     {0.44477103, 1.22154768, 1.13008511}},
    {Kind::Tube,
     {1.0, 0.782731230700368, 1.14971288543915, 8, 8},
     {1.59309120781523, -1.18389744504275, 0.3},
     {0.0541460693218292, -0.676789687386131, 0.96894933318964},
     {3},
     0.0360410334312795,
     {-0.973441583938019, 0.22893554258839, 0.0},
     {2.92032475, -0.686806645, 0.106666878}},
};

Superquadric shapeOf(const Pose& pose) {
    const auto& [a, b, c, n1, n2] = pose.shape;
    return {a, b, c, static_cast<int>(n1), static_cast<int>(n2)};
}
Axes<double> axesOf(const Vec3D& rotationVector) {
    const double angle = rotationVector.norm();
    const Eigen::Quaterniond q(angle > 0 ? Eigen::AngleAxisd(angle, rotationVector / angle)
                                         : Eigen::AngleAxisd::Identity());
    return Axes<double>(Quaternion{q.w(), toVector(Vec3D(q.vec()))});
}
ShapeAtWall grainOf(const Superquadric& shape, const Axes<double>& axes, const Vector<double>& position) {
    return {SuperquadricLanes<double>::from(shape), axes, position,
            extremeContact(shape).smallestRadius * shape.boundingRadius()};
}
std::vector<WallPoint> pointsOf(const ShapeAtWall& grain, const Wall& wall) {
    std::vector<std::uint32_t> parts;
    wall.listParts({0, 0, 0}, 100, parts);
    std::vector<WallPoint> points(parts.size());
    grain.findPoints(wall, 0, parts, points);
    return points;
}
template <class Look>
void forWallOf(const Pose& pose, Look&& look) {
    if (pose.kind == Kind::Rod || pose.kind == Kind::Tube) {
        InfiniteCylinder wall;
        wall.set({0, 0, 1}, {0, 0, 0}, pose.wall[0],
                 pose.kind == Kind::Rod ? CylinderSide::Outside : CylinderSide::Inside);
        return look(wall);
    }
    const auto& w = pose.wall;
    TriangleWall wall;
    wall.set(
        std::vector<Triangle>{{Vector<double>{w[0], w[1], w[2]}, {w[3], w[4], w[5]}, {w[6], w[7], w[8]}}});
    look(wall);
}

// The tolerances are those of the numbers: depths are stationary where the normal is found, so that they are
// known to the square of its error; points of flat faces (exponents from 5 on) are known worse.
TEST(ShapeAtWall, touchesWhereTheLeastOfTheSupportFormIs) {
    for (const Pose& pose : poses)
        forWallOf(pose, [&](const Wall& wall) {
            const Superquadric shape = shapeOf(pose);
            const Axes<double> axes = axesOf(pose.rotationVector);
            const std::vector<WallPoint> points =
                pointsOf(grainOf(shape, axes, toVector(pose.position)), wall);
            ASSERT_EQ(points.size(), 1u);
            const SupportPoint<double> at =
                supportPoint(SuperquadricLanes<double>::from(shape), axes.turnBack(points[0].normal));
            const double depth = at.height - points[0].distance;
            SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(pose.kind) << ", exponents "
                                            << shape.n1 << ", " << shape.n2);
            const double fair = std::max(shape.n1, shape.n2) >= 5 ? 1e-4 : 1e-6;
            EXPECT_NEAR(depth, pose.depth, 1e-9);
            EXPECT_LT((toEigen(points[0].normal) + pose.fromWall).norm(), 1e-6);
            const Vec3D onWall =
                pose.position + toEigen(axes.turn(at.point)) - depth * toEigen(points[0].normal);
            EXPECT_LT((onWall - pose.wallPoint).norm(), fair);
        });
}

/// F(n) = h(n) - min over the corners of (v - c).n
double slabOverlap(const Superquadric& shape, const Axes<double>& axes, const Vector<double>& centre,
                   const Triangle& triangle, const Vector<double>& n) {
    double least = infinity;
    for (const auto& corner : triangle) least = std::min(least, dot(corner - centre, n));
    return supportPoint(SuperquadricLanes<double>::from(shape), axes.turnBack(n)).height - least;
}

// 150 triangles at random about shapes of all exponents, that overlap by less than half the radius of the
// ball: the depth is F at its own normal, so it is an upper bound of the least; and no other of 1000 normals,
// nor of 200 near by, has a smaller one. Where an overlap is larger, the depth is at least not more than F at
// the normal.
TEST(LongShapeAtWall, noNormalHasASmallerOverlap) {
    support::Random random(7);
    const auto anyNormal = [&] { return toVector(random.direction()); };
    int touching = 0, deep = 0;
    for (int k = 0; k < 3000 && touching < 150; ++k) {
        const Superquadric shape{1, random.uniform(0.3, 1.3), random.uniform(0.3, 1.3), 2 + k % 7,
                                 2 + k / 7 % 7};
        const Axes<double> axes = axesOf(3 * random.direction());
        const Vector<double> middle = random.uniform(0.7, 1.3) * anyNormal();
        Triangle triangle;
        for (auto& corner : triangle) corner = middle + random.uniform(0.1, 2.1) * anyNormal();
        const auto overlapAt = [&](const Vector<double>& n) {
            return slabOverlap(shape, axes, {0, 0, 0}, triangle, (1 / norm(n)) * n);
        };
        TriangleWall wall;
        wall.set(std::vector{triangle});
        const WallPoint found = pointsOf(grainOf(shape, axes, {0, 0, 0}), wall).at(0);
        const double depth =
            supportPoint(SuperquadricLanes<double>::from(shape), axes.turnBack(found.normal)).height -
            found.distance;
        if (!(depth > 0)) continue;
        SCOPED_TRACE(testing::Message() << "triangle " << k);
        const bool isDeep = depth > 0.5 * extremeContact(shape).smallestRadius * shape.boundingRadius();
        // Newton's method ends at 1e-6 of the normal, where a face may have a radius of up to 10^6 sizes (its
        // floor).
        if (!isDeep) {
            ASSERT_NEAR(overlapAt(found.normal), depth, 1e-6);
        }
        ASSERT_LT(depth, overlapAt(found.normal) + 1e-6);
        double least = depth;
        for (int j = 0; j < 1200; ++j) {
            const Vector<double> way = anyNormal();
            least =
                std::min(least, overlapAt(j < 1000 ? way : found.normal + std::pow(0.1, 1 + j % 6) * way));
        }
        if (isDeep) {
            ++deep;
            continue;
        }
        ++touching;
        ASSERT_GT(least, depth - 1e-9);
    }
    EXPECT_EQ(touching, 150);
    EXPECT_GT(deep, 50);
}

// Corners just below the middle of a nearly flat side, where 1e-16 of the normal is 0.005 of a half length. A
// corner at s - d m below the point s of the surface with the normal m overlaps by d, as long as d is no more
// than the ball, and everything else of the triangle is farther out along m.
TEST(ShapeAtWall, cornersBelowFlatSidesHaveTheDepthThatTheyWereGiven) {
    support::Random random(9);
    const Superquadric shape{1, 0.1, 0.12, 8, 8};
    const double ball = extremeContact(shape).smallestRadius * shape.boundingRadius();
    for (int k = 0; k < 300; ++k) {
        const double x = random.uniform(-0.02, 0.02), z = random.uniform(-0.11, 0.11),
                     y = 0.1 * std::pow(1 - std::pow(x, 8) - std::pow(z / 0.12, 8), 1.0 / 8);
        const Vector<double> gradient{std::pow(x, 7), std::pow(y / 0.1, 7) / 0.1,
                                      std::pow(z / 0.12, 7) / 0.12};
        const Axes<double> axes = axesOf(3 * random.direction());
        const Vector<double> normal = axes.turn((1 / norm(gradient)) * gradient);
        const double depth = random.uniform(0.05, 0.95) * ball;
        const Vector<double> corner = axes.turn({x, y, z}) - depth * normal;
        const auto beyond = [&] {
            const Vector<double> way = toVector(random.direction());
            return corner + normal + 0.9 * (way - dot(way, normal) * normal);
        };
        TriangleWall wall;
        wall.set(std::vector<Triangle>{{corner, beyond(), beyond()}});
        const WallPoint found = pointsOf(grainOf(shape, axes, {0, 0, 0}), wall).at(0);
        const double height =
            supportPoint(SuperquadricLanes<double>::from(shape), axes.turnBack(found.normal)).height;
        // Depths are stationary: a normal that is 1e-8 off changes them by 1e-16.
        EXPECT_NEAR(height - found.distance, depth, 1e-14) << "triangle " << k;
        EXPECT_LT(norm(found.normal - normal), 1e-7) << "triangle " << k;
    }
}

/// The parts that a grain at the origin touches, and the depth of each.
std::vector<double> depthsAt(const Superquadric& shape, const Axes<double>& axes,
                             const std::vector<Triangle>& mesh) {
    TriangleWall wall;
    wall.set(mesh);
    std::vector<double> depths;
    for (const WallPoint& found : pointsOf(grainOf(shape, axes, {0, 0, 0}), wall)) {
        if (!(found.distance < infinity)) continue;
        const double height =
            supportPoint(SuperquadricLanes<double>::from(shape), axes.turnBack(found.normal)).height;
        if (height > found.distance) depths.push_back(height - found.distance);
    }
    return depths;
}

// A point p at s - d m below the point s of the surface with the normal m is the tip of a pyramid of three or
// eight faces around m, a point of a ridge across m, or of two facets that lie on each other: one contact, of
// the depth d. In directions at random, so that no facet is favoured by a symmetry.
TEST(ShapeAtWall, convexEdgesAndCornersAreTouchedOnce) {
    support::Random random(10);
    for (int k = 0; k < 400; ++k) {
        const int exponent = std::array{2, 3, 5, 8}[static_cast<std::size_t>(k) % 4];
        const Superquadric shape{1, random.uniform(0.5, 1), random.uniform(0.5, 1), exponent, exponent};
        const Axes<double> axes = axesOf(3 * random.direction());
        const Vector<double> m = toVector(random.direction());
        const double depth =
            random.uniform(0.05, 0.5) * extremeContact(shape).smallestRadius * shape.boundingRadius();
        const SupportPoint<double> at =
            supportPoint(SuperquadricLanes<double>::from(shape), axes.turnBack(m));
        const Vector<double> p = axes.turn(at.point) - depth * m;
        const TangentPlane<double> plane(m);
        const double turn = random.uniform(0, 6);
        const auto around = [&](double angle, double along) {
            return p + 9 * std::cos(angle + turn) * plane.u + 9 * std::sin(angle + turn) * plane.v +
                   along * m;
        };
        std::vector<std::vector<Triangle>> meshes(3);
        for (const int faces : {3, 8})
            for (int face = 0; face < faces; ++face) {
                const double angle = 2 * std::numbers::pi / faces;
                meshes[faces == 3 ? 0 : 1].push_back(
                    {p, around(face * angle, 5), around((face + 1) * angle, 5)});
            }
        const Vector<double> begin = around(0, 0), end = around(std::numbers::pi, 0);
        meshes[2] = {{begin, end, around(1.2, 6)}, {end, begin, around(4.4, 4)}};
        meshes.push_back({meshes[0][0], meshes[0][0]});
        for (std::size_t mesh = 0; mesh < meshes.size(); ++mesh) {
            const std::vector<double> depths = depthsAt(shape, axes, meshes[mesh]);
            ASSERT_EQ(depths.size(), 1u) << "pose " << k << ", mesh " << mesh;
            EXPECT_NEAR(depths[0], depth, 1e-12) << "pose " << k << ", mesh " << mesh;
        }
    }
}

// What a part is told to be apart is apart: a plane across some normal lies between.
TEST(ShapeAtWall, whatIsApartHasAPlaneBetween) {
    support::Random random(8);
    int apart = 0;
    for (int k = 0; k < 300; ++k) {
        const Superquadric shape{1, 0.5, 0.4, 2 + k % 7, 2 + k / 7 % 7};
        const Axes<double> axes = axesOf(3 * random.direction());
        const Vector<double> corner{random.uniform(0.6, 1.6), random.uniform(-0.5, 0.5),
                                    random.uniform(-0.5, 0.5)};
        const Triangle triangle{corner, corner + Vector<double>{random.uniform(0, 1), 1, 0},
                                corner + Vector<double>{random.uniform(0, 1), 0, 1}};
        TriangleWall wall;
        wall.set(std::vector{triangle});
        const WallPoint found = pointsOf(grainOf(shape, axes, {0, 0, 0}), wall).at(0);
        const double own =
            supportPoint(SuperquadricLanes<double>::from(shape), axes.turnBack(found.normal)).height;
        if (own > found.distance) continue;
        ++apart;
        EXPECT_LT(slabOverlap(shape, axes, {0, 0, 0}, triangle, found.normal), 1e-12);
    }
    EXPECT_GT(apart, 100);
}

}  // namespace
}  // namespace pendular::shapeAtWallTest
