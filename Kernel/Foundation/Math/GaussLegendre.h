#pragma once

#include <span>

namespace pendular {

/// One node of a Gauss-Legendre rule on [-1, 1].
struct QuadratureNode {
    double position;
    double weight;
};

/// The rule with the given number of nodes (1 to 64), exact for polynomials up to degree 2 count - 1; nodes
/// ascend. Nodes are the roots of the Legendre polynomial found by Newton's method in extended precision,
/// once, at the first use of that rule; thread-safe. Throws std::out_of_range for any other count.
std::span<const QuadratureNode> gaussLegendre(int count);

}  // namespace pendular
