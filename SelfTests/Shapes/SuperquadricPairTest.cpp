#include "Kernel/Features/Superquadrics/SuperquadricPair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Foundation/Math/EigenConversion.h"
#include "SelfTests/Support/Random.h"

namespace pendular::superquadricPairTest {
namespace {

struct Body {
    Superquadric shape;
    Eigen::Vector3d centre, rotation;  // m; rad, a rotation vector
};

Quaternion quaternionOf(const Eigen::Vector3d& rotation) {
    const double angle = rotation.norm();
    if (angle == 0) return {};
    return {std::cos(0.5 * angle), toVector(Eigen::Vector3d(std::sin(0.5 * angle) / angle * rotation))};
}
SuperquadricPair<double> pairOf(const Body& a, const Body& b) {
    return {SuperquadricLanes<double>::from(a.shape), SuperquadricLanes<double>::from(b.shape),
            Axes<double>(quaternionOf(a.rotation)), Axes<double>(quaternionOf(b.rotation)),
            toVector(Eigen::Vector3d(b.centre - a.centre))};
}
SuperquadricTouch<double> touchOf(const SuperquadricPair<double>& pair) {
    return findTouch(pair, firstNormal(pair), infinity);
}

struct Row {
    Body first, second;
    double depth;  // m
    Vector<double> normal;
    double podlozhnyuk;  // m, the overlap through the least point of F1 + F2; negative apart
};
/// shared/data/scenes-and-shapes/superquadric_pairs.csv
const std::vector<Row> rows{{{{1, 1, 1, 2, 2}, {0, 0, 0}, {0, 0, 0}},
                             {{0.6, 0.6, 0.6, 2, 2}, {1.5, 0.3, 0.2}, {0.4, 0, 0}},
                             0.05727513795,
                             {0.97230559, 0.19446112, 0.12964074},
                             0.05727513795},
                            {{{1, 2, 3, 2, 2}, {0, 0, 0}, {0, 0, 0}},
                             {{1.5, 1, 0.7, 2, 2}, {0, 0, 3.65}, {0, 0, 0.7}},
                             0.05,
                             {0, 0, 1},
                             0.05},
                            {{{0.5, 0.5, 1, 2, 2}, {0, 0, 0}, {0.3, 0.5, 0.1}},
                             {{0.5, 0.5, 1, 2, 2}, {0.75, 0.55, 0.35}, {-0.4, 0.2, 0.9}},
                             0.1446957441,
                             {0.78651046, 0.61164174, -0.085414743},
                             0.144685172},
                            {{{1, 1, 1, 4, 4}, {0, 0, 0}, {0.2, 0.3, 0.1}},
                             {{1, 1, 1, 4, 4}, {1.9, 0.4, 0.5}, {0.7, -0.2, 0.4}},
                             0.2449242836,
                             {0.95031545, 0.20270163, 0.23624689},
                             0.2431178169},
                            {{{1, 1, 1, 8, 2}, {0, 0, 0}, {0.5, 0.1, 0}},
                             {{1, 1, 1, 4, 4}, {0.4, 0.5, 2.1}, {0.1, 0.7, 0.2}},
                             0.2969978839,
                             {0.29462115, -0.020617047, 0.95539171},
                             0.2945429886},
                            {{{1, 1, 0.5, 2, 2}, {0, 0, 0}, {0.2, -0.1, 0}},
                             {{1, 1, 0.5, 2, 2}, {0.9, 0.5, 1.2}, {0.6, 0.9, 0}},
                             -0.02256730702,
                             {0.51186898, -0.021410356, 0.85879669},
                             -0.0226442583}};

TEST(SuperquadricPair, hasTheDepthOfTheTable) {
    for (const Row& row : rows) {
        const auto touch = touchOf(pairOf(row.first, row.second));
        EXPECT_TRUE(touch.isFound);
        EXPECT_NEAR(touch.depth, row.depth, 1e-10);        // 10 digits
        EXPECT_LT(norm(touch.normal - row.normal), 3e-8);  // 8 digits, three of them
        // Podlozhnyuk's overlap is a section through both, along a normal of its own: that of light contacts
        // agrees to 1 %, and it is never the least shift that parts them.
        EXPECT_NEAR(row.podlozhnyuk, touch.depth, 0.01 * std::abs(touch.depth) + 1e-10);
    }
}

/// A pair is seen from the other body, too, and in a turned frame.
TEST(SuperquadricPair, isTheSameFromBothSides) {
    for (const Row& row : rows) {
        const auto touch = touchOf(pairOf(row.first, row.second)),
                   back = touchOf(pairOf(row.second, row.first));
        EXPECT_NEAR(touch.depth, back.depth, 1e-14);
        EXPECT_LT(norm(touch.normal + back.normal), 1e-8);
        const Vector<double> shift = toVector(Eigen::Vector3d(row.second.centre - row.first.centre));
        EXPECT_LT(norm(touch.arm1 - shift - back.arm1), 1e-7);
    }
}

/// Spheres as superquadrics: depth, normal, place and R1 R2 / (R1 + R2), to round-off.
TEST(SuperquadricPair, isASphereInTheLimit) {
    support::Random random(2);
    for (int k = 0; k < 200; ++k) {
        const double r = random.uniform(0.5, 1), s = random.uniform(0.5, 1),
                     distance = (r + s) * random.uniform(0.8, 1.1);
        const Eigen::Vector3d n = random.direction(), d = distance * n;
        const Body a{{r, r, r, 2, 2}, {0, 0, 0}, random.direction()},
            b{{s, s, s, 2, 2}, d, random.direction()};
        const auto touch = touchOf(pairOf(a, b));
        EXPECT_NEAR(touch.depth, r + s - distance, 1e-12);
        EXPECT_LT(norm(touch.normal - toVector(n)), 1e-12);
        EXPECT_LT(norm(touch.arm1 - (r - 0.5 * touch.depth) * toVector(n)), 1e-12);
        EXPECT_NEAR(touch.radius, r * s / (r + s), 1e-12);
    }
}

TEST(SuperquadricPair, ofOneCentreHasADepth) {
    const Body ball{{0.5, 0.5, 0.5, 2, 2}, {0, 0, 0}, {0, 0, 0}},
        block{{1, 2, 3, 4, 4}, {0, 0, 0}, {0, 0, 0}};
    EXPECT_NEAR(touchOf(pairOf(ball, ball)).depth, 1, 1e-12);
    EXPECT_TRUE(std::isfinite(touchOf(pairOf(ball, block)).depth));
    EXPECT_NEAR(norm(touchOf(pairOf(block, ball)).normal), 1, 1e-12);
}

/// Ellipsoids that meet with their tips or sides, on a common axis: a closed form. Curvatures at the end of a
/// are a/b^2 and a/c^2, so that Gauss' radius follows.
TEST(SuperquadricPair, agreesWithTheClosedFormOnAnAxis) {
    const Body a{{1, 2, 3, 2, 2}, {0, 0, 0}, {0, 0, 0}};
    for (const double turn : {0.0, 0.4, 1.2}) {
        const Body b{{2, 0.5, 0.7, 2, 2}, {2.95, 0, 0}, {turn, 0, 0}};
        const auto touch = touchOf(pairOf(a, b));
        EXPECT_NEAR(touch.depth, 0.05, 1e-14);
        // K1 = diag(1/4, 1/9); K2 = diag(8, 2/0.49) turned.
        Eigen::Matrix2d k1, k2;
        k1 << 0.25, 0, 0, 1.0 / 9;
        k2 << 8, 0, 0, 2 / 0.49;
        const Eigen::Matrix2d r = Eigen::Rotation2Dd(turn).toRotationMatrix();
        const Eigen::Matrix2d sum = k1 + r * k2 * r.transpose();
        EXPECT_NEAR(touch.radius, 1 / std::sqrt(sum.determinant()), 1e-12);
    }
}

/// The least F over a sphere of normals, with no use of derivatives: the best of a grid, then the best of
/// eight directions about it, at steps that are halved where none is better.
double leastByBruteForce(const SuperquadricPair<double>& pair) {
    const auto value = [&](const Vector<double>& n) { return SlabOverlap<double>(pair, n).value; };
    constexpr int rings = 40;
    Vector<double> best{0, 0, 1};
    double least = infinity;
    for (int k = 0; k < rings * 2 * rings; ++k) {
        const double z = -1 + (2 * (k / (2 * rings)) + 1.0) / rings,
                     angle = std::numbers::pi * (k % (2 * rings)) / rings;
        const double across = std::sqrt(1 - z * z);
        const Vector<double> n{across * std::cos(angle), across * std::sin(angle), z};
        if (const double there = value(n); there < least) least = there, best = n;
    }
    for (double step = 0.05; step > 1e-9;) {
        const TangentPlane<double> plane(best);
        bool moved = false;
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.25 * std::numbers::pi * k;
            const Vector<double> n = superquadric::unit(best + step * std::cos(angle) * plane.u +
                                                        step * std::sin(angle) * plane.v);
            if (const double there = value(n); there < least) least = there, best = n, moved = true;
        }
        if (!moved) step *= 0.5;
    }
    return least;
}

Body randomBody(support::Random& random, bool isEllipsoid, double mostAspect) {
    const auto half = [&] { return std::pow(mostAspect, random.uniform(-0.5, 0.5)); };
    const auto exponent = [&] {
        return isEllipsoid ? 2 : std::min(8, 2 + static_cast<int>(random.uniform(0, 7)));
    };
    return {{half(), half(), half(), exponent(), exponent()}, {0, 0, 0}, 3 * random.direction()};
}

/// Random pairs that overlap by up to 5 % of the shortest half length, or are apart by as much.
void compareWithBruteForce(bool isEllipsoid, double mostAspect, int count) {
    support::Random random(17);
    for (int k = 0; k < count; ++k) {
        const Body a = randomBody(random, isEllipsoid, mostAspect);
        Body b = randomBody(random, isEllipsoid, mostAspect);
        const double least = std::min({a.shape.a, a.shape.b, a.shape.c, b.shape.a, b.shape.b, b.shape.c});
        const Eigen::Vector3d way = random.direction();
        // How far along the way they touch: by bisection of their depth.
        double low = 0, high = 2 * mostAspect * 4;
        for (int step = 0; step < 50; ++step) {
            const double middle = 0.5 * (low + high);
            b.centre = middle * way;
            (touchOf(pairOf(a, b)).depth > 0 ? low : high) = middle;
        }
        b.centre = (low - random.uniform(-0.05, 0.05) * least) * way;
        const auto pair = pairOf(a, b);
        const auto touch = touchOf(pair);
        // F at the normal that was found is no less than the least F, and no more than what brute force
        // finds: so it is the least, up to the round-off of lengths of some metres.
        EXPECT_NEAR(touch.depth, SlabOverlap<double>(pair, touch.normal).value, 1e-15) << k;
        const double byForce = leastByBruteForce(pair);
        EXPECT_LT(touch.depth, byForce + 1e-14) << k;
        // Brute force itself ends within this, but in the valleys of sharp edges.
        if (isEllipsoid) {
            EXPECT_GT(touch.depth, byForce - 1e-13) << k;
        }
    }
}
TEST(SuperquadricPair, hasTheDepthOfBruteForceForEllipsoids) { compareWithBruteForce(true, 5, 20); }
TEST(SuperquadricPair, hasTheDepthOfBruteForceForAll) { compareWithBruteForce(false, 3, 8); }

/// From the line of centres, without Newton's method.
TEST(SuperquadricPair, fallsBackSafely) {
    for (const Row& row : rows) {
        const auto pair = pairOf(row.first, row.second);
        Vector<double> normal = superquadric::unit(pair.shift);
        SlabOverlap<double> best(pair, normal);
        searchAround(pair, true, normal, best);
        // It may stop in a valley, never below the least value: 0.1 % of an overlap of 1e-3 of the size.
        EXPECT_GT(best.value, row.depth - 1e-9);
        EXPECT_LT(best.value, row.depth + 1e-6);
    }
}

/// Eight different pairs at once: each as it is alone, to the bit.
TEST(SuperquadricPair, givesTheSameBitsForEightAndForOne) {
    std::array<SuperquadricPair<double>, 8> pairs{
        pairOf(rows[3].first, rows[3].second), pairOf(rows[4].first, rows[4].second),
        pairOf(rows[4].second, rows[4].first), pairOf(rows[3].second, rows[3].first),
        pairOf(rows[3].first, rows[4].second), pairOf(rows[4].first, rows[3].second),
        pairOf(rows[3].first, rows[3].second), pairOf(rows[4].second, rows[3].first)};
    constexpr std::size_t numbers = 2 * 5 + 2 * 9 + 3;
    const auto numbersOf = [](const SuperquadricPair<double>& p) {
        const auto &s = p.shape1, &t = p.shape2;
        std::array<double, numbers> all{s.a, s.b, s.c, s.n1, s.n2, t.a, t.b, t.c, t.n1, t.n2};
        std::size_t k = 10;
        for (const Vector<double>& v :
             {p.axes1.x, p.axes1.y, p.axes1.z, p.axes2.x, p.axes2.y, p.axes2.z, p.shift})
            all[k++] = v.x, all[k++] = v.y, all[k++] = v.z;
        return all;
    };
    std::array<Pack, numbers> lanes;
    for (std::size_t k = 0; k < numbers; ++k) {
        alignas(64) std::array<double, 8> column;
        for (std::size_t lane = 0; lane < 8; ++lane) column[lane] = numbersOf(pairs[lane])[k];
        lanes[k] = Pack::load(column.data());
    }
    const auto vector = [&](std::size_t k) {
        return Vector<Pack>{lanes[10 + 3 * k], lanes[11 + 3 * k], lanes[12 + 3 * k]};
    };
    Axes<Pack> axes1{QuaternionOf<Pack>{}}, axes2 = axes1;
    axes1.x = vector(0), axes1.y = vector(1), axes1.z = vector(2);
    axes2.x = vector(3), axes2.y = vector(4), axes2.z = vector(5);
    const SuperquadricPair<Pack> eight{{lanes[0], lanes[1], lanes[2], lanes[3], lanes[4], false},
                                       {lanes[5], lanes[6], lanes[7], lanes[8], lanes[9], false},
                                       axes1,
                                       axes2,
                                       vector(6)};
    const auto found = findTouch(eight, firstNormal(eight), 0.0);
    for (std::size_t lane = 0; lane < 8; ++lane) {
        const auto one = findTouch(pairs[lane], firstNormal(pairs[lane]), 0.0);
        const int k = static_cast<int>(lane);
        EXPECT_EQ(found.depth[k], one.depth);
        EXPECT_EQ(found.normal.x[k], one.normal.x);
        EXPECT_EQ(found.arm1.y[k], one.arm1.y);
        EXPECT_EQ(found.radius[k], one.radius);
    }
}

/// Up to a gap the nearest points are known; beyond it only that the shapes are farther apart.
TEST(SuperquadricPair, isKnownUpToAGap) {
    support::Random random(11);
    int apart = 0, farther = 0;
    for (int k = 0; k < 300; ++k) {
        const Body a = randomBody(random, false, 5);
        Body b = randomBody(random, false, 5);
        b.centre = random.uniform(1.5, 4) * random.direction();
        const auto pair = pairOf(a, b);
        const double gap = random.uniform(0, 1.5);
        const auto whole = findTouch(pair, firstNormal(pair), infinity),
                   near = findTouch(pair, firstNormal(pair), gap);
        if (boxesAreApart(pair, gap)) {
            EXPECT_LT(whole.depth, -gap);
        }
        if (whole.depth < -gap) {
            EXPECT_LT(near.depth, -gap);
            ++farther;
            continue;
        }
        apart += whole.depth < 0 ? 1 : 0;
        EXPECT_EQ(near.depth, whole.depth);
        EXPECT_EQ(near.normal.z, whole.normal.z);
        EXPECT_EQ(near.radius, whole.radius);
    }
    EXPECT_GT(apart, 30);
    EXPECT_GT(farther, 30);
}

/// A box that is between two shapes proves them apart; touching shapes are never told to be.
TEST(SuperquadricPair, boxesAreApartOnlyWhereShapesAre) {
    support::Random random(9);
    int told = 0;
    for (int k = 0; k < 300; ++k) {
        const Body a = randomBody(random, false, 5);
        Body b = randomBody(random, false, 5);
        b.centre = random.uniform(0.5, 4) * random.direction();
        const auto pair = pairOf(a, b);
        if (!boxesAreApart(pair)) continue;
        ++told;
        EXPECT_LT(findTouch(pair, firstNormal(pair), 0.0).depth, 0);
    }
    EXPECT_GT(told, 30);
    EXPECT_LT(told, 270);
}

}  // namespace
}  // namespace pendular::superquadricPairTest
