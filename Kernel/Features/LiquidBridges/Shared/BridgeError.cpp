#include "Kernel/Features/LiquidBridges/Shared/BridgeError.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Math/GaussLegendre.h"

namespace pendular {

namespace {

/// The work of a law from contact to its rupture, J / (N/m). S = S_c x^2 (3 - 2x) makes the nodes dense at
/// contact, where small bridges change over a length far below S_c, and at the rupture, where the exact force
/// ends with a square root.
double ruptureWork(const ModelBridge& model) {
    constexpr int panels = 8, nodes = 12;
    double work = 0;
    for (int panel = 0; panel < panels; ++panel)
        for (const QuadratureNode& node : gaussLegendre(nodes)) {
            const double x = (panel + 0.5 * (1 + node.position)) / panels;
            const double slope = 6 * x * (1 - x) * model.ruptureDistance;
            work += node.weight * slope * model.force(model.ruptureDistance * x * x * (3 - 2 * x));
        }
    return work / (2 * panels);
}

bool allFinite(const BridgeDeviation& errors) {
    const auto finite = [](double value) { return std::isfinite(value); };
    return finite(errors.ofRuptureDistance) && finite(errors.ofRuptureWork) &&
           std::all_of(errors.ofForce.begin(), errors.ofForce.end(), finite) &&
           std::all_of(errors.ofLargestForce.begin(), errors.ofLargestForce.end(), finite);
}

void append(std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

double BridgeDeviation::largestOfForce() const {
    double largest = 0;
    for (const double error : ofForce) largest = std::max(largest, std::abs(error));
    return largest;
}

BridgeDeviation deviation(const ModelBridge& model, const ExactBridge& exact) {
    BridgeDeviation errors;
    if (model.objection) {
        errors.refused = true;
        return errors;
    }
    const double least = leastForceShare * exact.forceScale;
    const double largest = std::max(exact.largestForce, least);
    errors.ofRuptureDistance = model.ruptureDistance / exact.ruptureDistance - 1;
    errors.ofRuptureWork =
        (ruptureWork(model) - exact.ruptureWork) / std::max(exact.ruptureWork, least * exact.ruptureDistance);
    for (const ExactForce& point : exact.forces) {
        if (point.separation > 0 && point.separation >= model.ruptureDistance) break;
        const double force = model.force(point.separation), difference = force - point.equilibrium();
        errors.ofForce.push_back(difference / std::max(point.equilibrium(), least));
        errors.ofLargestForce.push_back(difference / largest);
        errors.wrongSign |=
            std::abs(force) > least && std::abs(point.pinned) > least && force * point.pinned < 0;
    }
    errors.finite = allFinite(errors);
    return errors;
}

ErrorSpread spreadOf(std::vector<double> signedErrors) {
    if (signedErrors.empty()) return {};
    const auto quantile = [](std::vector<double>& values, double share) {
        const auto count = static_cast<double>(values.size());
        const auto rank = static_cast<std::ptrdiff_t>(std::max(std::ceil(share * count), 1.0)) - 1;
        std::nth_element(values.begin(), values.begin() + rank, values.end());
        return values[static_cast<std::size_t>(rank)];
    };
    const double bias = quantile(signedErrors, 0.5);
    for (double& error : signedErrors) error = std::abs(error);
    return {bias, quantile(signedErrors, 0.5), quantile(signedErrors, 0.95), quantile(signedErrors, 1)};
}

BridgeErrors errorsOf(const std::vector<BridgeDeviation>& deviations) {
    BridgeErrors errors;
    errors.bridges = deviations.size();
    std::vector<double> force, largestForce, ruptureDistance, ruptureWork;
    for (const BridgeDeviation& one : deviations) {
        errors.refused += one.refused;
        errors.notFinite += !one.finite;
        errors.wrongSign += one.wrongSign;
        if (one.refused || !one.finite) continue;
        append(force, one.ofForce);
        append(largestForce, one.ofLargestForce);
        ruptureDistance.push_back(one.ofRuptureDistance);
        ruptureWork.push_back(one.ofRuptureWork);
    }
    errors.ofForce = spreadOf(std::move(force));
    errors.ofLargestForce = spreadOf(std::move(largestForce));
    errors.ofRuptureDistance = spreadOf(std::move(ruptureDistance));
    errors.ofRuptureWork = spreadOf(std::move(ruptureWork));
    return errors;
}

}  // namespace pendular
