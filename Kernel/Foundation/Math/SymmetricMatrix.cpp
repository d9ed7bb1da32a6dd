#include "Kernel/Foundation/Math/SymmetricMatrix.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace pendular {

namespace {

template <class Matrix>
double largestOf(const Matrix& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(symmetric, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()[symmetric.rows() - 1];
}

}  // namespace

double largestEigenvalueOf(const Eigen::Matrix3d& symmetric) { return largestOf(symmetric); }
double largestEigenvalueOf(const Matrix6d& symmetric) { return largestOf(symmetric); }

EigenSystem eigenSystem(const Eigen::Matrix3d& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::Vector3d solveSymmetric(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& right) {
    return matrix.ldlt().solve(right);
}

}  // namespace pendular
