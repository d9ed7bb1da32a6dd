#pragma once

#include <algorithm>
#include <cmath>

#include "Kernel/Laws/Concepts/Bodies.h"

namespace pendular {

/// The two bodies as an adhesion law sees them where they are nearest to each other: spheres of the local
/// radii.
class LocalBodies {
public:
    /// V / R^3 at most, with R = 2 R*. Such a bridge covers more than half of a radius, and spans what is
    /// sharper.
    static constexpr double largestBridgeVolume = 0.1;

    /// @param bridgeVolume m^3, V; 0 without liquid
    LocalBodies(const Bodies& spheresAround, double bridgeVolume)
        : isAtWall(std::isinf(spheresAround.radius2)),
          leastRadius(bridgeVolume > 0 ? std::min(spheresAround.effectiveRadius(),
                                                  0.5 * std::cbrt(bridgeVolume / largestBridgeVolume))
                                       : 0) {}

    /// Bodies of the effective radius (m), with the ratio of their own Gauss' radii (m; infinite if flat).
    [[nodiscard]] Bodies with(double effectiveRadius, const Bodies& own) const {
        const double radius = std::max(effectiveRadius, leastRadius), given = own.effectiveRadius();
        if (isAtWall) return {radius};
        if (std::isinf(given)) return {2 * radius, 2 * radius};
        return {radius / given * own.radius1, radius / given * own.radius2};
    }

private:
    bool isAtWall;
    double leastRadius;  // m, of the effective one
};

}  // namespace pendular
