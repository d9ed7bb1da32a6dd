#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeBranch.h"

#include <Eigen/LU>
#include <cmath>

namespace pendular {

namespace {

using Direction = BranchPoint::Direction;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

/// Lengths of a unit step in each unknown, near one point.
Direction unitsAt(const DelaunayArc& arc, double gap, const BridgeGeometry& geometry) {
    const double radius = std::sqrt(arc.squaredRadius());
    const double height = gap + geometry.firstCap.height + geometry.secondCap.height;
    return Direction(radius, radius, 1 / arc.halfSpan, arc.halfSpan, height);
}

/// The equations' derivatives by scaled steps, with one more row to be filled.
Matrix5d extended(const BridgeEquations::Value& value, const Direction& units) {
    Matrix5d matrix;
    matrix.topLeftCorner<4, 4>() = value.jacobian * units.head<4>().asDiagonal();
    matrix.topRightCorner<4, 1>() = value.gapSlope * units[4];
    return matrix;
}

}  // namespace

BranchPoint BridgeBranch::startAt(const DelaunayArc& arc, double gap) const {
    Direction towards = Direction::Zero();
    towards[4] = 1;
    return completed(arc, gap, equations_.at(arc, gap, mostQuadratureNodes), towards);
}

BranchPoint BridgeBranch::completed(const DelaunayArc& arc, double gap, const BridgeEquations::Value& value,
                                    const Direction& towards) const {
    Matrix5d matrix = extended(value, unitsAt(arc, gap, value.geometry));
    matrix.row(4) = towards.transpose();
    const Direction direction = matrix.partialPivLu().solve(Direction(0, 0, 0, 0, 1));
    return {arc, gap, stabilityOf(equations_, arc, value.geometry), direction.normalized()};
}

std::optional<BranchPoint> BridgeBranch::after(const BranchPoint& point, double distance) const {
    const BridgeEquations::Value here = equations_.at(point.arc, point.gap, mostQuadratureNodes);
    const Direction units = unitsAt(point.arc, point.gap, here.geometry);
    Direction moved = distance * point.direction;  // in units, from the point
    for (int iteration = 0; iteration < 10; ++iteration) {
        const Direction step = units.cwiseProduct(moved);
        const DelaunayArc arc = pendular::moved(point.arc, step.head<4>());
        const double gap = point.gap + step[4];
        if (!(arc.halfSpan > 0 && moved.norm() < 2)) return {};
        const BridgeEquations::Value value = equations_.at(arc, gap, mostQuadratureNodes);
        Matrix5d matrix = extended(value, units);
        matrix.row(4) = point.direction.transpose();
        Direction residual;
        residual << value.residual, point.direction.dot(moved) - distance;
        const Direction correction = matrix.partialPivLu().solve(residual);
        if (!(correction.norm() < 1)) return {};
        moved -= correction;
        if (correction.norm() < 1e-10) {
            const Direction last = units.cwiseProduct(moved);
            return completed(pendular::moved(point.arc, last.head<4>()), point.gap + last[4], value,
                             point.direction);
        }
    }
    return {};
}

}  // namespace pendular
