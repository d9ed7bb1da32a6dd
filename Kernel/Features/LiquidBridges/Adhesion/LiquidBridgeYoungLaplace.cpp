#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeYoungLaplace.h"

#include <fmt/format.h>

#include <algorithm>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeTableMaking.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

namespace {

constexpr std::string_view noBridge = "no stable bridge was found all the way from contact to rupture";

/// The nearest shape that the table holds: what is beyond by BridgeTable::edge at most must not fail, nor
/// what lies beyond the extremes of sizes, which alone set-up looks at, by a rounding error.
BridgeShape clamped(BridgeShape shape) {
    shape.volume = std::clamp(shape.volume, BridgeTable::leastVolume, BridgeTable::mostVolume);
    return shape;
}

}  // namespace

BridgeShape LiquidBridgeYoungLaplace::shape(const Bodies& bodies) const {
    const double smaller = std::min(bodies.radius1, bodies.radius2),
                 larger = std::max(bodies.radius1, bodies.radius2);
    return {contactAngle, scales(bodies).volume,
            std::isinf(larger) ? 1 : (larger - smaller) / (larger + smaller)};
}

double LiquidBridgeYoungLaplace::range(const Bodies& bodies) const {
    if (liquidBridgeVolume == 0) return 0;
    const BridgeShape bridge = shape(bodies);
    const double radius = scales(bodies).radius;
    if (solveOutsideTable > 0 && !BridgeTable::contains(bridge)) {
        const auto rupture = findRupture(bridge.conditions());
        return rupture ? radius * rupture->last.gap() : 0;
    }
    return radius * bridgesAt(contactAngle).ruptureDistance(clamped(bridge));
}

LiquidBridgeYoungLaplace::Interaction<double> LiquidBridgeYoungLaplace::prepare(const Bodies& bodies) const {
    if (liquidBridgeVolume == 0) return {{{}, 0, 1}, 0, 0};
    const BridgeShape bridge = shape(bodies);
    const auto [radius, volume, unused, forceScale] = scales(bodies);
    const double leastForce = pinned > 0 ? -100 * forceScale : 0;
    if (solveOutsideTable > 0 && !BridgeTable::contains(bridge)) {
        const auto solved = solveCurve(bridge, radius, forceScale);
        if (!solved) throw RunError(sentence(bodies, noBridge) + ".");
        return {solved->curve, leastForce, solved->ruptureDistance};
    }
    return {bridgesAt(contactAngle).curve(clamped(bridge), radius, forceScale), leastForce, range(bodies)};
}

double LiquidBridgeYoungLaplace::lateralArea(const Bodies& bodies, double separation) const {
    if (liquidBridgeVolume == 0) return 0;
    const BridgeShape bridge = shape(bodies);
    const double radius = scales(bodies).radius, gap = separation / radius;
    if (solveOutsideTable > 0 && !BridgeTable::contains(bridge)) {
        const auto solved = solveBridge(bridge.conditions(), gap);
        return solved ? radius * radius * solved->lateralArea() : 0;
    }
    return radius * radius * bridgesAt(contactAngle).lateralArea(clamped(bridge), gap);
}

std::optional<std::string> LiquidBridgeYoungLaplace::objection(const Bodies& bodies) const {
    if (liquidBridgeVolume == 0 || BridgeTable::contains(shape(bodies))) return std::nullopt;
    if (!(solveOutsideTable > 0))
        return sentence(bodies, fmt::format("the table holds V* from {} to {}, and so no bridge",
                                            BridgeTable::leastVolume, BridgeTable::mostVolume)) +
               ", so take another volume or, between spheres, have the equation solved for each new bridge: "
               "in a driver setSolveOutsideTable(true), for TwoParticleCollision the option "
               "--solve-outside-table.";
    if (auto volume = objectionToVolume(bodies)) return volume;
    const BridgeScales bridge = scales(bodies);
    if (solveCurve(shape(bodies), bridge.radius, bridge.forceScale)) return std::nullopt;
    return sentence(bodies, noBridge) + ".";
}

std::string LiquidBridgeYoungLaplace::sentence(const Bodies& bodies, std::string_view what) const {
    const BridgeScales bridge = scales(bodies);
    return fmt::format(
        "{}: {} for contactAngle = {:.6g} rad and V* = liquidBridgeVolume/R^3 = {:.6g} (liquidBridgeVolume = "
        "{:.6g} m^3, R = {:.6g} m)",
        name, what, contactAngle, bridge.volume, liquidBridgeVolume, bridge.radius);
}

}  // namespace pendular
