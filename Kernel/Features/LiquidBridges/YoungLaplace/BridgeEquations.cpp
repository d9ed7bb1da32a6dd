#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeEquations.h"

#include <numbers>

namespace pendular {

namespace {

auto row(const ArcGradient& gradient) { return Eigen::Map<const Eigen::RowVector4d>(gradient.data()); }

}  // namespace

BridgeEquations::BridgeEquations(const BridgeConditions& conditions)
    : first_(conditions.first),
      second_(conditions.second),
      volumeOverPi_(conditions.volume / std::numbers::pi),
      symmetric_(conditions.first.radius == conditions.second.radius &&
                 conditions.first.contactAngle == conditions.second.contactAngle) {}

BridgeEquations::Value BridgeEquations::at(const DelaunayArc& arc, double gap, int mostNodes) const {
    Value value{.residual = {},
                .jacobian = {},
                .gapSlope = {},
                .geometry = BridgeGeometry(arc, first_, second_, mostNodes)};
    const auto& [left, right, firstCap, secondCap, integrals] = value.geometry;
    const double perRadius = 1 / std::sqrt(0.5 * (left.point.squaredRadius + right.point.squaredRadius));
    const double perHeight = 1 / (gap + firstCap.height + secondCap.height);
    const double perVolume = 1 / volumeOverPi_;

    const double extent = integrals.axialExtent - firstCap.height - secondCap.height;
    const double volume = integrals.volumeOverPi - firstCap.volumeOverPi - secondCap.volumeOverPi;
    value.residual << perRadius * first_.mismatch(left.point, -1),
        perRadius * second_.mismatch(right.point, 1), perHeight * (extent - gap),
        perVolume * (volume - volumeOverPi_);
    value.jacobian.row(0) = perRadius * row(first_.mismatchGradient(left, -1));
    value.jacobian.row(1) = perRadius * row(second_.mismatchGradient(right, 1));
    value.jacobian.row(2) = perHeight * (row(integrals.axialExtentGradient) - row(firstCap.heightGradient) -
                                         row(secondCap.heightGradient));
    value.jacobian.row(3) = perVolume * (row(integrals.volumeGradient) - row(firstCap.volumeGradient) -
                                         row(secondCap.volumeGradient));
    value.gapSlope << 0, 0, -perHeight, 0;
    if (symmetric_) {
        value.residual[0] = perRadius * arc.radialPart;
        value.jacobian.row(0) << perRadius, 0, 0, 0;
    }
    return value;
}

}  // namespace pendular
