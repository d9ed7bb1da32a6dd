#pragma once

#include <Eigen/Core>
#include <array>

#include "Kernel/Features/LiquidBridges/YoungLaplace/WettedBody.h"

namespace pendular {

/// What stays the same while the gap of a bridge changes.
struct BridgeConditions {
    WettedBody first, second;
    double volume;  // m^3
};

/// The pieces that equations, energy and stability share.
struct BridgeGeometry {
    ArcEnd left, right;
    Cap firstCap, secondCap;
    ArcIntegrals integrals;

    BridgeGeometry(const DelaunayArc& arc, const BodyContact& first, const BodyContact& second,
                   int mostNodes = mostQuadratureNodes)
        : left(arc.end(-1)),
          right(arc.end(1)),
          firstCap(first.cap(left, -1)),
          secondCap(second.cap(right, 1)),
          integrals(integrate(arc, mostNodes)) {}
};

/// The four equations for the four parameters of the arc: contact angles at both bodies, gap, volume; each
/// divided by its natural scale, so that their size is a relative error.
class BridgeEquations {
public:
    struct Value {
        Eigen::Vector4d residual;
        Eigen::Matrix4d jacobian;  // by the four parameters of the arc
        Eigen::Vector4d gapSlope;  // derivative of the residual by the gap
        BridgeGeometry geometry;
    };

    explicit BridgeEquations(const BridgeConditions& conditions);

    /// mostNodes bounds the quadrature: coarse in early iterations.
    [[nodiscard]] Value at(const DelaunayArc& arc, double gap, int mostNodes) const;

    /// Both bodies are alike. The bridge is then sought among those that are their own mirror image, and the
    /// first equation says so (p = 0): the system stays regular where the bridge loses that symmetry.
    [[nodiscard]] bool isSymmetric() const { return symmetric_; }
    [[nodiscard]] const BodyContact& first() const { return first_; }
    [[nodiscard]] const BodyContact& second() const { return second_; }
    [[nodiscard]] double volumeOverPi() const { return volumeOverPi_; }

private:
    BodyContact first_, second_;
    double volumeOverPi_;
    bool symmetric_;
};

}  // namespace pendular
