#include "Kernel/Features/LiquidBridges/YoungLaplace/PanelRule.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pendular {

namespace {

constexpr std::array<int, 9> orders = {8, 12, 16, 20, 24, 32, 40, 48, 64};
constexpr double logarithmOfAccuracy = 36;  // rho^(-2n) = exp(-36) = 2e-16
constexpr int deepest = 40;

/// The smallest of the orders that suffices, or 0.
int orderFor(double logarithmOfRho) {
    const double needed = 0.5 * logarithmOfAccuracy / logarithmOfRho;
    const auto* order = std::ranges::find_if(orders, [&](int n) { return n >= needed; });
    return order == orders.end() ? 0 : *order;
}

}  // namespace

PanelRule::PanelRule(const DelaunayArc& arc, double from, double to) {
    const double scale = 1 / arc.halfSpan;
    const double h = arc.meanCurvature, q = arc.axialPart;
    if (std::abs(h) * arc.halfSpan < 1e-9) {  // y^2 = q^2 + (p + t)^2 to first order
        singularities_.fill({-arc.radialPart * scale, std::abs(q) * scale});
    } else {
        // y = 0 where Z = 1: t = (2/H) tan(w/4), w = i ln|Z| - arg Z + 2 pi k; ds/dt has a pole at t = 2i/H.
        const auto [real, imaginary] = arc.kenmotsu();
        const double angle = -0.5 * std::atan2(imaginary, real);
        const double excess = std::max(-4 * h * arc.forceLength(), -1 + 1e-30);
        const double stretch = std::max(0.25 * std::log1p(excess), -30.0);
        const double sine = std::sin(angle), cosine = std::cos(angle);
        const double hyperbolicSine = std::sinh(stretch), hyperbolicCosine = std::cosh(stretch);
        const double unit = 2 * scale / h;
        const double near = unit / (hyperbolicCosine + cosine), far = unit / (hyperbolicCosine - cosine);
        singularities_ = {{{near * sine, std::abs(near * hyperbolicSine)},
                           {-far * sine, std::abs(far * hyperbolicSine)},
                           {0, std::abs(unit)},
                           {0, std::abs(unit)}}};
    }
    divide(from, to, 0);
}

void PanelRule::divide(double from, double to, int depth) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    double axis = 1e300;  // major semi-axis of the smallest ellipse with foci at the ends
    for (const auto [along, across] : singularities_) {
        const double x = (along - middle) / half, y = across / half;
        axis = std::min(axis, 0.5 * (std::hypot(x - 1, y) + std::hypot(x + 1, y)));
    }
    const int order = orderFor(std::log(axis + std::sqrt(std::max(axis * axis - 1, 0.0))));
    if (order > 0 || depth == deepest || count_ + 2 > static_cast<int>(panels_.size())) {
        panels_[count_++] = {from, to, order > 0 ? order : orders.back()};
    } else {
        divide(from, middle, depth + 1);
        divide(middle, to, depth + 1);
    }
}

}  // namespace pendular
