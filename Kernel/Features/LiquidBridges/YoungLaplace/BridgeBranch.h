#pragma once

#include <Eigen/Core>
#include <optional>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeNewton.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeStability.h"

namespace pendular {

/// One equilibrium on the branch of constant volume, and the direction in which the branch goes on.
/// Directions are in scaled steps: of (p, q) by the radius, of H and T by T, of the gap by the height of the
/// bridge.
struct BranchPoint {
    using Direction = Eigen::Matrix<double, 5, 1>;

    DelaunayArc arc;
    double gap;
    BridgeStability stability;
    Direction direction;  // of unit length
};

/// The branch of equilibria of constant volume, followed by pseudo-arclength (Keller, in Rabinowitz (ed.),
/// Applications of Bifurcation Theory, 1977): it passes the fold at the largest gap and goes on with the
/// unstable bridges beyond.
class BridgeBranch {
public:
    explicit BridgeBranch(const BridgeConditions& conditions) : equations_(conditions) {}

    [[nodiscard]] const BridgeEquations& equations() const { return equations_; }
    /// The branch at a known equilibrium; it sets out towards larger gaps.
    [[nodiscard]] BranchPoint startAt(const DelaunayArc& arc, double gap) const;
    /// The point a scaled distance further (back, if negative); nothing if Newton's method fails, so that a
    /// shorter step is worth trying.
    [[nodiscard]] std::optional<BranchPoint> after(const BranchPoint& point, double distance) const;

private:
    [[nodiscard]] BranchPoint completed(const DelaunayArc& arc, double gap,
                                        const BridgeEquations::Value& value,
                                        const BranchPoint::Direction& towards) const;

    BridgeEquations equations_;
};

}  // namespace pendular
