#pragma once

#include <array>

#include "Kernel/Features/LiquidBridges/YoungLaplace/DelaunayArc.h"

namespace pendular {

/// A part of the interval [-1, 1] and the number of Gauss-Legendre nodes that brings it near the rounding
/// error.
struct Panel {
    double from, to;
    int nodes;
};

/// Panels for the integrals along an arc, in units of its halfSpan.
/// The integrands are analytic except for branch points where y = 0 and poles of ds/dt, all known in closed
/// form. A Gauss-Legendre rule of n nodes converges as rho^(-2n), where rho is the sum of the semi-axes of
/// the Bernstein ellipse through the nearest of them (Trefethen, Approximation Theory and Approximation
/// Practice, chapter 19). A panel that lies too near, as at a thin neck, is halved.
class PanelRule {
public:
    PanelRule(const DelaunayArc& arc, double from, double to);
    /// One panel with the given number of nodes.
    explicit PanelRule(int nodes) : count_(1) { panels_[0] = {-1, 1, nodes}; }
    [[nodiscard]] const Panel* begin() const { return panels_.data(); }
    [[nodiscard]] const Panel* end() const { return panels_.data() + count_; }

private:
    struct Singularity {
        double along, across;  // real part, and modulus of the imaginary part
    };
    void divide(double from, double to, int depth);

    std::array<Singularity, 4> singularities_;
    std::array<Panel, 128> panels_;
    int count_ = 0;
};

}  // namespace pendular
