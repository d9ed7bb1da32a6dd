#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeSearch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeGuess.h"

namespace pendular {

namespace {

constexpr double firstDistance = 0.2, longestDistance = 0.4, shortestDistance = 1e-9;
constexpr double detachedRadius = 1e-5;  // of a contact line, in heights of the bridge
constexpr int mostSteps = 500;

bool isStable(const BranchPoint& point) { return point.stability.unstableModes == 0; }

/// Nearly equal bodies have two branches close by, one turning sharply where the other goes straight on: a
/// step after which the direction differs much may have changed from one to the other.
bool goesOnSmoothly(const BranchPoint& from, const BranchPoint& to) {
    return to.direction.dot(from.direction) > 0.95;
}

/// A step along the stable branch.
struct Stretch {
    BranchPoint to;  // its end, or the last stable point if the branch loses its stability before
    double distance;
    bool ends;
};

/// The stretch up to where a function becomes zero, between a point of the branch and one further on where
/// the function has the other sign: regula falsi, Illinois variant (Dowell and Jarratt, BIT 11 (1971)
/// 168-174). Nothing if the function jumps, or if the branch turns much on the way: then the two points are
/// not on one branch, or too far apart.
template <class Function>
std::optional<Stretch> zeroBetween(const BridgeBranch& branch, const BranchPoint& from, const BranchPoint& to,
                                   double distance, Function function) {
    double low = 0, high = distance;
    double lowValue = function(from), highValue = function(to);
    const double scale = std::abs(lowValue) + std::abs(highValue);
    for (int iteration = 0; iteration < 60; ++iteration) {
        const double next = low + (high - low) * lowValue / (lowValue - highValue);
        const auto point = branch.after(from, next);
        if (!point || !goesOnSmoothly(from, *point)) return {};
        const double value = function(*point);
        if (std::abs(value) < 1e-13 * scale || std::abs(next - high) < 1e-13 * std::abs(distance)) {
            if (std::abs(value) < 1e-6 * scale) return Stretch{*point, next, true};
            return {};
        }
        if (value * highValue < 0) {
            low = high;
            lowValue = highValue;
        } else {
            lowValue *= 0.5;
        }
        high = next;
        highValue = value;
    }
    return {};
}

/// The next stretch, of the given length or less; backwards, if negative.
std::optional<Stretch> advance(const BridgeBranch& branch, const BranchPoint& from, double distance) {
    const auto product = [](const BranchPoint& at) { return at.stability.product(); };
    for (; std::abs(distance) > shortestDistance; distance *= 0.5) {
        const auto to = branch.after(from, distance);
        if (!to || !goesOnSmoothly(from, *to)) continue;
        if (isStable(*to)) return Stretch{*to, distance, false};
        if (product(*to) < 0)  // else two modes became unstable in one step
            if (const auto zero = zeroBetween(branch, from, *to, distance, product)) return zero;
    }
    return {};
}

double contactRadius(const BranchPoint& point) {
    const double span = point.arc.halfSpan;
    return std::sqrt(std::min(point.arc.at(-span).squaredRadius, point.arc.at(span).squaredRadius));
}

/// The place to which following the stable branch from a point leads.
struct Walk {
    std::optional<BranchPoint> arrived;  // the given gap
    std::optional<BranchEnd> end;        // or the end of the branch, before
};

/// The point of a stretch at a gap that it reaches. The gap grows all along a stable stretch; near its end at
/// a fold it does so as a parabola with its top there, so that it is followed by distance along the branch.
std::optional<BranchPoint> pointAtGap(const BridgeBranch& branch, const BranchPoint& from,
                                      const Stretch& stretch, double gap) {
    const auto arrived = zeroBetween(branch, from, stretch.to, stretch.distance,
                                     [gap](const BranchPoint& at) { return at.gap - gap; });
    return arrived ? std::optional(arrived->to) : std::nullopt;
}

/// Goes up or down to the given gap.
Walk walk(const BridgeBranch& branch, BranchPoint point, double gap) {
    const double sense = gap < point.gap ? -1 : 1;
    double distance = firstDistance;
    for (int step = 0; step < mostSteps; ++step) {
        const auto stretch = advance(branch, point, sense * distance);
        if (!stretch || contactRadius(point) < detachedRadius * point.arc.length())
            return {{}, BranchEnd{point, RuptureMode::Detachment}};
        if (sense * (stretch->to.gap - gap) >= 0) return {pointAtGap(branch, point, *stretch, gap), {}};
        if (stretch->ends) {
            const bool turns = std::abs(stretch->to.direction[4]) < 1e-4;
            return {{}, BranchEnd{stretch->to, turns ? RuptureMode::Fold : RuptureMode::SymmetryLoss}};
        }
        distance = std::min(longestDistance, 1.5 * std::abs(stretch->distance));
        point = stretch->to;
    }
    return {};
}

/// A rough rupture distance, only to start a search from: (1 + theta/2) V^(1/3) as for small bridges (Lian,
/// Thornton and Adams, J. Colloid Interface Sci. 161 (1993) 138-147), saturating for large volumes and
/// angles.
double roughRuptureGap(const BridgeConditions& conditions) {
    const double curvature = 1 / conditions.first.radius + 1 / conditions.second.radius;
    const double angle = 0.5 * (conditions.first.contactAngle + conditions.second.contactAngle);
    const double cubeRoot = std::cbrt(conditions.volume);
    return (1 + 0.5 * std::min(angle, 1.0)) * cubeRoot / (1 + 0.3 * cubeRoot * curvature);
}

std::optional<DelaunayArc> stableOrNothing(const BridgeEquations& equations,
                                           const std::optional<ConvergedArc>& converged) {
    if (!converged || stabilityOf(equations, converged->arc, converged->value.geometry).unstableModes > 0)
        return {};
    return converged->arc;
}

/// The bridge for contact angles so unlike that the first guess is poor: found from the bridge with their
/// mean on both bodies.
std::optional<DelaunayArc> findByAngles(const BridgeConditions& conditions, double gap) {
    constexpr double shortestShare = 1e-3;
    const double mean = 0.5 * (conditions.first.contactAngle + conditions.second.contactAngle);
    const auto at = [&](double share) {
        BridgeConditions between = conditions;
        between.first.contactAngle += (1 - share) * (mean - conditions.first.contactAngle);
        between.second.contactAngle += (1 - share) * (mean - conditions.second.contactAngle);
        return between;
    };
    auto found = convergeArc(BridgeEquations(at(0)), gap, guessArc(at(0), gap));
    double share = 0, step = 0.25;
    while (found && share < 1 && step > shortestShare) {
        const double next = std::min(1.0, share + step);
        const auto converged = convergeArc(BridgeEquations(at(next)), gap, found->arc);
        if (converged) {
            found = converged;
            share = next;
        } else {
            step *= 0.5;
        }
    }
    return share < 1 ? std::nullopt : stableOrNothing(BridgeEquations(conditions), found);
}

/// A stable point to start from, near a gap, sooner below than above.
std::optional<BranchPoint> startNear(const BridgeConditions& conditions, const BridgeBranch& branch,
                                     double gap) {
    const double rough = roughRuptureGap(conditions);
    for (const double start :
         {0.75 * gap, 0.5 * gap, 0.25 * gap, 0.1 * gap, 0.0, 0.25 * rough, 0.5 * rough, 0.75 * rough})
        if (const auto arc = findDirectly(conditions, branch.equations(), start))
            return branch.startAt(*arc, start);
    for (const double start : {0.5 * gap, 0.0})
        if (const auto arc = findByAngles(conditions, start)) return branch.startAt(*arc, start);
    return {};
}

}  // namespace

std::optional<DelaunayArc> findDirectly(const BridgeConditions& conditions, const BridgeEquations& equations,
                                        double gap) {
    return stableOrNothing(equations, convergeArc(equations, gap, guessArc(conditions, gap)));
}

std::optional<DelaunayArc> findAlongBranch(const BridgeConditions& conditions, double gap) {
    const BridgeBranch branch(conditions);
    const auto start = startNear(conditions, branch, gap);
    if (!start) return {};
    const Walk result = walk(branch, *start, gap);
    if (!result.arrived) return {};
    // The result is right to rounding error, and at this very gap.
    return stableOrNothing(branch.equations(),
                           convergeArc(branch.equations(), gap, result.arrived->arc, mostQuadratureNodes));
}

std::optional<BranchPoint> nextPoint(const BridgeBranch& branch, const BranchPoint& from) {
    for (double distance = firstDistance; distance > shortestDistance; distance *= 0.5) {
        const auto to = branch.after(from, distance);
        if (to && goesOnSmoothly(from, *to)) return to;
    }
    return {};
}

std::optional<BranchEnd> findBranchEnd(const BridgeConditions& conditions) {
    const BridgeBranch branch(conditions);
    const auto start = startNear(conditions, branch, roughRuptureGap(conditions));
    if (!start) return {};
    return walk(branch, *start, std::numeric_limits<double>::infinity()).end;
}

}  // namespace pendular
