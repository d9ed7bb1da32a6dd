#pragma once

#include <optional>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeBranch.h"

namespace pendular {

/// How a bridge ends when the bodies move apart.
enum class RuptureMode {
    Fold,          // the gap can grow no further along the branch
    SymmetryLoss,  // between equal bodies: the liquid slides to one of them
    Detachment     // the contact line shrinks to a point (contact angle pi)
};

/// The last point of the stable branch.
struct BranchEnd {
    BranchPoint point;
    RuptureMode mode;
};

/// The stable equilibrium that Newton's method finds from the first guess alone; nothing if it finds none.
std::optional<DelaunayArc> findDirectly(const BridgeConditions& conditions, const BridgeEquations& equations,
                                        double gap);

/// The stable equilibrium at a gap, found by following the branch from another gap; nothing at or beyond
/// rupture.
std::optional<DelaunayArc> findAlongBranch(const BridgeConditions& conditions, double gap);

/// The end of the stable branch; nothing if no stable bridge was found to start from.
std::optional<BranchEnd> findBranchEnd(const BridgeConditions& conditions);

/// The next point along the branch, stable or not, near enough for the branch to turn little on the way.
std::optional<BranchPoint> nextPoint(const BridgeBranch& branch, const BranchPoint& from);

}  // namespace pendular
