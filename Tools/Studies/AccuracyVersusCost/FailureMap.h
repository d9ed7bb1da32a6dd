#pragma once

#include <cmath>
#include <filesystem>
#include <numbers>

#include "Kernel/Features/LiquidBridges/Shared/BridgeError.h"
#include "Kernel/Scene/BridgeLaws.h"

// A map of where each bridge law fails: a region for each volume and contact angle, between equal spheres.

namespace pendular {

/// The region of a bridge by the largest error of the force, relative to the force, from contact to 0.95 of
/// the exact rupture distance. The numbers are those of the table and of the chart.
enum class ErrorRegion { Within5Percent, Within20Percent, Beyond20Percent, WrongSign, NotFinite, Refused };

inline ErrorRegion regionOf(const BridgeDeviation& errors) {
    if (errors.refused) return ErrorRegion::Refused;
    if (!errors.finite) return ErrorRegion::NotFinite;
    if (errors.wrongSign) return ErrorRegion::WrongSign;
    const double largest = errors.largestOfForce();
    return largest <= 0.05  ? ErrorRegion::Within5Percent
           : largest <= 0.2 ? ErrorRegion::Within20Percent
                            : ErrorRegion::Beyond20Percent;
}

struct FailureMapOptions {
    std::filesystem::path file = "failure-maps.csv";
    int volumes = 121, angles = 61;  // cells of the map
};

/// Equal spheres, R = 1 m: V* from 1e-9 to 10 and theta from 0 to 180 degrees, in the middles of cells.
inline std::vector<BridgeCase> mapOfBridges(const FailureMapOptions& options) {
    std::vector<BridgeCase> bridges;
    for (int v = 0; v < options.volumes; ++v)
        for (int a = 0; a < options.angles; ++a)
            bridges.push_back({{1, 1},
                               std::pow(10, -9 + 10 * (v + 0.5) / options.volumes),
                               std::numbers::pi * (a + 0.5) / options.angles});
    return bridges;
}

/// The table of the map, of all bridge laws.
void mapFailures(const FailureMapOptions& options);

}  // namespace pendular
