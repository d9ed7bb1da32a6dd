#include "Kernel/Features/LiquidBridges/BridgeSurface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeTable.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "Kernel/Foundation/Math/Halving.h"

namespace pendular {

namespace {

struct ScaledBridge {
    double radius;  // R, m
    BridgeShape shape;
    double gap;  // over R
};

ScaledBridge scaled(const BridgeLiquid& bridge, double separation) {
    const double radius = 2 * bridge.bodies.effectiveRadius();
    const double r1 = bridge.bodies.radius1, r2 = bridge.bodies.radius2;
    return {radius,
            {bridge.contactAngle, bridge.volume / (radius * radius * radius),
             std::isinf(r2) ? 1 : (r2 - r1) / (r2 + r1)},
            std::max(separation, 0.0) / radius};
}

}  // namespace

double bridgeArea(const BridgeLiquid& bridge, double separation) {
    if (!(bridge.volume > 0)) return 0;
    auto [radius, shape, gap] = scaled(bridge, separation);
    const double held = std::clamp(shape.volume, BridgeTable::leastVolume, BridgeTable::mostVolume);
    // Small bridges are alike: lengths across and along the axis are as sqrt(V), the contact radius as its
    // fourth root, so that the area is as V^(3/4).
    const double scale = std::sqrt(held / shape.volume);
    shape.volume = held;
    const BridgeSlice& slice = bridgesAt(shape.contactAngle);
    gap = std::min(gap * scale, slice.ruptureDistance(shape));
    return radius * radius * slice.lateralArea(shape, gap) / (scale * std::sqrt(scale));
}

BridgeSurface solveBridgeSurface(const BridgeLiquid& bridge, double separation) {
    BridgeSurface found{.area = bridgeArea(bridge, separation)};
    if (!(bridge.volume > 0)) return found;
    const auto [radius, shape, gap] = scaled(bridge, separation);
    auto solved = solveBridge(shape.conditions(), gap);
    if (!solved)
        if (const auto rupture = findRupture(shape.conditions())) solved = rupture->last;
    if (!solved) return found;
    return {.area = radius * radius * solved->lateralArea(),
            .pressure = bridge.surfaceTension / radius * solved->pressure(),
            .fillingAngle1 = solved->firstFillingAngle(),
            .fillingAngle2 = solved->secondFillingAngle()};
}

namespace {

double findVolumeWhereBridgesMeet(double contactAngle) {
    const auto reaches = [&](double volume) {
        const auto solved = solveBridge({{1, contactAngle}, {1, contactAngle}, volume}, 0);
        return solved && solved->firstFillingAngle() >= std::numbers::pi / 6;
    };
    // The filling angle grows with the volume.
    if (!reaches(BridgeTable::mostVolume)) return BridgeTable::mostVolume;
    return turningPoint(BridgeTable::mostVolume, BridgeTable::leastVolume, reaches, 60).holds;
}

}  // namespace

double volumeWhereBridgesMeet(double contactAngle) {
    struct Found {
        double angle, volume;
    };
    thread_local Found last{-1, 0};  // it is asked for again and again for the same liquid
    if (last.angle != contactAngle) last = {contactAngle, findVolumeWhereBridgesMeet(contactAngle)};
    return last.volume;
}

}  // namespace pendular
