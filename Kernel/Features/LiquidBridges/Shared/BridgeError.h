#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Features/LiquidBridges/Shared/ExactBridge.h"

// How far a bridge law is from the exact solution: of one bridge, and of a population. Laws that the kernel
// does not ship are judged in the same way.

namespace pendular {

/// One bridge as a law has it, for a surface tension of 1 N/m.
struct ModelBridge {
    std::optional<std::string> objection;  // why the law refuses it, if so; there is no force then
    double ruptureDistance = 0;            // m
    std::function<double(double)> force;   // F / gamma (m) of the separation (m)
};

/// @param law with its options; volume, contact angle and surface tension are set here
template <class Law>
ModelBridge modelBridge(const BridgeCase& bridge, Law law = {}) {
    law.setLiquidBridgeVolume(bridge.volume);
    law.setContactAngle(bridge.contactAngle);
    law.setSurfaceTension(1);
    if constexpr (requires { law.objection(bridge.bodies); })
        if (auto objection = law.objection(bridge.bodies)) return {std::move(objection), 0, {}};
    const auto interaction = law.prepare(bridge.bodies);
    return {
        {}, interaction.range(), [interaction](double separation) { return interaction.force(separation); }};
}

/// An exact force that is smaller than this much of 2 pi R gamma counts as this much where an error is
/// divided by it: it may pass through zero (from about 80 degrees on). A bridge of V* = 1e-9 has 3e-4 at its
/// rupture.
inline constexpr double leastForceShare = 1e-4;

/// How far a law is from one exact bridge. Errors are signed, (law - exact) / exact; those of the force are
/// at the separations of ExactBridge at which the law still has a bridge. What the law does beyond, or leaves
/// out, is in the errors of rupture distance and work.
struct BridgeDeviation {
    bool refused = false;
    bool finite = true;  // all that follows is
    bool wrongSign =
        false;  // pushes where the exact bridge pulls, or pulls where it would push if it were pinned
    std::vector<double> ofForce;         // relative to the force in equilibrium
    std::vector<double> ofLargestForce;  // relative to the largest force of the bridge
    double ofRuptureDistance = 0;
    double ofRuptureWork = 0;

    [[nodiscard]] double largestOfForce() const;
};

BridgeDeviation deviation(const ModelBridge& model, const ExactBridge& exact);

/// Errors without their sign: each value is the smallest that the share (a half, 95 %, all) does not exceed.
/// The bias is the median with its sign. All are `unset` where there is none.
struct ErrorSpread {
    double bias = unset, median = unset, percentile95 = unset, largest = unset;
};

ErrorSpread spreadOf(std::vector<double> signedErrors);

/// The errors of a law over a population; those of refused bridges and of bridges that are not finite are in
/// the counts only.
struct BridgeErrors {
    std::size_t bridges = 0, refused = 0, notFinite = 0, wrongSign = 0;
    ErrorSpread ofForce, ofLargestForce, ofRuptureDistance, ofRuptureWork;
};

BridgeErrors errorsOf(const std::vector<BridgeDeviation>& deviations);

/// @param exact of the population: see BridgePopulation::draw() and solveExactly()
template <class Law>
BridgeErrors bridgeErrors(const std::vector<ExactBridge>& exact, const Law& law = {}) {
    std::vector<BridgeDeviation> deviations;
    deviations.reserve(exact.size());
    for (const ExactBridge& bridge : exact)
        deviations.push_back(deviation(modelBridge(bridge.bridge, law), bridge));
    return errorsOf(deviations);
}

}  // namespace pendular
