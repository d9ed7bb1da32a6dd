#pragma once

/// Eigenvalues and linear systems of small symmetric matrices. Eigen's solvers for them are compiled here and
/// nowhere else: each file that instantiates one takes seconds longer to compile.

#include <Eigen/Core>

namespace pendular {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The largest eigenvalue of a symmetric matrix.
[[nodiscard]] double largestEigenvalueOf(const Eigen::Matrix3d& symmetric);
[[nodiscard]] double largestEigenvalueOf(const Matrix6d& symmetric);

struct EigenSystem {
    Eigen::Vector3d values;   // in increasing order
    Eigen::Matrix3d vectors;  // unit, one in each column
};
[[nodiscard]] EigenSystem eigenSystem(const Eigen::Matrix3d& symmetric);

/// x in matrix x = right, of a symmetric matrix that is positive or negative semidefinite (LDL^T with pivots;
/// of a singular one, a solution where there is one).
[[nodiscard]] Eigen::Vector3d solveSymmetric(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right);

}  // namespace pendular
