#include "Kernel/Features/LiquidBridges/Adhesion/WetWall.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Math/Halving.h"

namespace pendular {

namespace {

/// m; infinite where there is no wall
double radiusAtWall(const Bodies& bodies) {
    return std::isinf(bodies.radius1) || std::isinf(bodies.radius2) ? bodies.effectiveRadius() : infinity;
}

/// A bridge is called ruptured a little before it leaves the range of its law.
constexpr double margin = 1.03;

}  // namespace

ToroidOnLayer<double> WetWall::toroid(double radius) const {
    const double psi = halfFillingAngle + contactAngle, cap = radius * (1 - std::cos(halfFillingAngle));
    return {.contactRadius = radius * std::sin(halfFillingAngle),
            .capHeight = cap,
            .sine = std::sin(psi),
            .cosine = std::cos(psi),
            .angle = std::numbers::pi - psi,
            .capVolume = std::numbers::pi / 3 * cap * cap * (3 * radius - cap)};
}

double WetWall::largestLength(const ToroidOnLayer<double>& bridge, double radius) const {
    const double stretch = (1 + 0.5 * contactAngle) * (1 + std::sqrt(largestCapillaryNumber));
    if (growingBridge == 0) return stretch * std::cbrt(bridge.volume(0));
    // The volume of a toroid may grow as fast as the cube of its length; then the neck ends it, or 20 R.
    const auto stands = [&](double x) {
        return bridge.radii(x).neck > 0 && x < stretch * std::cbrt(bridge.volume(x));
    };
    return turningPoint(0, 20 * radius, stands, 60).fails;
}

double WetWall::range(const Bodies& bodies) const {
    const double radius = radiusAtWall(bodies);
    if (std::isinf(radius) || liquidLayerThickness == 0) return 0;
    return liquidLayerThickness + margin * largestLength(toroid(radius), radius);
}

WetWall::Interaction<double> WetWall::prepare(const Bodies& bodies) const {
    const double radius = radiusAtWall(bodies);
    Interaction<double> dry{};
    dry.radius = dry.roughness = dry.viscosity = dry.surfaceTension = 1;
    dry.bridge.capHeight = dry.bridge.contactRadius = 1;  // its forces are finite, and count nothing
    dry.depth = -1;                                       // m, below all overlaps
    if (std::isinf(radius) || liquidLayerThickness == 0) return dry;
    const ToroidOnLayer<double> bridge = toroid(radius);
    return {.radius = radius,
            .depth = liquidLayerThickness,
            .roughness = roughness,
            .wetted = 0,
            .reach = margin * largestLength(bridge, radius),
            .bridge = bridge,
            .lengthFactor = 1 + 0.5 * contactAngle,
            .volume = bridge.volume(0),
            .grows = growingBridge,
            .viscosity = viscosity,
            .surfaceTension = surfaceTension,
            .density = liquidDensity,
            .gravity = bridgeGravity,
            .forceInContact = capillaryInContact};
}

BridgeResistance<double> WetWall::largestResistance(const Bodies& bodies) const {
    if (range(bodies) == 0) return {};
    return resistanceAtRoughness(bodies, liquidLayerThickness, 1);
}

std::optional<std::string> WetWall::objection(const Bodies& bodies) const {
    const double radius = radiusAtWall(bodies);
    if (std::isinf(radius) || liquidLayerThickness == 0) return std::nullopt;
    if (halfFillingAngle + contactAngle >= std::numbers::pi)
        return fmt::format(
            "{}: halfFillingAngle + contactAngle = {:.6g} rad is not below pi, so no toroid joins the grain "
            "and the layer; take smaller angles.",
            name, halfFillingAngle + contactAngle);
    const double volume = toroid(radius).volume(0);
    if (volume > 0) return std::nullopt;
    return fmt::format(
        "{}: the toroid of halfFillingAngle = {:.6g} rad and contactAngle = {:.6g} rad has no liquid ({:.4g} "
        "m^3) where a grain of {:.4g} m leaves the layer; take other angles.",
        name, halfFillingAngle, contactAngle, volume, radius);
}

std::vector<DomainLimit> WetWall::domainLimits(const Bodies& bodies) const {
    const double radius = radiusAtWall(bodies);
    if (std::isinf(radius) || liquidLayerThickness == 0) return {};
    return {{"liquidLayerThickness over the radius", liquidLayerThickness / radius, fromZeroTo(0.5)}};
}

}  // namespace pendular
