#include "Tools/Reference/FreeDrop.h"

#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "Kernel/Foundation/Math/Halving.h"

namespace pendular {

namespace {

using std::numbers::pi;

/// The part that a body cuts off a drop that meets it, written so that a plane (curvature 0) is no special
/// case.
struct CutOff {
    double height;      // of the drop's centre above the body, m
    double volume;      // m^3
    double hiddenArea;  // of the drop's sphere, m^2
    double wettedArea;  // of the body, m^2

    CutOff(const WettedBody& body, double radius) {
        const double curvature = 1 / body.radius, angle = std::cos(body.contactAngle);
        const double share = curvature * radius;
        const double distance = std::sqrt(1 + share * share - 2 * share * angle);  // d / R
        height = radius * (share - 2 * angle) / (distance + 1);
        // Seen from the drop's centre and from the body's, the angles from the line of centres to the contact
        // line, whose radius is y.
        const double atDrop = (share - angle) / distance, atBody = (1 - share * angle) / distance;
        const double y2 = radius * radius * (1 - atDrop) * (1 + atDrop);
        const double dropCap = radius * (1 - atDrop), bodyCap = curvature * y2 / (1 + atBody);
        volume = pi / 3 * dropCap * dropCap * (3 * radius - dropCap) +
                 pi / 3 * bodyCap * (3 * y2 / (1 + atBody) - bodyCap * bodyCap);
        hiddenArea = 2 * pi * radius * dropCap;
        wettedArea = pi * (bodyCap * bodyCap + y2);
    }
};

double sphereVolume(double radius) { return 4 * pi / 3 * radius * radius * radius; }

double volumeOf(const BridgeConditions& c, double radius) {
    return sphereVolume(radius) - CutOff(c.first, radius).volume - CutOff(c.second, radius).volume;
}

/// m; nothing where no sphere holds the volume (between two planes that are wetted well)
std::optional<double> radiusOf(const BridgeConditions& c) {
    const auto isTooSmall = [&](double radius) { return volumeOf(c, radius) < c.volume; };
    const double smallest = std::cbrt(0.75 * c.volume / pi);
    double larger = smallest;
    for (int k = 0; isTooSmall(larger); ++k, larger *= 2)
        if (k == 60) return {};
    const auto [smaller, large] = turningPoint(smallest, larger, isTooSmall, 100);
    return 0.5 * (smaller + large);
}

}  // namespace

std::optional<FreeDrop> findFreeDrop(const BridgeConditions& conditions, double gap) {
    requireBridge(conditions, gap);
    const auto radius = radiusOf(conditions);
    if (!radius) return {};
    const CutOff first(conditions.first, *radius), second(conditions.second, *radius);
    const double higher = first.height - second.height;
    const bool joins = first.height + second.height > gap && -higher < 2 * conditions.first.radius + gap &&
                       higher < 2 * conditions.second.radius + gap;
    if (!joins) return {};
    return FreeDrop{.radius = *radius,
                    .firstHeight = first.height,
                    .secondHeight = second.height,
                    .energy = 4 * pi * *radius * *radius - first.hiddenArea - second.hiddenArea -
                              std::cos(conditions.first.contactAngle) * first.wettedArea -
                              std::cos(conditions.second.contactAngle) * second.wettedArea};
}

}  // namespace pendular
