#pragma once

#include <optional>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeEquations.h"

namespace pendular {

/// An arc that satisfies the equations, and the derivatives there.
struct ConvergedArc {
    DelaunayArc arc;
    BridgeEquations::Value value;
    int evaluations;  // of the equations
};

/// The arc that Newton's method, damped, reaches from a first guess; nothing if it fails.
/// @param nodes of the quadrature to begin with. Few are fast from a poor guess; from a good one near a fold
/// they lead away, as by them the fold is at another gap.
std::optional<ConvergedArc> convergeArc(const BridgeEquations& equations, double gap, DelaunayArc guess,
                                        int nodes = coarseQuadratureNodes);

/// The arc moved by a step in its four parameters.
DelaunayArc moved(const DelaunayArc& arc, const Eigen::Vector4d& step);

/// The largest part of a step that changes radius, span and turning of the arc moderately; at most 1.
double admissiblePart(const DelaunayArc& arc, const Eigen::Vector4d& step);

}  // namespace pendular
