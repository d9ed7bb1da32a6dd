#include "Kernel/Shapes/UnionOfSpheres.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular {
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

// Of two spheres that cut each other: the caps' areas are 2 pi R h.
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
}  // namespace pendular
