#include "Kernel/Features/RigidBodies/UnionOfSpheres.h"

#include "Kernel/Features/RigidBodies/SphereGroups.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::unionOfSpheresTest {
namespace {

constexpr double pi = std::numbers::pi;
const double height = std::sqrt(0.75);  // of an equilateral triangle

struct KnownShape {
    std::string name;
    std::vector<Ball> spheres;
    double volume;
    Eigen::Vector3d principal;
};
/// From programs that share nothing with this one (shared/data/scenes-and-shapes/clump_inertia.csv), 12
/// digits.
std::vector<KnownShape> knownShapes() {
    return {{"dimer",
             {{{0, 0, -0.5}, 1}, {{0, 0, 0.5}, 1}},
             7.06858347058,
             {3.004147975, 5.21308030955, 5.21308030955}},
            {"rod of 4",
             {{{0, 0, -1.2}, 1}, {{0, 0, -0.4}, 1}, {{0, 0, 0.4}, 1}, {{0, 0, 1.2}, 1}},
             11.3264887137,
             {5.06260535183, 16.6119377045, 16.6119377045}},
            {"bent trimer",
             {{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{0, 1, 0}, 1}},
             9.83075054183,
             {5.74449160088, 8.29652146178, 9.73061752058}},
            {"tetrahedron",
             {{{0, 0, 0}, 1},
              {{1.2, 0, 0}, 1},
              {{0.6, 1.2 * height, 0}, 1},
              {{0.6, 0.4 * height, 1.2 * std::sqrt(2.0 / 3)}, 1}},
             12.6700468663,
             {11.3916637116, 11.3916637116, 11.3916637116}}};
}
Eigen::Vector3d principalOf(const MassProperties& p) {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(p.inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

TEST(UnionOfSpheres, agreesWithTheTablesWithinItsBound) {
    for (const KnownShape& shape : knownShapes()) {
        for (const double tolerance : {1e-3, 1e-10}) {
            const MassProperties p = unionOfSpheres(shape.spheres, tolerance);
            const double digits = 1e-11 + p.error;  // of the tables, and what is promised
            EXPECT_LT(p.error, 50 * tolerance) << shape.name;
            EXPECT_LT(std::abs(p.volume / shape.volume - 1), digits) << shape.name;
            EXPECT_LT((principalOf(p) - shape.principal).cwiseAbs().maxCoeff(), digits * shape.principal[2])
                << shape.name;
        }
    }
    // A bent trimer's centre.
    const MassProperties trimer = unionOfSpheres(knownShapes()[2].spheres);
    EXPECT_NEAR((trimer.centre - Eigen::Vector3d(0.350338125503, 0.350338125503, 0)).norm(), 0, 1e-11);
}

// Two spheres cut each other: the caps' areas are 2 pi R h.
TEST(UnionOfSpheres, surfaceIsThatOfTheCapsThatAreLeft) {
    EXPECT_NEAR(surfaceOfUnion(knownShapes()[0].spheres), 2 * 4 * pi - 2 * 2 * pi * 0.5, 1e-7);
    EXPECT_NEAR(surfaceOfUnion(std::vector<Ball>{Ball{{3, 2, 1}, 2}}), 16 * pi, 1e-7);
}

// What a turn, a shift, another unit and spheres within others may not change. The bound must hold for each.
TEST(UnionOfSpheres, doesNotDependOnFrameUnitOrHiddenSpheres) {
    support::Random random(3);
    std::vector<Ball> spheres;
    for (int k = 0; k < 12; ++k)
        spheres.push_back({Eigen::Vector3d(random.inCube(1)), random.uniform(0.3, 0.8)});
    const MassProperties p = unionOfSpheres(spheres);
    const Eigen::Matrix3d turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized().toRotationMatrix();
    const Eigen::Vector3d shift(5, -3, 8);
    constexpr double unit = 1e-4;
    std::vector<Ball> moved;
    for (const Ball& ball : spheres)
        moved.push_back({unit * (turn * ball.centre + shift), unit * ball.radius});
    moved.push_back({moved[0].centre, 0.5 * moved[0].radius});  // within one
    moved.push_back(moved[3]);                                  // twice
    const MassProperties q = unionOfSpheres(moved);
    const double promised = p.error + q.error;
    EXPECT_LT(promised, 1e-8);
    EXPECT_LT(std::abs(q.volume / (unit * unit * unit * p.volume) - 1), promised);
    EXPECT_LT((q.centre / unit - turn * p.centre - shift).norm(), 1e-9);
    const Eigen::Matrix3d expected = std::pow(unit, 5) * turn * p.inertia * turn.transpose();
    EXPECT_LT((q.inertia - expected).cwiseAbs().maxCoeff(), promised * expected.norm());
}

TEST(UnionOfSpheres, ofSpheresApartIsTheirSum) {
    const std::vector<Ball> apart{{{-3, 0, 0}, 1}, {{3, 0, 0}, 1}};
    const MassProperties p = unionOfSpheres(apart);
    const double v = 4.0 / 3 * pi;
    EXPECT_NEAR(p.volume, 2 * v, 1e-12);
    EXPECT_NEAR(p.inertia(0, 0), 2 * 0.4 * v, 1e-11);
    EXPECT_NEAR(p.inertia(1, 1), 2 * (0.4 + 9) * v, 1e-10);
}

/// Adds parts that have no point in common, by Steiner's theorem.
MassProperties sumOfParts(const std::vector<MassProperties>& parts) {
    MassProperties sum;
    for (const MassProperties& part : parts)
        sum.volume += part.volume, sum.centre += part.volume * part.centre;
    sum.centre /= sum.volume;
    for (const MassProperties& part : parts) {
        const Eigen::Vector3d arm = part.centre - sum.centre;
        sum.inertia += part.inertia + part.volume * (arm.squaredNorm() * Eigen::Matrix3d::Identity() -
                                                     arm * arm.transpose());
    }
    return sum;
}

// However far apart they are: in one integral over the height the spheres would be needles, whose moments are
// below round-off of what is to be integrated, and it would not end.
TEST(UnionOfSpheres, endsForSpheresFarApart) {
    const double v = 4.0 / 3 * pi;
    for (const double distance : {100.0, 1e4, 1e9}) {
        const MassProperties p = unionOfSpheres(std::vector<Ball>{{{0, 0, 0}, 1}, {{distance, 0, 0}, 1}});
        EXPECT_NEAR(p.volume, 2 * v, 1e-14 * v);
        EXPECT_EQ(p.centre.x(), 0.5 * distance);
        EXPECT_NEAR(p.inertia(0, 0), 0.8 * v, 1e-14 * v);
        EXPECT_NEAR(p.inertia(1, 1) / (0.8 * v + 0.5 * v * distance * distance), 1, 1e-14);
    }
    // Clusters that are apart: each is what it is alone.
    std::vector<Ball> all;
    std::vector<MassProperties> parts;
    for (const KnownShape& shape : knownShapes()) {
        std::vector<Ball> moved = shape.spheres;
        const auto k = static_cast<double>(parts.size());
        for (Ball& ball : moved) ball.centre += Eigen::Vector3d(1000 * k, -70 * k * k, 30);
        parts.push_back(unionOfSpheres(moved));
        all.insert(all.end(), moved.begin(), moved.end());
    }
    const MassProperties p = unionOfSpheres(all), expected = sumOfParts(parts);
    EXPECT_NEAR(p.volume / expected.volume, 1, 1e-14);
    EXPECT_LT((p.centre - expected.centre).norm(), 1e-14 * expected.centre.norm());
    EXPECT_LT((p.inertia - expected.inertia).norm(), 1e-14 * expected.inertia.norm());
}

// 120 spheres of radius 1, 1.5 apart, along a slanted line: 120 spheres less 119 lenses, of pi (4 + d) (2 -
// d)^2 / 12 each. In units of its length a sphere is 1/180, so that the moments of one are below the
// round-off of the whole.
TEST(UnionOfSpheres, endsForALongChain) {
    constexpr double d = 1.5;
    constexpr int count = 120;
    const Eigen::Vector3d along = Eigen::Vector3d(3, -1, 2).normalized();
    std::vector<Ball> chain;
    for (int k = 0; k < count; ++k) chain.push_back({k * d * along, 1});
    const MassProperties p = unionOfSpheres(chain);
    const double lens = pi * (4 + d) * (2 - d) * (2 - d) / 12;
    EXPECT_NEAR(p.volume / (count * 4.0 / 3 * pi - (count - 1) * lens), 1, 1e-10);
    EXPECT_LT((p.centre - 0.5 * (count - 1) * d * along).norm(), 1e-8);
    // A cap of height h = 1 - d/2 is left at each end: the sphere's surface less 2 pi h for each neighbour.
    EXPECT_NEAR(surfaceOfUnion(chain), count * 4 * pi - 2 * (count - 1) * 2 * pi * (1 - 0.5 * d), 1e-9);
}

// Two that cut each other keep 1/2 + (d^2 + r^2 - s^2) / (4 d r) of their surfaces (the caps' heights).
TEST(UnionOfSpheres, exposedSharesAreThoseOfCaps) {
    const std::vector<Ball> two{{{0, 0, 0}, 1}, {{0.3, 0.9, -0.4}, 0.6}};
    const double d = two[1].centre.norm();
    const std::vector<double> shares = exposedShares(two);
    EXPECT_NEAR(shares[0], 0.5 + (d * d + 1 - 0.36) / (4 * d), 1e-15);
    EXPECT_NEAR(shares[1], 0.5 + (d * d + 0.36 - 1) / (4 * d * 0.6), 1e-15);
    // Within another one; the second of two that are the same; apart.
    EXPECT_EQ(
        exposedShares(std::vector<Ball>{{{0, 0, 0}, 1}, {{0.1, 0, 0}, 0.5}, {{0, 0, 0}, 1}, {{5, 0, 0}, 1}}),
        (std::vector<double>{1, 0, 0, 1}));
    // Equal spheres to round-off count as the first one.
    EXPECT_EQ(exposedShares(std::vector<Ball>{{{0, 0, 0}, 1}, {{1e-17, 0, 0}, 1}, {{0, 1e-16, 0}, 1}}),
              (std::vector<double>{1, 0, 0}));
    EXPECT_NEAR(surfaceOfUnion(std::vector<Ball>{{{0.3, 0, 0}, 1}, {{0.1 + 0.2, 0, 0}, 1}}), 4 * pi, 1e-14);
}

/// The share of evenly spread points (a spiral of golden angles) of a sphere that are in no other one.
double shareByPoints(const std::vector<Ball>& spheres, std::size_t own, int count) {
    int free = 0;
    for (int k = 0; k < count; ++k) {
        const double z = 1 - (2 * k + 1.0) / count, angle = k * pi * (3 - std::sqrt(5.0)),
                     rho = std::sqrt(1 - z * z);
        const Eigen::Vector3d at =
            spheres[own].centre +
            spheres[own].radius * Eigen::Vector3d(rho * std::cos(angle), rho * std::sin(angle), z);
        bool isFree = true;
        for (std::size_t other = 0; other < spheres.size(); ++other)
            isFree &= other == own || (at - spheres[other].centre).norm() >= spheres[other].radius;
        free += isFree ? 1 : 0;
    }
    return static_cast<double>(free) / count;
}

// Caps overlap here. The spiral's error is that of the points along the rims of the caps: some hundred points
// of spacing 1/sqrt(N), half of which may be on the wrong side.
TEST(UnionOfSpheres, exposedSharesAreThoseOfPoints) {
    support::Random random(11);
    std::vector<Ball> spheres;
    for (int k = 0; k < 12; ++k)
        spheres.push_back({Eigen::Vector3d(random.inCube(1)), random.uniform(0.4, 0.8)});
    const std::vector<double> shares = exposedShares(spheres);
    constexpr int count = 100000;
    int between = 0;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        EXPECT_NEAR(shares[k], shareByPoints(spheres, k, count), 3 / std::sqrt(count)) << k;
        between += shares[k] > 0.02 && shares[k] < 0.98 ? 1 : 0;
    }
    EXPECT_GT(between, 5);
}

TEST(SphereGroups, nameTheSphereThatIsApart) {
    std::vector<Ball> spheres{{{0, 0, 0}, 1}, {{2, 0, 0}, 1}, {{9, 0, 0}, 1}, {{0, 1.9, 0}, 1}};
    EXPECT_EQ(groupsOfSpheres(spheres, 1e-9), (std::vector<std::vector<std::size_t>>{{0, 1, 3}, {2}}));
    const auto sentence = gapInClump(spheres);
    ASSERT_TRUE(sentence);
    EXPECT_TRUE(
        support::contains(*sentence, "sphere 2 (counted from 0; centre 9 0 0, radius 1 m) is 5 m away"));
    EXPECT_TRUE(support::contains(*sentence, "2 groups"));
    // The larger group is the clump, whichever comes first.
    std::swap(spheres[0], spheres[2]);
    EXPECT_TRUE(support::contains(gapInClump(spheres).value_or(""), "sphere 0"));
    spheres[0].centre.x() = 4 + 1e-4;  // as a file may round it
    EXPECT_EQ(gapInClump(spheres), std::nullopt);
    EXPECT_EQ(gapInClump(std::vector<Ball>{{{1, 2, 3}, 1}}), std::nullopt);
}

TEST(UnionOfSpheres, refusesWhatIsNoSphere) {
    const auto refused = [](const std::vector<Ball>& spheres) {
        const std::string text = support::refusal([&] { static_cast<void>(unionOfSpheres(spheres)); });
        EXPECT_TRUE(support::isOneSentence(text));
        return text;
    };
    EXPECT_TRUE(support::contains(refused({}), "at least one sphere"));
    EXPECT_TRUE(support::contains(refused({{{0, 0, 0}, 1}, {{1, 0, 0}, 0}}), "sphere 1"));
    EXPECT_TRUE(support::contains(refused({{{0, std::nan(""), 0}, 1}}), "sphere 0"));
    EXPECT_TRUE(
        support::contains(refused({{{0, 0, 0}, std::numeric_limits<double>::infinity()}}), "sphere 0"));
}

}  // namespace
}  // namespace pendular::unionOfSpheresTest
