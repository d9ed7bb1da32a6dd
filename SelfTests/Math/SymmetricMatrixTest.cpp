#include "Kernel/Foundation/Math/SymmetricMatrix.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <limits>
#include <random>

namespace pendular::symmetricMatrixTest {
namespace {

/// Q diag(values) Q^T with a random orthogonal Q: its eigenvalues are known.
template <class Matrix>
Matrix withEigenvalues(const Eigen::VectorXd& values, std::mt19937& random) {
    std::uniform_real_distribution<double> number(-1, 1);
    const Eigen::MatrixXd any =
        Eigen::MatrixXd::NullaryExpr(values.size(), values.size(), [&] { return number(random); });
    const Eigen::MatrixXd turn = any.householderQr().householderQ();
    const Eigen::MatrixXd made = turn * values.asDiagonal() * turn.transpose();
    return Matrix(0.5 * (made + made.transpose()));
}

/// Round-off of an eigenvalue: that of the products above and of the solver, n^2 operations of size |values|.
constexpr double roundOff = 36 * 4 * std::numeric_limits<double>::epsilon();

TEST(SymmetricMatrix, hasTheEigenvaluesThatItWasMadeOf) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-3, 5);
    for (int run = 0; run < 200; ++run) {
        const Eigen::Vector3d three = Eigen::Vector3d::NullaryExpr([&] { return number(random); });
        const Eigen::VectorXd six = Eigen::VectorXd::NullaryExpr(6, [&] { return number(random); });
        const auto a = withEigenvalues<Eigen::Matrix3d>(three, random);
        EXPECT_NEAR(largestEigenvalueOf(a), three.maxCoeff(), 5 * roundOff);
        EXPECT_NEAR(largestEigenvalueOf(withEigenvalues<Matrix6d>(six, random)), six.maxCoeff(),
                    5 * roundOff);
        const EigenSystem system = eigenSystem(a);
        EXPECT_LE(system.values[0], system.values[1]);
        EXPECT_LE(system.values[1], system.values[2]);
        EXPECT_LT((a * system.vectors - system.vectors * system.values.asDiagonal()).norm(), 5 * roundOff);
    }
}

TEST(SymmetricMatrix, solvesSystems) {
    std::mt19937 random(2);
    const auto definite = withEigenvalues<Eigen::Matrix3d>(Eigen::Vector3d(0.5, 2, 7), random);
    const Eigen::Vector3d right(1, -2, 0.3);
    EXPECT_LT((definite * solveSymmetric(definite, right) - right).norm(), 5 * roundOff);
    // A body that is held along an axis does not answer there: zero rows, and the rest as before.
    Eigen::Matrix3d held = Eigen::Matrix3d::Zero();
    held(1, 1) = 4;
    const Eigen::Vector3d solution = solveSymmetric(held, {0, 2, 0});
    EXPECT_DOUBLE_EQ(solution.y(), 0.5);
    EXPECT_EQ(solution.x(), 0);
    EXPECT_EQ(solution.z(), 0);
}

}  // namespace
}  // namespace pendular::symmetricMatrixTest
