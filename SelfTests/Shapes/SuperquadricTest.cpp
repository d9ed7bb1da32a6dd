#include "Kernel/Features/Superquadrics/Superquadric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Features/RigidBodies/UnionOfSpheres.h"
#include "Kernel/Features/Superquadrics/CoveringBalls.h"
#include "Kernel/Features/Superquadrics/SuperquadricSupport.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::superquadricTest {
namespace {

const std::vector<Superquadric> someShapes{{1, 1, 1, 2, 2}, {2, 1, 1, 2, 2},  {1, 2, 3, 2, 2},
                                           {1, 1, 1, 4, 4}, {1, 1, 1, 8, 8},  {1, 0.7, 1.3, 3, 5},
                                           {1, 2, 1, 8, 2}, {1, 1, 0.5, 2, 6}};

/// The inside-outside function, by pow().
double inside(const Superquadric& s, const Eigen::Vector3d& p) {
    const double across = std::pow(std::abs(p.x() / s.a), s.n2) + std::pow(std::abs(p.y() / s.b), s.n2);
    return std::pow(across, static_cast<double>(s.n1) / s.n2) + std::pow(std::abs(p.z() / s.c), s.n1);
}

TEST(Superquadric, hasTheMassOfTheTable) {
    struct Row {
        Superquadric shape;
        double volume, ixx, iyy, izz, radius;
    };
    // shared/data/scenes-and-shapes/superquadric_mass.csv, 13 digits
    const std::vector<Row> rows{
        {{1, 1, 1, 2, 2}, 4.188790204786, 1.675516081915, 1.675516081915, 1.675516081915, 1},
        {{2, 1, 1, 2, 2}, 8.377580409573, 3.351032163829, 8.377580409573, 8.377580409573, 2},
        {{1, 2, 3, 2, 2}, 25.13274122872, 65.34512719467, 50.26548245744, 25.13274122872, 3},
        {{1, 1, 1, 4, 4}, 6.481987351786, 3.554306350527, 3.554306350527, 3.554306350527, 1.316074012952},
        {{1, 1, 1, 8, 8}, 7.516700362172, 4.689607678574, 4.689607678574, 4.689607678574, 1.509803648477}};
    for (const Row& row : rows) {
        const MassProperties mass = row.shape.mass();
        EXPECT_NEAR(mass.volume / row.volume, 1, 1e-12);
        EXPECT_NEAR(mass.inertia(0, 0) / row.ixx, 1, 1e-12);
        EXPECT_NEAR(mass.inertia(1, 1) / row.iyy, 1, 1e-12);
        EXPECT_NEAR(mass.inertia(2, 2) / row.izz, 1, 1e-12);
        EXPECT_NEAR(row.shape.boundingRadius() / row.radius, 1, 1e-12);
    }
}

/// Sums over random points for a shape without any symmetry of the table: 4 standard deviations.
TEST(Superquadric, hasTheMassOfRandomPoints) {
    const Superquadric shape{1, 0.7, 1.3, 3, 5};
    support::Random random(7);
    constexpr int count = 400000;
    int hits = 0;
    double zz = 0;
    for (int k = 0; k < count; ++k) {
        const Eigen::Vector3d p = random.inCube(1).cwiseProduct(Eigen::Vector3d(1, 0.7, 1.3));
        if (inside(shape, p) > 1) continue;
        ++hits;
        zz += p.x() * p.x() + p.y() * p.y();
    }
    const double box = 8 * 0.7 * 1.3, share = static_cast<double>(hits) / count;
    EXPECT_NEAR(box * share, shape.volume(), 4 * box * std::sqrt(share * (1 - share) / count));
    // The mean of x^2 + y^2 spreads by at most half its largest value, 1 + 0.49.
    EXPECT_NEAR(zz / hits, shape.mass().inertia(2, 2) / shape.volume(), 4 * 0.75 / std::sqrt(hits));
}

TEST(Superquadric, refusesWhatItCannotBe) {
    const auto refused = [](const Superquadric& s) {
        return support::refusal([&] { s.check("Superquadric"); });
    };
    for (const Superquadric& s :
         {Superquadric{0, 1, 1, 2, 2}, {1, -1, 1, 2, 2}, {1, 1, NAN, 2, 2}, {1, 1, 1, 1, 2}, {1, 1, 1, 2, 9}})
        EXPECT_TRUE(support::isOneSentence(refused(s)));
    EXPECT_TRUE(
        support::contains(refused({1, 1, 1, 1, 2}), "exponent n1 = 1 must be an integer from 2 to 8"));
    EXPECT_EQ(refused({1, 1, 1, 8, 2}), "");
}

TEST(SuperquadricSupport, agreesWithTheTable) {
    struct Row {
        Superquadric shape;
        Vector<double> normal, point;
        double height, least, largest;  // m, 1/m; NaN where the surface is flat or an edge
    };
    const double third = 1.0 / 3;
    const Vector<double> oblique{third, 2 * third, 2 * third}, inPlane{0.6, 0, 0.8};
    // shared/data/scenes-and-shapes/superquadric_support.csv: 13 digits, curvatures 6
    const std::vector<Row> rows{
        {{2, 1, 1, 2, 2}, {1, 0, 0}, {2, 0, 0}, 2, 2, 2},
        {{2, 1, 1, 2, 2},
         inPlane,
         {1.664100588676, 0, 0.5547001962252},
         1.442220510186,
         0.74995467,
         1.4422205},
        {{1, 2, 3, 2, 2}, {1, 0, 0}, {1, 0, 0}, 1, 1.0 / 9, 0.25},
        {{1, 2, 3, 2, 2},
         oblique,
         {0.1373605639487, 1.09888451159, 2.472490151076},
         2.426703296427,
         0.43637138,
         2.2075368},
        {{1, 1, 1, 4, 4}, {0, 0, 1}, {0, 0, 1}, 1, 0, 0},
        {{1, 1, 1, 4, 4}, inPlane, {0.797874688491, 0, 0.8781747250439}, 1.18126459313, NAN, NAN},
        {{1, 1, 1, 4, 4},
         oblique,
         {0.6378909522811, 0.8036922383165, 0.8036922383165},
         1.284219968516,
         1.6699826,
         2.4885148},
        {{1, 1, 1, 8, 8}, inPlane, {0.8968438039957, 0, 0.9344696548179}, 1.285682006252, NAN, NAN},
        {{1, 1, 1, 8, 8},
         oblique,
         {0.809629975957, 0.8939039664101, 0.8939039664101},
         1.461748613866,
         3.1418162,
         5.2205459}};
    for (const Row& row : rows) {
        const auto at = supportPoint(SuperquadricLanes<double>::from(row.shape), row.normal);
        EXPECT_NEAR(at.height, row.height, 2e-12);
        EXPECT_LT(norm(at.point - row.point), 3e-12);
        if (!(row.least == row.least)) continue;
        const TangentPlane<double> plane(row.normal);
        const Curvature<double> k = curvature(at, plane.u, plane.v);
        const double mean = 0.5 * (k.uu + k.vv), apart = std::sqrt(mean * mean - k.determinant());
        EXPECT_NEAR(mean - std::abs(apart), row.least, 2e-6);
        EXPECT_NEAR(mean + std::abs(apart), row.largest, 2e-6);
    }
}

/// The point is on the surface for random normals, and its normal is the one asked for, by pow(); no random
/// point of the surface lies higher.
TEST(SuperquadricSupport, isTheFarthestPoint) {
    support::Random random(3);
    for (const Superquadric& shape : someShapes)
        for (int k = 0; k < 200; ++k) {
            const Eigen::Vector3d n = random.direction();
            const auto at = supportPoint(SuperquadricLanes<double>::from(shape), toVector(n));
            const Eigen::Vector3d point = toEigen(at.point);
            // f grows by up to n/h times the error of the place (some ulp), with n <= 8.
            EXPECT_NEAR(inside(shape, point), 1, 2e-14);
            EXPECT_NEAR(at.height, point.dot(n), 1e-14);
            // The way back, by products: the normal errs by n - 1 times what the point does, relative.
            EXPECT_LT((toEigen(outwardNormal(SuperquadricLanes<double>::from(shape), at.point)) - n).norm(),
                      4e-14);
            for (int m = 0; m < 20; ++m) {
                const Eigen::Vector3d q = random.direction();
                const double scale = std::pow(inside(shape, q), -1.0 / shape.n1);
                EXPECT_LE(scale * q.dot(n), at.height + 1e-14);
            }
        }
}

/// Where normals differ by dn, points differ by A dn, with the radii of curvature A.
TEST(SuperquadricSupport, hasTheCurvatureOfItsDifferences) {
    support::Random random(5);
    for (const Superquadric& shape : someShapes)
        for (int k = 0; k < 50; ++k) {
            const auto lanes = SuperquadricLanes<double>::from(shape);
            const Vector<double> n = toVector(random.direction());
            if (std::min({std::abs(n.x), std::abs(n.y), std::abs(n.z)}) < 0.1) continue;  // near a flat place
            const TangentPlane<double> plane(n);
            const Curvature<double> radii = curvature(supportPoint(lanes, n), plane.u, plane.v).inverse();
            const double step = 1e-5;
            const auto to = [&](const Vector<double>& along, double h) {
                const Vector<double> m = n + h * along;
                return supportPoint(lanes, m * (1 / norm(m))).point;
            };
            const auto slope = [&](const Vector<double>& along) {
                return (0.5 / step) * (to(along, step) - to(along, -step));
            };
            // Central differences: step^2 / 0.1^2 relative, round-off / step.
            EXPECT_NEAR(dot(slope(plane.u), plane.u) / radii.uu, 1, 1e-6);
            EXPECT_NEAR(dot(slope(plane.v), plane.v) / radii.vv, 1, 1e-6);
            EXPECT_NEAR(dot(slope(plane.u), plane.v), radii.uv, 1e-6 * (radii.uu + radii.vv));
        }
}

TEST(SuperquadricSupport, givesTheSameBitsForEightAndForOne) {
    support::Random random(11);
    std::array<Vector<double>, 8> normals;
    for (auto& n : normals) n = toVector(random.direction());
    alignas(64) std::array<double, 8> x, y, z;
    SuperquadricLanes<Pack> lanes{};
    alignas(64) std::array<std::array<double, 8>, 5> of;
    for (std::size_t k = 0; k < 8; ++k) {
        x[k] = normals[k].x, y[k] = normals[k].y, z[k] = normals[k].z;
        const auto one = SuperquadricLanes<double>::from(someShapes[k]);
        of[0][k] = one.a, of[1][k] = one.b, of[2][k] = one.c, of[3][k] = one.n1, of[4][k] = one.n2;
    }
    lanes = {Pack::load(of[0].data()), Pack::load(of[1].data()), Pack::load(of[2].data()),
             Pack::load(of[3].data()), Pack::load(of[4].data()), false};
    const auto all = supportPoint(lanes, {Pack::load(x.data()), Pack::load(y.data()), Pack::load(z.data())});
    for (int k = 0; k < 8; ++k) {
        auto shape = SuperquadricLanes<double>::from(someShapes[static_cast<std::size_t>(k)]);
        shape.areEllipsoids = false;
        const auto one = supportPoint(shape, normals[static_cast<std::size_t>(k)]);
        EXPECT_EQ(all.height[k], one.height);
        EXPECT_EQ(all.point.x[k], one.point.x);
        EXPECT_EQ(all.point.z[k], one.point.z);
        EXPECT_EQ(all.xx[k], one.xx);
        EXPECT_EQ(all.xy[k], one.xy);
    }
}

// No point of the surface is outside of all balls; and they take much less room than one sphere where that is
// much too large.
TEST(Superquadric, isHeldByItsCoveringBalls) {
    std::vector<Superquadric> shapes = someShapes;
    shapes.push_back({1, 1, 0.2, 2, 2}), shapes.push_back({0.2, 1, 0.2, 8, 8});
    support::Random random(5);
    for (const Superquadric& s : shapes) {
        const std::vector<Ball> balls = coveringBalls(s);
        const auto isHeld = [&](const Eigen::Vector3d& p) {
            return std::ranges::any_of(balls, [&](const Ball& ball) {
                return (p - ball.centre).norm() < ball.radius * (1 + 1e-12);
            });
        };
        for (int k = 0; k < 20000; ++k) {
            const Eigen::Vector3d direction = random.direction();
            const Eigen::Vector3d point = direction / std::pow(inside(s, direction), 1.0 / s.n1);
            ASSERT_TRUE(isHeld(point)) << s.a << ' ' << s.b << ' ' << s.c << ' ' << s.n1 << ' ' << s.n2;
            ASSERT_TRUE(isHeld(random.uniform(0, 1) * point));
        }
        const double around = 4 * std::numbers::pi / 3 * std::pow(s.boundingRadius(), 3),
                     held = balls.size() == 1 ? around : unionOfSpheres(balls, 1e-3).volume;
        EXPECT_LE(held, around);
        if (around > 3 * s.volume()) {
            EXPECT_LT(held, 2 * s.volume());
        }
    }
    EXPECT_EQ(coveringBalls({1, 1, 1}).size(), 1u);
}

}  // namespace
}  // namespace pendular::superquadricTest
