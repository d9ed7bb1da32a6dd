#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeNewton.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace pendular {

namespace {

constexpr int mostEvaluations = 40;
constexpr double hopeless = 1e6;       // residual
constexpr double coarseEnough = 1e-3;  // residual above which few quadrature nodes do
constexpr int coarseNodes = coarseQuadratureNodes, fineNodes = mostQuadratureNodes;
// Newton's method is quadratic: a step of this relative size leaves an error near the rounding error.
constexpr double lastStep = 1e-8;
constexpr double roundingFloor = 2e-15;

/// The size of a step relative to the arc: radius, turning angle, span.
double relativeSize(const DelaunayArc& arc, const Eigen::Vector4d& step) {
    const double radius = std::sqrt(arc.squaredRadius());
    return std::max({std::abs(step[0]) / radius, std::abs(step[1]) / radius, std::abs(step[2]) * arc.halfSpan,
                     std::abs(step[3]) / arc.halfSpan});
}

struct Trial {
    DelaunayArc arc;
    BridgeEquations::Value value;
};

/// The step, or the part of it that lessens the residual enough.
Trial damped(const BridgeEquations& equations, double gap, int nodes, const Trial& from,
             const Eigen::Vector4d& step, int& evaluations) {
    constexpr int mostShortenings = 4;
    constexpr double convincing = 1e-6;  // a step so short is not doubted
    const double size = from.value.residual.norm();
    double part = admissiblePart(from.arc, step);
    for (int shortening = 0;; ++shortening, part *= 0.4) {
        const DelaunayArc next = moved(from.arc, part * step);
        const BridgeEquations::Value value = equations.at(next, gap, nodes);
        ++evaluations;
        const bool lessened = value.residual.norm() < size * (1 - 0.1 * part);
        if (lessened || shortening == mostShortenings || relativeSize(from.arc, step) < convincing)
            return {next, value};
    }
}

}  // namespace

DelaunayArc moved(const DelaunayArc& arc, const Eigen::Vector4d& step) {
    return {arc.radialPart + step[0], arc.axialPart + step[1], arc.meanCurvature + step[2],
            arc.halfSpan + step[3]};
}

double admissiblePart(const DelaunayArc& arc, const Eigen::Vector4d& step) {
    constexpr double most = 0.6;
    return std::min(1.0, most / relativeSize(arc, step));
}

std::optional<ConvergedArc> convergeArc(const BridgeEquations& equations, double gap, DelaunayArc guess,
                                        int nodes) {
    int evaluations = 1;
    Trial trial{guess, equations.at(guess, gap, nodes)};
    while (evaluations < mostEvaluations) {
        const double size = trial.value.residual.norm();
        if (!(size < hopeless)) return {};
        if (size < coarseEnough && nodes == coarseNodes) {
            nodes = fineNodes;
            trial.value = equations.at(trial.arc, gap, nodes);
            ++evaluations;
            continue;
        }
        const Eigen::Vector4d step = -trial.value.jacobian.partialPivLu().solve(trial.value.residual);
        const double relative = relativeSize(trial.arc, step);
        trial = damped(equations, gap, nodes, trial, step, evaluations);
        if (nodes == fineNodes && (relative < lastStep || trial.value.residual.norm() < roundingFloor))
            return ConvergedArc{trial.arc, trial.value, evaluations};
    }
    return {};
}

}  // namespace pendular
