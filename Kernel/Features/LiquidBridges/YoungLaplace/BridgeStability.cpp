#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeStability.h"

#include <Eigen/LU>
#include <cmath>

namespace pendular {

namespace {

/// d(psi)/d(parameters) at an end: psi = atan2(p, q).
Eigen::RowVector4d angleGradient(const ArcEnd& end) {
    Eigen::RowVector4d gradient;
    for (int j = 0; j < 4; ++j)
        gradient[j] = (end.point.axialPart * end.radialPart[j] - end.point.radialPart * end.axialPart[j]) /
                      end.point.squaredRadius;
    return gradient;
}

auto asRow(const ArcGradient& gradient) { return Eigen::Map<const Eigen::RowVector4d>(gradient.data()); }

/// How squared radii at both ends, axial extent and volume/pi change when a contact line moves along its
/// body.
Eigen::Vector4d contactMotion(const BodyContact& body, const ArcEnd& end, int side) {
    const double y = std::sqrt(end.point.squaredRadius), u = end.point.squaredRadius;
    const double rise = 2 * body.cosineOfFilling(end.point, side);  // d(u) = 2 y cos(beta)
    const double advance = body.curvature * y;                      // d(height) = sin(beta)
    return {side < 0 ? rise : 0, side < 0 ? 0 : rise, advance, u * advance};
}

int negativeEigenvalues(const Eigen::Matrix2d& matrix) {
    if (matrix.determinant() < 0) return 1;
    return matrix.trace() < 0 ? 2 : 0;
}

/// Derivatives of squared radii at both ends, axial extent and volume/pi by the parameters of the arc.
Eigen::Matrix4d pinnedDerivatives(const ArcEnd& left, const ArcEnd& right, const ArcIntegrals& integrals) {
    Eigen::Matrix4d matrix;
    matrix << asRow(left.squaredRadius), asRow(right.squaredRadius), asRow(integrals.axialExtentGradient),
        asRow(integrals.volumeGradient);
    return matrix;
}

/// Number of unstable modes with pinned contact lines, where it may exceed 1: the number of shorter arcs with
/// the same middle that are just neutral (Morse's index theorem; Bolza, Lectures on the Calculus of
/// Variations).
int conjugateArcs(const DelaunayArc& arc) {
    constexpr int samples = 32;
    DelaunayArc shorter = arc;
    int changes = 0;
    bool positive = true;
    for (int i = 1; i <= samples; ++i) {
        shorter.halfSpan = arc.halfSpan * i / samples;
        const Eigen::Matrix4d matrix =
            pinnedDerivatives(shorter.end(-1), shorter.end(1), integrate(shorter, mostQuadratureNodes));
        const bool now = matrix.partialPivLu().determinant() > 0;
        changes += now != positive;
        positive = now;
    }
    return changes;
}

/// An arc with one neck or bulge at most has one such mode at most: the disturbance by a shift along the axis
/// vanishes only where p = 0, and by Sturm's theorem two modes need two such places. Then a sign decides.
int pinnedModes(const DelaunayArc& arc, double determinant) {
    if (arc.extremes() >= 2) return conjugateArcs(arc);
    return determinant > 0 ? 0 : 1;
}

}  // namespace

double BridgeStability::product() const { return pinnedDeterminant * contactStiffness.determinant(); }

BridgeStability stabilityOf(const BridgeEquations& equations, const DelaunayArc& arc,
                            const BridgeGeometry& geometry) {
    const auto& [left, right, firstCap, secondCap, integrals] = geometry;
    const Eigen::Matrix4d pinned = pinnedDerivatives(left, right, integrals);
    Eigen::Matrix<double, 4, 2> motion;
    motion.col(0) = contactMotion(equations.first(), left, -1);
    motion.col(1) = contactMotion(equations.second(), right, 1);

    const Eigen::PartialPivLU<Eigen::Matrix4d> solver(pinned);
    const Eigen::Matrix<double, 4, 2> answer = solver.solve(motion);
    BridgeStability stability;
    stability.contactStiffness.row(0) = -angleGradient(left) * answer;
    stability.contactStiffness.row(1) = angleGradient(right) * answer;
    stability.contactStiffness(0, 0) += equations.first().curvature;
    stability.contactStiffness(1, 1) += equations.second().curvature;
    stability.contactStiffness.row(0) *= std::sqrt(left.point.squaredRadius);
    stability.contactStiffness.row(1) *= std::sqrt(right.point.squaredRadius);

    const double radius = std::sqrt(arc.squaredRadius()), length = arc.halfSpan;
    stability.pinnedDeterminant = solver.determinant() / std::pow(radius * length, 2) / radius;
    stability.unstableModes =
        pinnedModes(arc, stability.pinnedDeterminant) + negativeEigenvalues(stability.contactStiffness);
    return stability;
}

}  // namespace pendular
